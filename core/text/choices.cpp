#include "core/text/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <numeric>

namespace umbsim {
namespace {

constexpr std::size_t kShortestBeginning = 3;  // characters that are enough to say what was begun
constexpr std::size_t kLongestName = 100;      // of what is further from every choice than to say so is of use

std::string folded(std::string text) {
  for (char& c : text) c = c == '-' ? '_' : char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool begins(const std::string& text, const std::string& with) { return text.compare(0, with.size(), with) == 0; }

bool ends(const std::string& text, const std::string& with) {
  return text.size() >= with.size() && text.compare(text.size() - with.size(), with.size(), with) == 0;
}

// 0: the same; then the end of a key path, a beginning, and by distance. Nothing: not near.
std::optional<int> remoteness(const std::string& wrong, const std::string& choice) {
  if (wrong == choice) return 0;
  if (ends(choice, "." + wrong)) return 1;
  if (wrong.size() >= kShortestBeginning && begins(choice, wrong)) return 2;
  const int most = std::max(1, int(wrong.size() + 1) / 3);
  if (std::abs(int(wrong.size()) - int(choice.size())) > most) return std::nullopt;  // a letter more is a change, too
  const int distance = edit_distance(wrong, choice);
  if (distance > most) return std::nullopt;
  return 2 + distance;
}

}  // namespace

int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = int(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last.back();
}

std::optional<std::string> nearest(const std::string& wrong, const std::vector<std::string>& choices) {
  std::optional<std::string> best;
  std::optional<int> least;
  for (const std::string& choice : choices) {
    const std::optional<int> remote = remoteness(folded(wrong), folded(choice));
    if (remote && (!least || *remote < *least)) least = remote, best = choice;
  }
  return best;
}

std::string did_you_mean(const std::string& wrong, const std::vector<std::string>& choices) {
  const std::optional<std::string> meant = nearest(wrong, choices);
  return meant ? fmt::format("did you mean '{}'? ", *meant) : "";
}

std::vector<std::string> nearest_few(const std::string& wrong, std::vector<std::string> choices, std::size_t count) {
  const std::string word = folded(wrong.substr(0, kLongestName));
  std::multimap<int, std::string> by_distance;
  for (std::string& choice : choices) by_distance.emplace(edit_distance(word, folded(choice)), std::move(choice));
  std::vector<std::string> few;
  for (auto& [distance, choice] : by_distance) {
    if (few.size() < count) few.push_back(std::move(choice));
  }
  return few;
}

}  // namespace umbsim

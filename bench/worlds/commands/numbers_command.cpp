#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/score/numbers.h"

namespace umbsim::worlds {
namespace {

using Numbers = std::vector<FoundNumber>;

/// Numbers that err alike: the sizes and times of one effect; all places; all directions.
struct Kind {
  std::string name, effect;
  Measure measure;
  bool operator<(const Kind& other) const { return std::tie(measure, name) < std::tie(other.measure, other.name); }
};

Kind kind_of(const FoundNumber& n) {
  if (n.measure == Measure::place) return {"places", "", n.measure};
  if (n.measure == Measure::angle) return {"directions", "", n.measure};
  return {n.effect, n.effect, n.measure};
}

std::map<Kind, Numbers> by_kind(const Numbers& numbers) {
  std::map<Kind, Numbers> kinds;
  for (const FoundNumber& n : numbers) kinds[kind_of(n)].push_back(n);
  return kinds;
}

Numbers of_engine(const Numbers& numbers, const std::string& engine, bool others = false) {
  Numbers found;
  for (const FoundNumber& n : numbers) {
    if ((n.engine == engine) != others) found.push_back(n);
  }
  return found;
}

std::string shown(double value, Measure measure) {
  if (measure == Measure::size) return fmt::format("{:.2f}", value);
  if (measure == Measure::time) return fmt::format("{:.0f} ms", 1000 * value);
  if (measure == Measure::place) return fmt::format("{:.0f} mm", 1000 * value);
  return fmt::format("{:.3f} rad", value);
}

// Root mean square over an engine's numbers, and how many.
std::string seen(const Numbers& numbers, Measure measure) {
  if (numbers.empty()) return "";
  double squares = 0;
  for (const FoundNumber& n : numbers) squares += n.off * n.off;
  return fmt::format("{} ({})", shown(std::sqrt(squares / double(numbers.size())), measure), numbers.size());
}

void print_table(const Numbers& numbers, const std::map<std::string, int>& engines) {
  std::string head = "| numbers of |", rule = "|---|";
  for (const auto& [engine, count] : engines) head += fmt::format(" {} |", engine), rule += "---|";
  fmt::print("{} learned | in use |\n{}---|---|\n", head, rule);
  for (const auto& [kind, of_kind] : by_kind(numbers)) {
    fmt::print("| {} |", kind.name);
    for (const auto& [engine, count] : engines) fmt::print(" {} |", seen(of_engine(of_kind, engine), kind.measure));
    fmt::print(" {} | {} |\n", shown(likeliest_error(of_kind, kind.measure), kind.measure),
               shown(error_in_use(kind.effect, kind.measure), kind.measure));
  }
}

// Each engine's numbers, with what the other engines teach.
void print_left_out(const Numbers& numbers, const std::map<std::string, int>& engines) {
  int all_before = 0, all_after = 0;
  for (const auto& [engine, count] : engines) {
    int before = 0, after = 0;
    for (const auto& [kind, of_kind] : by_kind(numbers)) {
      const Numbers left_out = of_engine(of_kind, engine);
      before += held(left_out, 0);
      after += held(left_out, likeliest_error(of_engine(of_kind, engine, true), kind.measure));
    }
    fmt::print("{} left out: 95 % intervals hold {} of {}; without these errors {}\n", engine, after, count, before);
    all_before += before;
    all_after += after;
  }
  fmt::print("each left out in turn: {} of {}; without {}\n", all_after, numbers.size(), all_before);
}

void numbers(const std::vector<std::string>& folders) {
  Numbers all;
  for (const std::string& folder : folders) {
    const Numbers more = found_numbers(score_worlds(TrialFolder(folder)));
    all.insert(all.end(), more.begin(), more.end());
  }
  std::map<std::string, int> engines;
  for (const FoundNumber& n : all) ++engines[n.engine];
  print_table(all, engines);
  fmt::print("\n");
  print_left_out(all, engines);
}

}  // namespace

void add_numbers_command(CLI::App& app) {
  const auto folders = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand(
      "numbers", "How far the numbers of rightly named effects are off by engine, beyond what noise leaves open");
  command->add_option("folders", *folders, "Folders of worlds, diagnosed by `umbsim gap trial diagnose`")->required();
  command->callback([folders] { numbers(*folders); });
}

}  // namespace umbsim::worlds

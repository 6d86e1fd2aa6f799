#include "gap/trial/score/leaks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "core/random.h"
#include "core/text/text_file.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr int kPermutations = 500;
constexpr std::size_t kNeighbours = 3;
constexpr std::size_t kMaxFileBytes = 1024 * 1024 * 1024;

struct Sizes {
  double bytes = 0;
  double rows = 0;
  double longest = 0;
  double shortest = std::numeric_limits<double>::infinity();
  double files = 0;
};

void add_file(const fs::path& file, Sizes& sizes) {
  const std::string text = read_text_file(file, kMaxFileBytes);
  const double rows = double(std::count(text.begin(), text.end(), '\n'));
  sizes.bytes += double(text.size());
  sizes.rows += rows;
  sizes.longest = std::max(sizes.longest, rows);
  sizes.shortest = std::min(sizes.shortest, rows);
  ++sizes.files;
}

void append(const Sizes& s, std::vector<double>& features) {
  features.insert(features.end(), {s.bytes, s.rows, s.longest, s.shortest, s.files, s.bytes / std::max(1.0, s.rows)});
}

double seconds(const fs::path& path) {
  return std::chrono::duration<double>(fs::last_write_time(path).time_since_epoch()).count();
}

void standardise(std::vector<std::vector<double>>& features) {
  for (std::size_t k = 0; k < features.front().size(); ++k) {
    double mean = 0, variance = 0;
    for (const auto& f : features) mean += f[k] / double(features.size());
    for (const auto& f : features) variance += (f[k] - mean) * (f[k] - mean) / double(features.size());
    for (auto& f : features) f[k] = variance > 0 ? (f[k] - mean) / std::sqrt(variance) : 0;
  }
}

// For each case the others, nearest first, as many as vote.
std::vector<std::vector<std::size_t>> neighbours(const std::vector<std::vector<double>>& features) {
  std::vector<std::vector<std::size_t>> nearest(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t j = 0; j < features.size(); ++j) {
      if (j == i) continue;
      double square = 0;
      for (std::size_t k = 0; k < features[i].size(); ++k) square += std::pow(features[i][k] - features[j][k], 2);
      others.emplace_back(square, j);
    }
    const std::size_t count = std::min(kNeighbours, others.size());
    std::partial_sort(others.begin(), others.begin() + std::ptrdiff_t(count), others.end());
    for (std::size_t n = 0; n < count; ++n) nearest[i].push_back(others[n].second);
  }
  return nearest;
}

// The commonest label of the neighbours; of equally common ones that of the nearest.
std::string vote(const std::vector<std::size_t>& nearest, const std::vector<std::string>& labels) {
  std::map<std::string, int> votes;
  for (const std::size_t j : nearest) ++votes[labels[j]];
  std::string best = labels[nearest.front()];
  for (const std::size_t j : nearest) {
    if (votes[labels[j]] > votes[best]) best = labels[j];
  }
  return best;
}

void shuffle(std::vector<std::string>& labels, RandomStream& random) {
  for (std::size_t i = labels.size(); i > 1; --i) {
    std::swap(labels[i - 1], labels[std::min(i - 1, std::size_t(random.uniform(0, double(i))))]);
  }
}

// `hits`: how many of these labels are guessed.
LeakFigure against_permutations(std::vector<std::string> labels,
                                const std::function<int(const std::vector<std::string>&)>& hits) {
  LeakFigure figure;
  figure.cases = int(labels.size());
  const int real = hits(labels);
  figure.accuracy = double(real) / figure.cases;
  RandomStream random(1, "permuted labels");
  int as_good = 1;
  for (int i = 0; i < kPermutations; ++i) {
    shuffle(labels, random);
    const int permuted = hits(labels);
    figure.chance += double(permuted) / figure.cases / kPermutations;
    as_good += permuted >= real;
  }
  figure.p_value = double(as_good) / (kPermutations + 1);
  return figure;
}

}  // namespace

std::vector<double> metadata(const fs::path& recording) {
  Sizes encoders, truth, rest;
  std::vector<double> times{seconds(recording)};
  for (const auto& entry : fs::recursive_directory_iterator(recording)) {
    times.push_back(seconds(entry.path()));
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().filename().string();
    add_file(entry.path(), name == "encoders.csv" ? encoders : name == "truth.csv" ? truth : rest);
  }
  std::vector<double> features;
  append(encoders, features);
  append(truth, features);
  append(rest, features);
  features.push_back(*std::min_element(times.begin(), times.end()));
  features.push_back(*std::max_element(times.begin(), times.end()));
  const std::string name = recording.filename().string();
  features.push_back(double(name.size()));
  features.push_back(name.empty() ? 0 : double(static_cast<unsigned char>(name.front())));
  for (double& f : features) {
    if (!std::isfinite(f)) f = 0;  // no file of a kind
  }
  return features;
}

LeakFigure metadata_leak(const std::vector<std::vector<double>>& given, const std::vector<std::string>& labels) {
  if (labels.size() < 2) return {};
  std::vector<std::vector<double>> features = given;
  standardise(features);
  const auto nearest = neighbours(features);
  return against_permutations(labels, [&](const std::vector<std::string>& dealt) {
    int hits = 0;
    for (std::size_t i = 0; i < dealt.size(); ++i) hits += vote(nearest[i], dealt) == dealt[i];
    return hits;
  });
}

LeakFigure shuffled_labels(const std::vector<std::string>& truths, const std::vector<std::string>& named) {
  if (truths.empty()) return {};
  return against_permutations(truths, [&](const std::vector<std::string>& dealt) {
    int hits = 0;
    for (std::size_t i = 0; i < dealt.size(); ++i) hits += named[i] == dealt[i];
    return hits;
  });
}

}  // namespace umbsim

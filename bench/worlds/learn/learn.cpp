#include "bench/worlds/learn/learn.h"

#include <array>
#include <cmath>

namespace umbsim::worlds {
namespace {

constexpr std::size_t kKinds = gap::kCourseParts + 1;                                           // the last: counts
constexpr std::array<double, 10> kSizes{0.003, 0.01, 0.02, 0.03, 0.06, 0.1, 0.2, 0.3, 0.6, 1};  // as fine as is known
constexpr double kUsual = 0.1;
constexpr double kWithin = 3;  // a factor: standard deviation of its logarithm

using Sizes = std::array<double, kKinds>;
using Seen = std::vector<const gap::SignatureShares*>;

double density(const Seen& all, const Sizes& sizes) {
  double sum = 0;
  for (const gap::SignatureShares* s : all) {
    Eigen::VectorXd sd(Eigen::Index(s->part.size()));
    for (std::size_t i = 0; i < s->part.size(); ++i) sd[Eigen::Index(i)] = sizes[s->part[i]];
    sum += s->log_density + s->gain(sd);
  }
  return sum;
}

double believed(const Seen& all, const Sizes& sizes) {
  double prior = 0;
  for (const double size : sizes) prior -= std::pow(std::log(size / kUsual) / std::log(kWithin), 2) / 2;
  return density(all, sizes) + prior;
}

// One kind after the other, as long as any gets likelier.
Sizes likeliest(const Seen& all) {
  Sizes sizes;
  sizes.fill(kUsual);
  double most = believed(all, sizes);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < kKinds; ++k) {
      for (const double size : kSizes) {
        Sizes other = sizes;
        other[k] = size;
        const double here = believed(all, other);
        if (here <= most) continue;
        most = here;
        sizes = other;
        changed = true;
      }
    }
  }
  return sizes;
}

}  // namespace

LearnedErrors learned(const std::vector<CaseShares>& cases) {
  LearnedErrors best;
  double most = -1e300, exact = 0;
  for (std::size_t j = 0; j < kMotions.size(); ++j) {
    Seen all;
    for (const CaseShares& c : cases) {
      if (!c.by_motion.empty()) all.push_back(&c.by_motion[j]);
    }
    best.cases = all.size();
    if (j == 0) exact = density(all, Sizes{});
    const Sizes sizes = likeliest(all);
    const double here = believed(all, sizes);
    if (here <= most) continue;
    most = here;
    for (std::size_t k = 0; k < gap::kCourseParts; ++k) best.errors.parts[k] = sizes[k];
    best.errors.counts = sizes[gap::kCourseParts];
    best.errors.motion = kMotions[j];
    best.gain = density(all, sizes) - exact;
  }
  return best;
}

std::map<std::string, LearnedErrors> learned_by_effect(const std::vector<CaseShares>& cases) {
  std::map<std::string, std::vector<CaseShares>> by_effect;
  for (const CaseShares& c : cases) by_effect[c.effect].push_back(c);
  std::map<std::string, LearnedErrors> errors;
  for (const auto& [effect, of_effect] : by_effect) errors[effect] = learned(of_effect);
  return errors;
}

}  // namespace umbsim::worlds

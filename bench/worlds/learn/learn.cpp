#include "bench/worlds/learn/learn.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>

namespace umbsim::worlds {
namespace {

constexpr std::size_t kKinds = gap::kCourseParts + 1;  // the last: counts
constexpr double kUsual = 0.1;                         // of a piece of which nothing is known
constexpr double kUsualPieces = 2;                     // for which that counts
constexpr int kRounds = 300;

using Variances = std::array<double, kKinds>;

Eigen::VectorXd sd_of(const gap::SignatureShares& s, const Variances& variances) {
  Eigen::VectorXd sd(Eigen::Index(s.part.size()));
  for (std::size_t i = 0; i < s.part.size(); ++i) sd[Eigen::Index(i)] = std::sqrt(variances[s.part[i]]);
  return sd;
}

// Expectation of the squared shares under the variances so far, then variances that go with these (Dempster, Laird &
// Rubin 1977).
Variances next(const std::vector<const gap::SignatureShares*>& all, const Variances& now) {
  Variances sum, count;
  sum.fill(kUsualPieces * kUsual * kUsual);
  count.fill(kUsualPieces);
  for (const gap::SignatureShares* s : all) {
    const Eigen::VectorXd sd = sd_of(*s, now);
    Eigen::MatrixXd m = sd.asDiagonal() * s->precision * sd.asDiagonal();
    m.diagonal().array() += 1;
    const Eigen::MatrixXd covariance = sd.asDiagonal() * m.inverse() * sd.asDiagonal();
    const Eigen::VectorXd mean = covariance * s->pull;
    for (std::size_t i = 0; i < s->part.size(); ++i) {
      const Eigen::Index at = Eigen::Index(i);
      sum[s->part[i]] += mean[at] * mean[at] + covariance(at, at);
      count[s->part[i]] += 1;
    }
  }
  Variances variances;
  for (std::size_t k = 0; k < kKinds; ++k) variances[k] = sum[k] / count[k];
  return variances;
}

double density(const std::vector<const gap::SignatureShares*>& all, const Variances& variances) {
  double sum = 0;
  for (const gap::SignatureShares* s : all) sum += s->log_density + s->gain(sd_of(*s, variances));
  return sum;
}

}  // namespace

LearnedErrors learned(const std::vector<CaseShares>& cases) {
  LearnedErrors best;
  double most = -1e300, exact = 0;
  for (std::size_t j = 0; j < kMotions.size(); ++j) {
    std::vector<const gap::SignatureShares*> all;
    for (const CaseShares& c : cases) {
      if (!c.by_motion.empty()) all.push_back(&c.by_motion[j]);
    }
    best.cases = all.size();
    Variances variances;
    variances.fill(kUsual * kUsual);
    for (int round = 0; round < kRounds; ++round) variances = next(all, variances);
    const double here = density(all, variances);
    if (j == 0) exact = density(all, Variances{});
    if (here <= most) continue;
    most = here;
    for (std::size_t k = 0; k < gap::kCourseParts; ++k) best.errors.parts[k] = std::sqrt(variances[k]);
    best.errors.counts = std::sqrt(variances[gap::kCourseParts]);
    best.errors.motion = kMotions[j];
  }
  best.gain = most - exact;
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

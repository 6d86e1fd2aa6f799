#include "gap/plan/race.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/probability.h"
#include "core/random.h"
#include "gap/answer/unknown.h"

namespace umbsim::gap {
namespace {

constexpr double kFarthest = 2;   // times the size at which a bending effect was simulated
constexpr double kEnough = 0.25;  // share of a truth's squared size that another effect must be able to have

// A hypothesis's evidence for data that come as X' C^-1 y, prepared once (gap/evidence/evidence.h, with the nuisances
// inside C).
class Racer {
 public:
  Racer(const Signature& s, const Eigen::MatrixXd& information) : signature_(s) {
    const Eigen::MatrixXd A = information.block(s.first, s.first, s.count, s.count);
    Eigen::MatrixXd M = s.prior_sd.asDiagonal() * A * s.prior_sd.asDiagonal();
    M.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> llt(M);
    covariance_ =
        s.prior_sd.asDiagonal() * llt.solve(Eigen::MatrixXd::Identity(s.count, s.count)) * s.prior_sd.asDiagonal();
    log_det_ = 2 * llt.matrixLLT().diagonal().array().log().sum();
  }

  Eigen::VectorXd mean(const Eigen::VectorXd& b) const {
    return covariance_ * b.segment(signature_.first, signature_.count);
  }

  double score(const Eigen::VectorXd& b, double effect_cost) const {
    const Eigen::VectorXd own = b.segment(signature_.first, signature_.count);
    const Eigen::VectorXd mean = covariance_ * own;
    double gain = 0.5 * (own.dot(mean) - log_det_);
    for (Eigen::Index i = 0; i < mean.size(); ++i) {
      if (signature_.positive[std::size_t(i)]) {
        gain += log_normal_cdf(mean[i] / std::sqrt(covariance_(i, i))) + std::log(2.0);
      }
    }
    return gain - signature_.planned.hypothesis.search_cost - effect_cost;
  }

 private:
  const Signature& signature_;
  Eigen::MatrixXd covariance_;
  double log_det_ = 0;
};

// What is wrong in one draw: any direction that the prior allows, at the wanted severity.
Eigen::VectorXd drawn(const Signature& s, double severity, RandomStream& random) {
  Eigen::VectorXd direction(s.count);
  for (Eigen::Index i = 0; i < s.count; ++i) {
    direction[i] = s.prior_sd[i] * random.normal();
    if (s.positive[std::size_t(i)]) direction[i] = std::abs(direction[i]);
    if (s.planned.hypothesis.from_zero && s.planned.hypothesis.parameters[std::size_t(i)].max <= 0) {
      direction[i] = -std::abs(direction[i]);
    }
  }
  return s.at_severity(direction, severity);
}

std::vector<std::string> effects_in(const std::vector<Signature>& signatures) {
  std::vector<std::string> names;
  for (const EffectInfo& info : catalogue()) {
    const bool there = std::any_of(signatures.begin(), signatures.end(),
                                   [&](const Signature& s) { return s.planned.hypothesis.effect == info.name; });
    if (there) names.push_back(info.name);
  }
  return names;
}

// A square root of a symmetric matrix that may be singular.
Eigen::MatrixXd root(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> e(A);
  return e.eigenvectors() * e.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

// Everything that stays the same from draw to draw.
struct Field {
  const Eigen::MatrixXd& information;
  const std::vector<Signature>& signatures;
  const Thresholds& thresholds;
  const RaceOptions& options;
  Eigen::MatrixXd noise;
  std::vector<Racer> racers;
  std::vector<std::size_t> effect_of;  // of each signature, its place among the effects
  std::vector<double> enough;          // score of each effect that finds it
};

using Truths = std::function<FixedTruth(int draw, RandomStream& random)>;

void run_one(const Field& field, std::size_t effect, const Truths& truths, Race& race) {
  RandomStream random(field.options.seed, "plan " + race.effects[effect]);
  const Eigen::Index row = Eigen::Index(effect);
  const Eigen::Index effects = Eigen::Index(race.effects.size());
  Eigen::VectorXd best(effects);
  Eigen::VectorXd z(field.information.rows());
  const double share = 1.0 / field.options.draws;
  for (int draw = 0; draw < field.options.draws; ++draw) {
    const FixedTruth wrong = truths(draw, random);
    const Signature& truth = field.signatures[wrong.signature];
    race.severity[row] += share * truth.severity(wrong.numbers);
    for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = random.normal();
    const Eigen::VectorXd b = field.information.middleCols(truth.first, truth.count) * wrong.numbers + field.noise * z;
    best.setConstant(-1e300);
    for (std::size_t i = 0; i < field.racers.size(); ++i) {
      if (field.effect_of[i] == race.effects.size()) continue;
      double& score = best[Eigen::Index(field.effect_of[i])];
      score = std::max(score, field.racers[i].score(b, field.thresholds.effect_cost));
    }
    Eigen::Index first = 0;
    const bool found = best.maxCoeff(&first) > field.enough[std::size_t(first)];
    race.named(row, found ? first : effects) += share;
    for (Eigen::Index j = 0; j < effects; ++j) {
      if (j == row || best[j] < best[row] || best[j] <= field.enough[std::size_t(j)]) continue;
      race.mistaken(row, j) += best[j] > best[row] ? share : share / 2;
    }
  }
}

Race empty_race(std::vector<std::string> effects) {
  const Eigen::Index n = Eigen::Index(effects.size());
  return {std::move(effects), Eigen::MatrixXd::Zero(n, n + 1), Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
}

Field field_of(const Race& race, const Eigen::MatrixXd& information, const std::vector<Signature>& signatures,
               const Thresholds& thresholds, const RaceOptions& options) {
  Field field{information, signatures, thresholds, options, root(information), {}, {}, {}};
  for (const std::string& e : race.effects) field.enough.push_back(enough_to_detect({e}, thresholds));
  for (const Signature& s : signatures) {
    field.racers.emplace_back(s, information);
    const auto at = std::find(race.effects.begin(), race.effects.end(), s.planned.hypothesis.effect);
    field.effect_of.push_back(std::size_t(at - race.effects.begin()));
  }
  return field;
}

}  // namespace

Eigen::MatrixXd information(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                            const Signatures& signatures, const Eigen::VectorXd& nuisance_sd) {
  const Eigen::Index nuisances = nuisance_sd.size();
  const Eigen::Index size = grams.front().products.rows() - 1;  // without the residual
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t position = 0; position < runs.size(); ++position) {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(size);
    for (const Signature& s : signatures.all) {
      if (s.planned.in_first_run && position > 0) scale.segment(nuisances + s.first, s.count).setZero();
      // Simulated as run number runs[position], driven as number `position`.
      if (s.planned.by_run_number && runs[position] > 0) {
        scale.segment(nuisances + s.first, s.count).setConstant(double(position) / double(runs[position]));
      }
    }
    A += scale.asDiagonal() * grams[runs[position]].products.bottomRightCorner(size, size) * scale.asDiagonal();
  }
  const Eigen::Index effects = size - nuisances;
  A.bottomRightCorner(effects, effects) += signatures.command_features.transpose() * signatures.command_features;
  Eigen::MatrixXd M = nuisance_sd.asDiagonal() * A.topLeftCorner(nuisances, nuisances) * nuisance_sd.asDiagonal();
  M.diagonal().array() += 1;
  const Eigen::MatrixXd cross = nuisance_sd.asDiagonal() * A.topRightCorner(nuisances, effects);
  return A.bottomRightCorner(effects, effects) - cross.transpose() * M.llt().solve(cross);
}

Race race(const Eigen::MatrixXd& information, const std::vector<Signature>& signatures, const Thresholds& thresholds,
          const RaceOptions& options) {
  Race result = empty_race(effects_in(signatures));
  const Field field = field_of(result, information, signatures, thresholds, options);
  tbb::parallel_for(std::size_t(0), result.effects.size(), [&](std::size_t effect) {
    std::vector<std::size_t> variants;
    for (std::size_t i = 0; i < signatures.size(); ++i) {
      if (field.effect_of[i] == effect && signatures[i].planned.happens) variants.push_back(i);
    }
    const Truths by_turns = [&](int draw, RandomStream& random) {
      const std::size_t i = variants[std::size_t(draw) % variants.size()];
      return FixedTruth{i, drawn(signatures[i], options.severity, random)};
    };
    run_one(field, effect, by_turns, result);
  });
  return result;
}

Race race_among(const std::vector<FixedTruth>& truths, const Eigen::MatrixXd& information,
                const std::vector<Signature>& signatures, const Thresholds& thresholds, const RaceOptions& options) {
  std::vector<std::string> effects;
  for (const FixedTruth& t : truths) effects.push_back(signatures[t.signature].planned.hypothesis.effect);
  Race result = empty_race(std::move(effects));
  const Field field = field_of(result, information, signatures, thresholds, options);
  tbb::parallel_for(std::size_t(0), truths.size(), [&](std::size_t i) {
    run_one(
        field, i, [&](int, RandomStream&) { return truths[i]; }, result);
  });
  return result;
}

double expected_lead(const Eigen::MatrixXd& information, const std::vector<Signature>& signatures,
                     const FixedTruth& truth, const std::string& effect) {
  const Signature& s = signatures[truth.signature];
  const Eigen::VectorXd b = information.middleCols(s.first, s.count) * truth.numbers;
  const double whole = truth.numbers.dot(b.segment(s.first, s.count));
  double least = whole / 2;
  for (const Signature& other : signatures) {
    if (other.planned.hypothesis.effect != effect) continue;
    const Eigen::VectorXd own = b.segment(other.first, other.count);
    least = std::min(least, (whole - own.dot(Racer(other, information).mean(b))) / 2);
  }
  return least;
}

FixedTruth nearest(const Eigen::MatrixXd& information, const std::vector<Signature>& signatures,
                   const FixedTruth& truth, const std::string& effect) {
  const Signature& s = signatures[truth.signature];
  const Eigen::VectorXd b = information.middleCols(s.first, s.count) * truth.numbers;
  const double whole = truth.numbers.dot(b.segment(s.first, s.count));
  FixedTruth best;
  double most = -1e300;
  for (std::size_t i = 0; i < signatures.size(); ++i) {
    const Signature& other = signatures[i];
    if (other.planned.hypothesis.effect != effect) continue;
    Eigen::VectorXd mean = Racer(other, information).mean(b);
    for (Eigen::Index k = 0; k < mean.size(); ++k) {
      if (other.positive[std::size_t(k)]) mean[k] = std::max(0.0, mean[k]);
    }
    const double gain = b.segment(other.first, other.count).dot(mean);
    if (gain <= most) continue;
    most = gain;
    const auto square = [&](const Eigen::VectorXd& p) {
      return p.dot(information.block(other.first, other.first, other.count, other.count) * p);
    };
    best = {i, {}};
    if (!(square(mean) > 0)) continue;
    const Eigen::VectorXd alike = mean * std::sqrt(whole / square(mean));
    // A bending effect is known near the size at which it was simulated only.
    const bool bends = !other.planned.hypothesis.from_zero;
    const Eigen::VectorXd plausible = bends ? alike.cwiseMin(kFarthest) : other.within_plausible(alike);
    if (square(plausible) > kEnough * whole) best.numbers = plausible;
  }
  return best;
}

}  // namespace umbsim::gap

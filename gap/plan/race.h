#pragma once

#include <string>
#include <vector>

#include "gap/plan/signatures.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Inner products of the effects' columns over a set of runs, each over the covariance of everything that is no effect:
/// noise, scatter from run to run, nuisances. With data y = X p + e, X' C^-1 y ~ N(information p, information).
Eigen::MatrixXd information(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                            const Signatures& signatures, const Eigen::VectorXd& nuisance_sd);

struct RaceOptions {
  double severity = 3;  ///< of what is wrong, in noise floors
  int draws = 300;      ///< for each effect
  std::uint64_t seed = 1;
};

/// What a diagnosis would say, over sampled noise. Rows: what is wrong, by `effects`.
struct Race {
  std::vector<std::string> effects;  ///< in the catalogue's order
  Eigen::MatrixXd named;             ///< probability of each name; last column: none
  Eigen::MatrixXd mistaken;          ///< probability that this one alone would be preferred, and found
  Eigen::VectorXd severity;          ///< reached, mean over draws: less than asked where more is not plausible
};

/// What is wrong, exactly: numbers of one of the signatures.
struct FixedTruth {
  std::size_t signature = 0;
  Eigen::VectorXd numbers;
};

/// Draws what is wrong and the noise, and lets the hypotheses race for the largest evidence with the diagnosis's costs.
Race race(const Eigen::MatrixXd& information, const std::vector<Signature>& signatures, const Thresholds& thresholds,
          const RaceOptions& options);

/// The same where it is known what is wrong: one row for each of the truths' effects, the others stay empty. Only the
/// effects of the truths are in the race.
Race race_among(const std::vector<FixedTruth>& truths, const Eigen::MatrixXd& information,
                const std::vector<Signature>& signatures, const Thresholds& thresholds, const RaceOptions& options);

/// Half the squared distance, in standard deviations, of a truth from the nearest that any hypothesis of `effect` comes
/// to it, which pays for its numbers: log evidence by which the truth is expected to be ahead.
double expected_lead(const Eigen::MatrixXd& information, const std::vector<Signature>& signatures,
                     const FixedTruth& truth, const std::string& effect);

/// The numbers of the hypothesis of `effect` that comes nearest to a truth, at the truth's own distance from no effect;
/// no numbers where no plausible size is as far.
FixedTruth nearest(const Eigen::MatrixXd& information, const std::vector<Signature>& signatures,
                   const FixedTruth& truth, const std::string& effect);

}  // namespace umbsim::gap

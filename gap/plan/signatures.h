#pragma once

#include <functional>
#include <vector>

#include "gap/plan/effects.h"
#include "gap/plan/severity.h"

namespace umbsim::gap {

/// One hypothesis's place in the columns, and how large its numbers must be to show.
struct Signature {
  PlannedHypothesis planned;
  int first = 0;  ///< of its columns
  int count = 0;
  Eigen::VectorXd prior_sd;    ///< of each column's number
  std::vector<bool> positive;  ///< numbers that cannot be negative
  Eigen::VectorXd unit;        ///< value of each number's parameter at 1
  SizeRows rows;               ///< severity's rows by number, one column each
  Eigen::MatrixXd features;    ///< of counts and command features, in standard deviations, by number

  /// Severity at these numbers, in the tracks or their steps.
  double on_track(const Eigen::VectorXd& numbers) const;
  /// The same or, if larger, in what commands and counts show, in standard deviations.
  double severity(const Eigen::VectorXd& numbers) const;
  /// The numbers at which this direction has the wanted severity on the tracks; where no plausible size has, half of
  /// the most that is plausible, for it shows in commands and counts or not at all.
  Eigen::VectorXd at_severity(const Eigen::VectorXd& direction, double wanted) const;
  Eigen::VectorXd within_plausible(Eigen::VectorXd numbers) const;
};

/// What the effects do to the tracks of a model's runs, before any data: whitened, seen from the nominal robot.
struct Signatures {
  std::vector<Signature> all;
  std::vector<Eigen::MatrixXd> columns;  ///< per run
  Eigen::MatrixXd command_features;      ///< what any set of runs shows of how it is driven and read, once
                                         ///< (recording/command_features.h)

  /// An effect that bends the simulator, or cannot be negative, is simulated at the wanted severity and its secant
  /// taken; any other is simulated at its hypothesis's step. `counted`: runs that a severity is measured on. `severity`
  /// 0: all at the hypotheses' own steps and starts, where the search has simulated them already. `done`: told how far
  /// it is.
  Signatures(const Model& model, const std::vector<PlannedHypothesis>& hypotheses,
             const std::vector<std::size_t>& counted, double severity, double radius_scatter,
             const std::function<void(double share)>& done = {});
};

}  // namespace umbsim::gap

#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// A change of the tracks in units of the noise floor, as rows whose sums of squares are severities squared: of the
/// changes themselves, and of their steps from one moment to the next.
struct SizeRows {
  Eigen::MatrixXd whole;
  Eigen::MatrixXd steps;
};

/// Severity as docs/trial.md defines it, with the noise's variances from the noise model instead of from noisy drives.
class NoiseFloors {
 public:
  /// `runs`: that count. `radius_scatter`: of each wheel from run to run.
  NoiseFloors(const Model& model, std::vector<std::size_t> runs, double radius_scatter);

  /// One column of the rows: what `tracks` (of all runs; only those that count are read) differ from the nominal ones
  /// by.
  SizeRows rows(const std::vector<std::vector<Pose2>>& tracks) const;

 private:
  const Model& model_;
  std::vector<std::size_t> runs_;
  std::vector<std::vector<std::size_t>> moments_;  // of each run that counts, samples of its truth
  Eigen::Vector3d whole_sd_;
  Eigen::Vector3d steps_sd_;
};

}  // namespace umbsim::gap

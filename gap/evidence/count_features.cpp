// Counts against commands, and how the robot was driven and read, as rows beside the tracks.
#include <cmath>
#include <tuple>

#include "gap/evidence/model.h"

namespace umbsim::gap {

// With what counts against commands are measured; where they are judged alone, with what engines differ by.
CountsSd Model::counts_sd(std::size_t run, bool alone) const {
  const CommandResponse& measured = measured_.counted[run];
  if (!measured.known) return CountsSd::Zero();
  const double gain = std::hypot(scatter_.gain, measured.gain_sd, alone ? scatter_.engine_gain : 0);
  const double by_heading = std::hypot(scatter_.gain * measured.speed_radps, measured.by_heading_sd_radps);
  CountsSd sd;
  sd << gain, gain, (alone ? scatter_.counts_lag_s : scatter_.run_lag_s), by_heading, by_heading;
  return sd;
}

// What differs between two of them, in standard deviations.
Eigen::VectorXd Model::feature_rows(std::size_t run, const Predicted& a, const Predicted& b, bool alone) const {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(kFeatureRows);
  if (run == 0) {
    for (std::size_t i = 0; i < a.command_features.size(); ++i) {
      rows[kCountRows + Eigen::Index(i)] = (a.command_features[i] - b.command_features[i]) / features_sd_[i];
    }
  }
  const CommandResponse& x = a.counted[run];
  const CommandResponse& y = b.counted[run];
  if (!measured_.counted[run].known || !x.known || !y.known) return rows;
  CountsSd off;
  off << x.left_gain - y.left_gain, x.right_gain - y.right_gain, x.lag_s - y.lag_s,
      x.by_heading_radps - y.by_heading_radps;
  rows.head<kCountRows>() = off.cwiseQuotient(counts_sd(run, alone));
  return rows;
}

double Model::counts_misfit(const Predicted& predicted) const {
  double sum = 0;
  for (std::size_t r = 0; r < recording().runs.size(); ++r)
    sum += feature_rows(r, measured_, predicted, true).squaredNorm();
  return sum;
}

double Model::counts_misfit(const Fit& fit) const {
  double sum = 0;
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(nuisances());  // of each nuisance in counts
  for (std::size_t r = 0; r < recording().runs.size(); ++r) {
    const Eigen::MatrixXd in_counts = nuisances_.shared[r].bottomRows(kFeatureRows);
    sum += (feature_rows(r, measured_, fit.predicted, false) - in_counts * fit.nuisance).squaredNorm();
    seen += in_counts.colwise().squaredNorm().transpose();
  }
  const Eigen::VectorXd& sd = nuisance_sds()[fit.prior];
  for (Eigen::Index i = 0; i < seen.size(); ++i) {
    if (seen[i] > 0 && sd[i] > 0) sum += std::pow(fit.nuisance[i] / sd[i], 2);
  }
  return sum;
}

double Model::command_features_misfit(const Predicted& predicted) const {
  return feature_rows(0, measured_, predicted, true).tail(kFeatureRows - kCountRows).squaredNorm();
}

double Model::count_rows() const {
  double rows = double(std::tuple_size<CommandFeatures>::value);
  for (const CommandResponse& counted : measured_.counted) rows += counted.known ? kCountRows : 0;
  return rows;
}

}  // namespace umbsim::gap

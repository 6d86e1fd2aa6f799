// Counts against commands, and how the robot was driven and read, as rows beside the tracks.
#include <cmath>
#include <tuple>

#include "gap/evidence/model.h"
#include "gap/hypotheses/parametrisations.h"
#include "recording/counts_behind.h"

namespace umbsim::gap {
namespace {

constexpr double kServo_s = 0.02;     // with which the response of a servo is found,
constexpr double kFriction_s = 2e-4;  // and that to friction

// Wheels that friction holds back by a speed, on the way or where they turn the robot in place.
std::vector<std::array<double, 2>> held_back(const RecordedRun& run, const std::vector<HeadingOverTime>& heading,
                                             std::vector<std::array<double, 2>> counts_rad, double by_radps,
                                             bool in_place) {
  std::array<double, 2> behind_rad{};
  for (std::size_t i = 1; i < counts_rad.size(); ++i) {
    const EncoderSample& s = run.encoders[i];
    const std::array<double, 2> speed{s.left_command_radps, s.right_command_radps};
    const double dt_s = s.time_s - run.encoders[i - 1].time_s;
    for (std::size_t w = 0; w < 2; ++w) {
      if (heading[i].in_place == in_place && speed[w] != 0) behind_rad[w] += std::copysign(by_radps * dt_s, speed[w]);
      counts_rad[i][w] -= behind_rad[w];
    }
  }
  return counts_rad;
}

}  // namespace

// With what counts against commands are measured.
CountsSd Model::counts_sd(std::size_t run) const {
  const CommandResponse& measured = measured_.counted[run];
  if (!measured.known) return CountsSd::Zero();
  const double gain = std::hypot(scatter_.gain, measured.gain_sd);
  const double by_heading = std::hypot(scatter_.gain * measured.speed_radps, measured.by_heading_sd_radps);
  CountsSd sd;
  sd << gain, gain, scatter_.run_lag_s, by_heading, by_heading;
  return sd;
}

// What differs between two of them, in standard deviations.
Eigen::VectorXd Model::feature_rows(std::size_t run, const Predicted& a, const Predicted& b) const {
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
  rows.head<kCountRows>() = off.cwiseQuotient(counts_sd(run));
  return rows;
}

// A servo that holds its speed in proportion to its torque gives way under its load: the run is driven with one.
CountsColumns Model::alike_in_counts(std::size_t run) const {
  CountsColumns columns = CountsColumns::Zero(kFeatureRows, CountsColumns::ColsAtCompileTime);
  const CommandResponse& nominal = without_effects_.counted[run];
  if (!measured_.counted[run].known || !nominal.known) return columns;
  const auto per_unit = [&](const CommandResponse& changed, double unit) {
    Predicted with;
    with.counted.assign(run + 1, nominal);
    with.counted[run] = changed;
    with.command_features = without_effects_.command_features;
    return (feature_rows(run, with, without_effects_) / unit).eval();
  };
  CommandResponse gain = nominal, wheel = nominal, late = nominal;
  gain.left_gain += 1;
  gain.right_gain += 1;
  wheel.left_gain += 0.5;
  wheel.right_gain -= 0.5;
  late.lag_s += 1;
  columns.leftCols<3>() << per_unit(gain, 1), per_unit(wheel, 1), per_unit(late, 1);
  // What a driver does along its course looks like a slope in one run, and is mirrored where the course is.
  const Eigen::Matrix2d axes = course_axes(recording().runs[run]);
  CommandResponse along = nominal, across = nominal;
  along.by_heading_radps += nominal.speed_radps * axes.col(0);
  across.by_heading_radps += nominal.speed_radps * axes.col(1);
  columns.rightCols<2>() << per_unit(along, 1), per_unit(across, 1);
  if (mass_kg() == 0) return columns;
  Effect servo = neutral_effect(find_effect("motor_response"));
  servo.values.numbers[index_of(*servo.info, "droop_radps_per_nm")] = kServo_s / motor_inertia_kgm2();
  const auto response = [&](const std::vector<std::array<double, 2>>& turned) {
    return per_unit(command_response(recording().runs[run], recording().robot, turned, step_rad_), 1);
  };
  columns.col(3) = response(simulator_.commands(run, {servo})) / kServo_s;
  // What a load in proportion to the robot's weight slows the same servo by, whatever its speed.
  const std::vector<HeadingOverTime> heading = heading_over_time(recording().runs[run], recording().robot);
  const auto followed = simulator_.commands(run, {});
  const double by_radps = slowed_radps(kFriction_s, recording().robot);
  for (const bool in_place : {false, true}) {
    const auto behind = held_back(recording().runs[run], heading, followed, by_radps, in_place);
    columns.col(in_place ? 5 : 4) = response(behind) / kFriction_s;
  }
  return columns;
}

double Model::counts_misfit(const Fit& fit) const {
  double sum = 0;
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(nuisances());  // of each nuisance in counts
  for (std::size_t r = 0; r < recording().runs.size(); ++r) {
    const Eigen::MatrixXd in_counts = nuisances_.shared[r].bottomRows(kFeatureRows);
    sum += (feature_rows(r, measured_, fit.predicted) - in_counts * fit.nuisance).squaredNorm();
    seen += in_counts.colwise().squaredNorm().transpose();
  }
  const Eigen::VectorXd& sd = nuisance_sds()[fit.prior];
  for (Eigen::Index i = 0; i < seen.size(); ++i) {
    if (seen[i] > 0 && sd[i] > 0) sum += std::pow(fit.nuisance[i] / sd[i], 2);
  }
  return sum;
}

double Model::command_features_misfit(const Predicted& predicted) const {
  return feature_rows(0, measured_, predicted).tail(kFeatureRows - kCountRows).squaredNorm();
}

double Model::count_rows() const {
  double rows = double(std::tuple_size<CommandFeatures>::value);
  for (const CommandResponse& counted : measured_.counted) rows += counted.known ? kCountRows : 0;
  return rows;
}

}  // namespace umbsim::gap

#include "experiment/drive/recorder.h"

#include <algorithm>
#include <cmath>

namespace umbsim {

Recorder::Recorder(const Scenario& scenario, const RunSpec& spec, const OdometryParameters& odometry, int periods,
                   const RunOutput& output)
    : truth_(scenario.truth),
      random_(scenario.seed, "absolute pose", std::uint64_t(spec.number)),
      periods_(periods),
      stride_(std::max(1, int(std::lround(scenario.encoders.rate_hz / truth_.rate_hz)))),
      unit_(scenario.encoders.ticks_per_revolution / odometry.ticks_per_revolution),
      in_memory_(output.rows.to == Rows::To::memory),
      digester_(odometry, std::size_t(truths()), output.path_poses) {
  run_.id = spec.id;
  run_.direction = name(spec.direction);
  run_.has_commands = true;
  if (scenario.runs.start_heading_rad != 0) run_.start_heading_rad = scenario.runs.start_heading_rad;
  if (spec.bumped && scenario.bumps.laid.count > 0) run_.inner_wheel_bumps = scenario.bumps.laid.count;
  if (spec.bumped) {
    for (const Cable& cable : scenario.bumps.fixed) run_.bumps.push_back({cable.x_m, cable.y_m, cable.height_m});
  }
  if (output.rows.to == Rows::To::folder) writer_.emplace(output.rows.folder, run_.id, run_.has_commands);
}

int Recorder::truths() const {
  int count = 0;
  for (int period = 0; period <= periods_; ++period) count += truth_is_due(period);
  return count;
}

void Recorder::encoders(double time_s, std::int64_t left, std::int64_t right, const WheelSpeeds& command) {
  EncoderSample row{time_s, left, right, command.left_radps, command.right_radps};
  digester_.add(row);
  row.left_ticks = believed(left);
  row.right_ticks = believed(right);
  if (in_memory_) run_.encoders.push_back(row);
  if (writer_) writer_->add(row);
}

std::int64_t Recorder::believed(std::int64_t ticks) const {
  return unit_ == 1 ? ticks : std::llround(double(ticks) * unit_);
}

bool Recorder::truth_is_due(int period) const {
  const bool end = period == 0 || period == periods_;
  return end || (truth_.kind != "endpoints" && period % stride_ == 0);
}

void Recorder::truth(double time_s, const Pose2& X_WB, const std::optional<UncertainPose>& estimate,
                     const WheelMoment& wheels) {
  const double x = random_.normal(X_WB.x_m, truth_.position_sd_m);
  const double y = random_.normal(X_WB.y_m, truth_.position_sd_m);
  const TruthSample row{time_s, {x, y, random_.normal(X_WB.theta_rad, truth_.heading_sd_rad)}};
  digester_.add(row, estimate, wheels);
  if (in_memory_) run_.truth.push_back(row);
  if (writer_) writer_->add(row);
}

DrivenRun Recorder::finish() {
  if (writer_) writer_->finish();
  DrivenRun driven;
  driven.digest = digester_.finish(run_.id);
  driven.run = std::move(run_);
  return driven;
}

}  // namespace umbsim

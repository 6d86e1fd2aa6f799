#include "experiment/drive/planned_runs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "experiment/scenario/recorded_course.h"

namespace umbsim {
namespace {

Scenario scenario_of(Scenario s, const RobotModel& nominal, const Recording& planned, const RecordedRun& run) {
  set_course(s.course, planned.path);
  s.course.linear_speed_mps = run.linear_speed_mps.value_or(s.course.linear_speed_mps);
  s.course.turn = run.turn.value_or(s.course.turn);
  s.course.turn_radius_m = run.turn_radius_m.value_or(s.course.turn_radius_m);
  s.runs.start_heading_rad = run.start_heading_rad.value_or(0);
  s.encoders.rate_hz = planned.encoder_rate_hz;
  s.encoders.ticks_per_revolution = planned.robot.ticks_per_revolution;
  if (run.payload_kg) s.effects.push_back(payload_on(nominal, *run.payload_kg));
  return s;
}

int periods(double duration_s, double rate_hz) { return int(std::ceil(duration_s * rate_hz)); }

// The recorder runs as long as the course should take: a robot that was faster stands still until then.
void wait_for_the_end(RecordedRun& run, const Scenario& s, Direction direction) {
  const double rate_hz = s.encoders.rate_hz;
  const int end = periods(Plan(s.course, direction).duration_s(), rate_hz) + periods(kRest_s, rate_hz);
  const int stride = std::max(1, int(std::lround(rate_hz / s.truth.rate_hz)));
  const int driven = int(run.encoders.size()) - 1;
  if (driven >= end) return;
  const Pose2 X_WB = run.truth.back().X_WB;
  const bool track = s.truth.kind == "track";
  if (!track || driven % stride != 0) run.truth.pop_back();  // it was there because the run ended
  EncoderSample row = run.encoders.back();
  for (int period = driven + 1; period <= end; ++period) {
    row.time_s = period * (1 / rate_hz);
    row.left_command_radps = row.right_command_radps = 0;
    run.encoders.push_back(row);
    if (period == end || (track && period % stride == 0)) run.truth.push_back({row.time_s, X_WB});
  }
}

// The absolute poses as they are measured.
void measure_poses(RecordedRun& run, const TruthChoice& truth, std::uint64_t seed, int number) {
  RandomStream random(seed, "absolute pose", std::uint64_t(number));
  for (TruthSample& sample : run.truth) {
    sample.X_WB.x_m = random.normal(sample.X_WB.x_m, truth.position_sd_m);
    sample.X_WB.y_m = random.normal(sample.X_WB.y_m, truth.position_sd_m);
    sample.X_WB.theta_rad = random.normal(sample.X_WB.theta_rad, truth.heading_sd_rad);
  }
}

void drive_planned_run(const Scenario& s, const RobotModel& nominal, RecordedRun& run, int number) {
  const RunSpec spec{run.id, run.direction == "cw" ? Direction::cw : Direction::ccw, false, number};
  OdometryParameters odometry = initial_odometry(s, nominal);
  odometry.ticks_per_revolution = rig_for(s, nominal, spec).encoders.ticks_per_revolution;
  Scenario exact = s;
  exact.truth.position_sd_m = exact.truth.heading_sd_rad = 0;
  DrivenRun driven = drive_run(exact, nominal, odometry, spec);
  wait_for_the_end(driven.run, s, spec.direction);
  measure_poses(driven.run, s.truth, s.seed, number);
  run.has_commands = driven.run.has_commands;
  run.encoders = std::move(driven.run.encoders);
  run.truth = std::move(driven.run.truth);
}

}  // namespace

Effect payload_on(const RobotModel& nominal, double payload_kg) {
  Effect effect = neutral_effect(find_effect("load_shift"));
  const auto set = [&](const char* parameter, double value) {
    for (std::size_t i = 0; i < effect.info->parameters.size(); ++i) {
      if (effect.info->parameters[i].name == parameter) effect.values.numbers[i] = value;
    }
  };
  set("payload_kg", payload_kg);
  set("ahead_m", nominal.base.com_m.x());
  set("left_m", nominal.base.com_m.y());
  set("height_m", nominal.base.com_m.z());
  return effect;
}

Recording drive_planned_runs(const Scenario& scenario, const RobotModel& nominal, Recording planned) {
  tbb::parallel_for(std::size_t(0), planned.runs.size(), [&](std::size_t i) {
    RecordedRun& run = planned.runs[i];
    drive_planned_run(scenario_of(scenario, nominal, planned, run), nominal, run, int(i));
  });
  return planned;
}

}  // namespace umbsim

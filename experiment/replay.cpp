#include "experiment/replay.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <Eigen/Cholesky>

#include "effects/geometry.h"
#include "experiment/drive_run.h"

namespace umbsim {
namespace {

// Angles of a shaft that the counts stand for, in radians, smoothed over neighbours so that the counts' staircase does
// not shake the robot. Binomial weights: no drift, and straight ramps stay as they are.
constexpr std::size_t kDriftHalf = 5;  // samples

std::vector<double> smoothed(std::vector<double> angle) {
  const std::size_t n = angle.size();
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> next = angle;
    for (std::size_t i = 1; i + 1 < n; ++i) next[i] = (angle[i - 1] + 2 * angle[i] + angle[i + 1]) / 4;
    angle = std::move(next);
  }
  return angle;
}

// Counts that were latched only every so often stand still in between: the moments of change are joined by lines. Where
// nothing changes for longer the wheel stands, until one interval before the next change.
void join_latches(std::vector<double>& counts, const std::vector<EncoderSample>& samples, double interval_s) {
  if (interval_s <= 0) return;
  std::size_t from = 0;
  const std::vector<double> latched = counts;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    if (latched[i] == latched[i - 1]) continue;
    while (from + 1 < i && samples[i].time_s - samples[from + 1].time_s > interval_s - 1e-9) ++from;
    for (std::size_t j = from + 1; j < i; ++j) {
      counts[j] = latched[from] + (latched[i] - latched[from]) * double(j - from) / double(i - from);
    }
    from = i;
  }
}

// Rotation that wheel speeds make up to each sample. Set-points ramp from one to the next; a time step moves with the
// speed at its end, so that with `steps` a period the ramp is a staircase that runs ahead by half a step.
std::vector<double> commanded(const std::vector<EncoderSample>& s, const std::vector<double>& late, int steps) {
  const double before = (steps - 1) / (2.0 * steps);
  std::vector<double> angle(s.size());
  for (std::size_t i = 1; i < s.size(); ++i) {
    angle[i] = angle[i - 1] + (before * late[i - 1] + (1 - before) * late[i]) * (s[i].time_s - s[i - 1].time_s);
  }
  return angle;
}

// The same speeds half a time step later, so that the staircase turns the shaft as far as it did.
std::vector<double> half_a_step_later(const std::vector<double>& speed, int steps) {
  std::vector<double> later = speed;
  for (std::size_t i = 1; i < speed.size(); ++i) later[i] += (speed[i - 1] - speed[i]) / (2.0 * steps);
  return later;
}

// A wheel's speed at the samples if it follows the commands, which ramp from one to the next, with a first-order lag.
std::vector<double> obeyed(const std::vector<EncoderSample>& s, double EncoderSample::*command, double lag_s) {
  std::vector<double> speed(s.size());
  speed[0] = s[0].*command;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double dt = s[i].time_s - s[i - 1].time_s;
    const double behind = (s[i].*command - s[i - 1].*command) / dt * lag_s;
    const double fading = lag_s > 0 ? std::exp(-dt / lag_s) : 0;
    speed[i] = s[i].*command - behind + (speed[i - 1] - s[i - 1].*command + behind) * fading;
  }
  return speed;
}

// Mean over neighbours within half a window, fewer at the ends.
std::vector<double> averaged(const std::vector<double>& x, std::size_t half) {
  std::vector<double> sum(x.size() + 1);
  for (std::size_t i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  std::vector<double> mean(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t h = std::min({half, i, x.size() - 1 - i});
    mean[i] = (sum[i + h + 1] - sum[i - h]) / double(2 * h + 1);
  }
  return mean;
}

// How late the counts follow the commands, by least squares on speed, commanded angle and way.
double measured_lag(const RecordedRun& run, double radians_per_tick, int steps) {
  if (!run.has_commands) return 0;
  double lag = 0;
  for (int w = 0; w < 2; ++w) {
    const auto command = w == 0 ? &EncoderSample::left_command_radps : &EncoderSample::right_command_radps;
    const auto ticks = w == 0 ? &EncoderSample::left_ticks : &EncoderSample::right_ticks;
    const std::vector<double> asked = commanded(run.encoders, obeyed(run.encoders, command, 0), steps);
    Eigen::Matrix4d A = Eigen::Matrix4d::Identity() * 1e-12;
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    double way = 0;
    for (std::size_t i = 1; i < run.encoders.size(); ++i) {
      const EncoderSample& s = run.encoders[i];
      way += std::abs(asked[i] - asked[i - 1]);
      const Eigen::Vector4d x(s.*command, asked[i], way, 1);
      A += x * x.transpose();
      b += x * (asked[i] - radians_per_tick * double(s.*ticks - run.encoders.front().*ticks));
    }
    lag += 0.5 * A.ldlt().solve(b)[0];
  }
  return lag;
}

// Speeds at the samples whose ramps in between turn the shaft as far as it did.
std::vector<double> speeds(const std::vector<double>& angle, const std::vector<EncoderSample>& s) {
  std::vector<double> speed(angle.size());
  for (std::size_t i = 1; i + 1 < angle.size(); ++i) {
    speed[i] = (angle[i + 1] - angle[i - 1]) / (s[i + 1].time_s - s[i - 1].time_s);
  }
  return speed;
}

// Speeds of a shaft, from what arrived of its rotation: late, latched, with counts missing in the mean.
std::vector<double> shaft_speeds(const RecordedRun& run, const EncoderSpec& spec, const EncoderFaults& faults,
                          bool left, double lag_s, int steps) {
  const auto ticks = left ? &EncoderSample::left_ticks : &EncoderSample::right_ticks;
  const std::vector<EncoderSample>& s = run.encoders;
  const double k = 2 * M_PI / spec.ticks_per_revolution;
  std::vector<double> counts(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) counts[i] = double(s[i].*ticks);
  join_latches(counts, s, spec.sampling_interval_s);
  std::vector<double> angle(s.size());
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double counted = k * (counts[i] - counts[i - 1]);
    const double speed = std::abs(counted) / (s[i].time_s - s[i - 1].time_s);
    const double missed = std::min(0.9, faults.missed_probability + faults.missed_probability_per_radps * speed);
    angle[i] = angle[i - 1] + counted / (1 - missed);
  }
  if (spec.latency_s > 0) {
    const std::vector<double> late = angle;
    std::size_t j = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double t = s[i].time_s + spec.latency_s;
      while (j + 2 < s.size() && s[j + 1].time_s < t) ++j;
      const double part = std::clamp((t - s[j].time_s) / (s[j + 1].time_s - s[j].time_s), 0.0, 1.0);
      angle[i] = late[j] + part * (late[j + 1] - late[j]);
    }
    // At the start nothing had turned yet: what is missing there is not known.
    const double offset = angle.front();
    for (double& a : angle) a -= offset;
  }
  if (!run.has_commands) return half_a_step_later(speeds(smoothed(std::move(angle)), s), steps);
  // The commands say finely what the counts say coarsely: the motor follows them, and drifts from them slowly.
  const auto command = left ? &EncoderSample::left_command_radps : &EncoderSample::right_command_radps;
  const double late_s = std::max(0.0, lag_s - spec.latency_s - spec.sampling_interval_s / 2);
  const std::vector<double> asked = obeyed(s, command, late_s);
  const std::vector<double> turned = commanded(s, asked, steps);
  for (std::size_t i = 0; i < s.size(); ++i) angle[i] -= turned[i];
  std::vector<double> speed = half_a_step_later(speeds(averaged(averaged(angle, kDriftHalf), kDriftHalf), s), steps);
  for (std::size_t i = 0; i < s.size(); ++i) speed[i] += asked[i];
  return speed;
}

// What arrives of the shafts' angles: with lost counts in the mean, latched, and late.
std::vector<std::array<double, 2>> arrived(const std::vector<std::array<double, 2>>& shaft,
                                           const std::vector<EncoderSample>& s, const EncoderSpec& spec) {
  std::vector<std::array<double, 2>> counted = shaft;
  for (std::size_t w = 0; w < 2; ++w) {
    const EncoderFaults& faults = w == 0 ? spec.left : spec.right;
    for (std::size_t i = 1; i < s.size(); ++i) {
      const double turned = shaft[i][w] - shaft[i - 1][w];
      const double speed = std::abs(turned) / (s[i].time_s - s[i - 1].time_s);
      const double missed = std::min(0.9, faults.missed_probability + faults.missed_probability_per_radps * speed);
      counted[i][w] = counted[i - 1][w] + turned * (1 - missed);
    }
  }
  const double late_s = spec.latency_s + spec.sampling_interval_s / 2;
  if (late_s == 0) return counted;
  std::vector<std::array<double, 2>> result = counted;
  std::size_t j = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double t = s[i].time_s - late_s;
    while (j + 2 < s.size() && s[j + 1].time_s < t) ++j;
    const double part = std::clamp((t - s[j].time_s) / (s[j + 1].time_s - s[j].time_s), 0.0, 1.0);
    for (std::size_t w = 0; w < 2; ++w) result[i][w] = counted[j][w] + part * (counted[j + 1][w] - counted[j][w]);
  }
  return result;
}

Pose2 between(const Pose2& a, const Pose2& b, double part) {
  return {a.x_m + part * (b.x_m - a.x_m), a.y_m + part * (b.y_m - a.y_m),
          a.theta_rad + part * (b.theta_rad - a.theta_rad)};
}

// Poses at the encoders' samples -> poses at the truth's.
std::vector<Pose2> at_truth(const RecordedRun& run, const std::vector<Pose2>& track) {
  std::vector<Pose2> result;
  result.reserve(run.truth.size());
  const std::vector<EncoderSample>& s = run.encoders;
  std::size_t i = 0;
  for (const TruthSample& truth : run.truth) {
    while (i + 2 < s.size() && s[i + 1].time_s < truth.time_s) ++i;
    const double part = std::clamp((truth.time_s - s[i].time_s) / (s[i + 1].time_s - s[i].time_s), 0.0, 1.0);
    result.push_back(between(track[i], track[i + 1], part));
  }
  return result;
}

// The pose at the start, from the first metre of the track: single poses are noisy, the first one may be wrong.
Pose2 start_of(const RecordedRun& run, const RecordedRobot& robot) {
  constexpr double kWay_m = 1;
  const OdometryParameters believed{robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m,
                                    robot.ticks_per_revolution};
  DeadReckoning reckoning(believed, {}, run.encoders.front().left_ticks, run.encoders.front().right_ticks);
  std::vector<Pose2> track{reckoning.pose()};
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    reckoning.update(run.encoders[i].left_ticks, run.encoders[i].right_ticks);
    track.push_back(reckoning.pose());
  }
  const std::vector<Pose2> at = at_truth(run, track);
  std::vector<double> turned;
  for (std::size_t k = 0; k < at.size() && (k < 3 || std::hypot(at[k].x_m, at[k].y_m) < kWay_m); ++k) {
    turned.push_back(run.truth[k].X_WB.theta_rad - at[k].theta_rad);
  }
  std::nth_element(turned.begin(), turned.begin() + std::ptrdiff_t(turned.size() / 2), turned.end());
  Pose2 start = run.truth.front().X_WB;
  // The first pose is kept unless it is far off: unequal wheels turn the robot a little on its first metre, too.
  constexpr double kFarOff_rad = 0.02;
  if (std::abs(turned[turned.size() / 2] - start.theta_rad) > kFarOff_rad) start.theta_rad = turned[turned.size() / 2];
  return start;
}

std::vector<Push> timed(const std::vector<LegPush>& pushes, const std::vector<Stretch>& stretches) {
  std::vector<Push> result;
  for (const LegPush& p : pushes) {
    for (const Stretch& s : stretches) {
      if (s.kind != Stretch::Kind::leg || s.leg != p.leg) continue;
      result.push_back(p.push);
      result.back().time_s += s.start_s;
      break;
    }
  }
  return result;
}

}  // namespace

Replay::Replay(const Scenario& scenario, const Recording& recording)
    : scenario_(scenario), recording_(recording), nominal_(load_scenario_robot(scenario)) {
  Rig believed;
  believed.robot = nominal_;
  apply(WheelRadiusScale{recording.robot.wheel_radius_m / nominal_.wheels[0].radius_m - 1}, believed);
  apply(Wheelbase{recording.robot.wheelbase_m / nominal_.wheelbase_m() - 1}, believed);
  nominal_ = believed.robot;
  steps_ = std::max(1, int(std::ceil(1 / recording.encoder_rate_hz / scenario.physics.step_s - 1e-9)));
  scenario_.encoders.ticks_per_revolution = recording.robot.ticks_per_revolution;
  for (const RecordedRun& run : recording.runs) {
    stretches_.push_back(umbsim::stretches(run, recording.robot));
    const bool track = recording.truth_kind == "track" && run.truth.size() > 20;
    start_.push_back(track ? start_of(run, recording.robot) : run.truth.front().X_WB);
    lag_s_.push_back(measured_lag(run, 2 * M_PI / recording.robot.ticks_per_revolution, steps_));
  }
}

Rig Replay::rig(std::size_t index, const std::vector<Effect>& effects) const {
  const RecordedRun& run = recording_.runs[index];
  Rig rig;
  rig.robot = nominal_;
  rig.encoders = scenario_.encoders;
  rig.floor.friction = scenario_.floor_friction;
  rig.run = {run.id, int(index), scenario_.seed};
  rig.drivetrain = Drivetrain(torque_limit(scenario_, nominal_));
  for (const RecordedBump& b : run.bumps) {
    Cable cable;
    cable.x_m = b.x_m;
    cable.y_m = b.y_m;
    cable.height_m = b.height_m;
    rig.floor.cables.push_back(cable);
  }
  if (run.payload_kg) {
    // The experimenter's payload, where nothing else is said: over the robot's own centre of mass.
    const Eigen::Vector3d com = rig.robot.base.com_m;
    apply(LoadShift{*run.payload_kg, com.x(), com.y(), com.z()}, rig);
  }
  return apply_effects(effects, std::move(rig));
}

std::vector<Pose2> Replay::poses(std::size_t index, const std::vector<Effect>& effects) const {
  const RecordedRun& run = recording_.runs[index];
  Rig r = rig(index, effects);
  r.encoders.ticks_per_revolution = recording_.robot.ticks_per_revolution;
  // The ticks already say what the motors did.
  for (Motor& m : r.drivetrain.motor) {
    m.gain = 1;
    m.lag_s = 0;
    m.deadband_radps = 0;
  }
  const std::vector<double> left = shaft_speeds(run, r.encoders, r.encoders.left, true, lag_s_[index], steps_);
  const std::vector<double> right = shaft_speeds(run, r.encoders, r.encoders.right, false, lag_s_[index], steps_);
  World world(r.robot, r.drivetrain, r.floor, scenario_.physics, timed(r.pushes, stretches_[index]));
  world.place(start_[index]);
  std::vector<Pose2> track;
  track.reserve(run.encoders.size());
  track.push_back(world.pose());
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    world.command(left[i], right[i]);
    world.advance(run.encoders[i].time_s - run.encoders[i - 1].time_s);
    track.push_back(world.pose());
  }
  return at_truth(run, track);
}

std::vector<std::array<double, 2>> Replay::counts(std::size_t index, const std::vector<Effect>& effects) const {
  const RecordedRun& run = recording_.runs[index];
  const Rig r = rig(index, effects);
  World world(r.robot, r.drivetrain, r.floor, scenario_.physics, timed(r.pushes, stretches_[index]));
  world.place(start_[index]);
  std::vector<std::array<double, 2>> shaft{{world.encoder_angle(0), world.encoder_angle(1)}};
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    world.command(run.encoders[i].left_command_radps, run.encoders[i].right_command_radps);
    world.advance(run.encoders[i].time_s - run.encoders[i - 1].time_s);
    shaft.push_back({world.encoder_angle(0), world.encoder_angle(1)});
  }
  return arrived(shaft, run.encoders, r.encoders);
}

std::array<double, 5> Replay::habits(const std::vector<Effect>& effects) const {
  const Rig r = rig(0, effects);
  const double period_s = 1 / recording_.encoder_rate_hz;
  return {std::log(r.demand.acceleration_factor), std::log(r.demand.acceleration_factor * r.demand.turn_speed_factor),
          std::log(r.demand.turn_speed_factor), std::log(std::max(1.0, r.encoders.sampling_interval_s / period_s)),
          std::log(r.encoders.ticks_per_revolution / recording_.robot.ticks_per_revolution)};
}

Scenario scenario_of(const Recording& recording, const std::string& directory) {
  Scenario s;
  s.file = (std::filesystem::path(directory) / "recording.yaml").string();
  s.name = "twin";
  if (!recording.robot.urdf.empty()) s.robot.urdf = recording.robot.urdf;
  s.encoders.ticks_per_revolution = recording.robot.ticks_per_revolution;
  s.encoders.rate_hz = recording.encoder_rate_hz;
  const RecordedPath& p = recording.path;
  if (p.side_m > 0) s.course.side_m = p.side_m;
  s.course.turn = p.turn;
  if (p.turn_radius_m) s.course.turn_radius_m = *p.turn_radius_m;
  if (p.linear_speed_mps) s.course.linear_speed_mps = *p.linear_speed_mps;
  if (p.angular_speed_radps) s.course.angular_speed_radps = *p.angular_speed_radps;
  if (p.linear_acceleration_mps2) s.course.linear_acceleration_mps2 = *p.linear_acceleration_mps2;
  if (p.angular_acceleration_radps2) s.course.angular_acceleration_radps2 = *p.angular_acceleration_radps2;
  s.truth.kind = recording.truth_kind;
  s.truth.position_sd_m = recording.truth_position_sd_m;
  s.truth.heading_sd_rad = recording.truth_heading_sd_rad;
  return s;
}

}  // namespace umbsim

#include "bench/worlds/run/run_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::worlds {
namespace {

constexpr double kSlice_s = 0.02;
constexpr double kJump_s = 0.001;
constexpr double kGrain_m = 0.002;  // of rough tyres: shorter ones would need rolling radii that no wheel has
constexpr double kGravity_mps2 = 9.81;

}  // namespace

RunClock::RunClock(Engine& engine, const Rig& rig, const std::vector<OutsideEffect>& outside, double roughness,
                   std::uint64_t seed, std::size_t number)
    : engine_(engine),
      rig_(rig),
      outside_(outside),
      roughness_(roughness),
      grains_{Grain{{seed, "worlds left rolling", number}}, Grain{{seed, "worlds right rolling", number}}},
      weight_n_(rig.robot.total_mass_kg() * kGravity_mps2),
      drift_{rig.floor.drift_x, rig.floor.drift_y} {
  for (const OutsideEffect& e : outside_) memories_.push_back({{seed, "worlds " + e.info->name, number}, {}});
  truth_.push_back({0, engine_.pose()});
}

void RunClock::begin_leg(int leg, const std::vector<LegPush>& pushes) {
  for (const LegPush& p : pushes) {
    if (p.leg != leg) continue;
    pushes_.push_back(p.push);
    pushes_.back().time_s += time_s_;
  }
}

void RunClock::advance(const WheelSpeeds& command, double period_s, bool jump) {
  double left_s = period_s;
  const WheelSpeeds from = last_;
  if (jump) {
    slice(command, kJump_s);
    left_s -= kJump_s;
  }
  const int slices = std::max(1, int(std::ceil(left_s / kSlice_s - 1e-9)));
  for (int k = 1; k <= slices; ++k) {
    const double part = jump ? 1 : double(k) / slices;
    slice({from.left_radps + part * (command.left_radps - from.left_radps),
           from.right_radps + part * (command.right_radps - from.right_radps)},
          left_s / slices);
  }
  last_ = command;
}

// White noise along the path: a grain of length l has a relative radius of variance k^2 / l (as experiment/
// rolling_noise.h).
double RunClock::rough(std::size_t wheel, double planned_m) {
  Grain& g = grains_[wheel];
  if (roughness_ == 0) return 1;
  g.left_m -= planned_m;
  if (g.left_m > 0 || planned_m == 0) return g.factor;
  g.left_m = std::max(planned_m, kGrain_m);
  g.factor = 1 + roughness_ / std::sqrt(g.left_m) * g.random.normal();
  g.left_m -= planned_m;
  return g.factor;
}

Acts RunClock::acts(const Moment& now) {
  Acts acts;
  for (std::size_t i = 0; i < outside_.size(); ++i) outside_[i].info->act(outside_[i].values, now, memories_[i], acts);
  return acts;
}

// The mean force of all pushes over the next slice.
Pull RunClock::pushed(double slice_s) const {
  Pull pull;
  const double heading_rad = engine_.pose().theta_rad;
  for (const Push& p : pushes_) {
    const double overlap_s = std::min(time_s_ + slice_s, p.time_s + p.duration_s) - std::max(time_s_, p.time_s);
    if (overlap_s <= 0) continue;
    const double force_n = p.impulse_ns / p.duration_s * overlap_s / slice_s;
    pull.force_x_n += force_n * std::cos(heading_rad + p.direction_rad);
    pull.force_y_n += force_n * std::sin(heading_rad + p.direction_rad);
    pull.ahead_m = p.ahead_m;
    pull.height_m = p.height_m;
  }
  return pull;
}

void RunClock::slice(const WheelSpeeds& command, double slice_s) {
  const auto& wheels = rig_.robot.wheels;
  const Moment now{time_s_,
                   slice_s,
                   engine_.pose(),
                   wheel_rad_,
                   wheel_radps_,
                   {wheels[0].radius_m, wheels[1].radius_m},
                   rig_.robot.wheelbase_m(),
                   weight_n_};
  Acts a = acts(now);
  const Pull push = pushed(slice_s);
  if (push.force_x_n != 0 || push.force_y_n != 0) a.pull = push;  // nothing of the table pulls as hard
  const bool pulls = a.pull.force_x_n != 0 || a.pull.force_y_n != 0 || a.pull.yaw_nm != 0;
  if (pulls || pulled_) engine_.set_pull(a.pull);
  pulled_ = pulls;
  const std::array<double, 2> drift{rig_.floor.drift_x + a.drift_x, rig_.floor.drift_y + a.drift_y};
  if (drift != drift_) engine_.set_carpet_drift(drift[0], drift[1]);
  drift_ = drift;
  const double speeds[] = {command.left_radps * a.command[0], command.right_radps * a.command[1]};
  for (std::size_t i = 0; i < 2; ++i) {
    const double factor = a.rolling[i] * rough(i, std::abs(speeds[i]) * slice_s * wheels[i].radius_m);
    if (factor != rolling_[i]) engine_.set_rolling_factor(int(i), factor);
    rolling_[i] = factor;
  }
  engine_.advance({speeds[0], speeds[1]}, slice_s);
  time_s_ += slice_s;
  for (std::size_t i = 0; i < 2; ++i) {
    const double wheel = engine_.wheel_angle(int(i)), encoder = engine_.encoder_angle(int(i));
    wheel_radps_[i] = (wheel - wheel_rad_[i]) / slice_s;
    wheel_rad_[i] = wheel;
    shaft_rad_[i] += a.counted[i] * (encoder - encoder_rad_[i]);
    encoder_rad_[i] = encoder;
  }
  truth_.push_back({time_s_, engine_.pose()});
}

}  // namespace umbsim::worlds

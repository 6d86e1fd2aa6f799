#include "experiment/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "core/error.h"
#include "effects/geometry.h"
#include "experiment/drive/drive_run.h"
#include "experiment/drive/rolling_noise.h"
#include "experiment/replay/even_stretches.h"
#include "experiment/replay/recorded_shafts.h"
#include "experiment/replay/seen_track.h"
#include "recording/coarse_counts.h"
#include "recording/encoder_clock.h"

namespace umbsim {
namespace {

// A supposed resolution within this share of what the counts show is theirs, which they show much finer.
constexpr double kSameStep = 0.1;

// At a place, or at a moment.
bool acts_somewhere(const Effect& e) {
  const std::string& name = e.info->name;
  return name == "bump" || name == "slippery_patch" || name == "wheel_lift" || name == "push";
}

Pose2 between(const Pose2& a, const Pose2& b, double part) {
  return {a.x_m + part * (b.x_m - a.x_m), a.y_m + part * (b.y_m - a.y_m),
          a.theta_rad + part * (b.theta_rad - a.theta_rad)};
}

// Poses at the encoders' samples -> poses at the truth's.
std::vector<Pose2> at_truth(const RecordedRun& run, const std::vector<Pose2>& track) {
  std::vector<Pose2> result;
  result.reserve(run.truth.size());
  EncoderClock clock(run.encoders);
  for (const TruthSample& truth : run.truth) {
    const auto m = clock.at(truth.time_s);
    result.push_back(between(track[m.before], track[m.before + 1], m.share));
  }
  return result;
}

// The pose at the start, from the first metre of the track: single poses are noisy, the first one may be wrong. What
// comes after a turn says little: the believed wheelbase may be off.
Pose2 start_of(const RecordedRun& run, const RecordedRobot& robot) {
  constexpr double kWay_m = 1;
  constexpr double kTurn_rad = 0.3;
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
  const auto near = [&](const Pose2& p) {
    return std::hypot(p.x_m, p.y_m) < kWay_m && std::abs(p.theta_rad) < kTurn_rad;
  };
  for (std::size_t k = 0; k < at.size() && (k < 3 || near(at[k])); ++k) {
    turned.push_back(run.truth[k].X_WB.theta_rad - at[k].theta_rad);
  }
  std::nth_element(turned.begin(), turned.begin() + std::ptrdiff_t(turned.size() / 2), turned.end());
  Pose2 start = run.truth.front().X_WB;
  // The first pose is kept unless it is far off: unequal wheels turn the robot a little on its first metre, too.
  constexpr double kFarOff_rad = 0.02;
  if (std::abs(turned[turned.size() / 2] - start.theta_rad) > kFarOff_rad) start.theta_rad = turned[turned.size() / 2];
  return start;
}

// What `work` makes of a run. Robots that were recorded did not tip over.
template <class Work>
auto of_run(const RecordedRun& run, const Work& work) {
  try {
    return work();
  } catch (const TippedOver& e) {
    throw RunError(
        fmt::format("run {}: driven as it was recorded, {}. The recorded robot did not: look at the centre of "
                    "mass, masses and casters in its URDF, and at loads in the scenario",
                    run.id, e.what()));
  }
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

Replay::Replay(const Scenario& scenario, const Recording& recording, bool by_tracker, int first_run)
    : scenario_(scenario),
      recording_(recording),
      by_tracker_(by_tracker && recording.truth_kind == "track"),
      first_run_(first_run),
      nominal_(load_scenario_robot(scenario)) {
  Rig believed;
  believed.robot = nominal_;
  apply(WheelRadiusScale{recording.robot.wheel_radius_m / nominal_.wheels[0].radius_m - 1}, believed);
  apply(Wheelbase{recording.robot.wheelbase_m / nominal_.wheelbase_m() - 1}, believed);
  nominal_ = believed.robot;
  scenario_.physics.may_lean = true;
  steps_ = std::max(1, int(std::ceil(1 / recording.encoder_rate_hz / scenario.physics.step_s - 1e-9)));
  scenario_.encoders.ticks_per_revolution = recording.robot.ticks_per_revolution;
  count_step_ = umbsim::count_step(recording);
  as_declared_ = asked({});
  for (const RecordedRun& run : recording.runs) {
    stretches_.push_back(umbsim::stretches(run, recording.robot));
    const bool track = recording.truth_kind == "track" && run.truth.size() > 20;
    start_.push_back(track ? start_of(run, recording.robot) : run.truth.front().X_WB);
    lag_.push_back(measured_lag(run, recording.robot, steps_));
  }
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const Rig as_it_is = rig(r, {});
    believed_.push_back(as_it_is.encoders);
    shafts_.push_back(shafts(r, as_it_is));
    even_.push_back(even(r, shafts_.back()));
  }
}

Rig Replay::rig(std::size_t index, const std::vector<Effect>& effects) const {
  const RecordedRun& run = recording_.runs[index];
  Rig rig;
  rig.robot = nominal_;
  rig.encoders = scenario_.encoders;
  rig.floor.friction = scenario_.floor_friction;
  rig.run = {run.id, first_run_ + int(index), scenario_.seed};
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
  return apply_effects(combined(scenario_.effects, effects), std::move(rig));
}

// Width of the encoders' steps in counts of the recording, where they are supposed to be coarser and are; else 1.
double Replay::coarse_step(const Rig& rig) const {
  const double supposed = recording_.robot.ticks_per_revolution / rig.encoders.ticks_per_revolution;
  return supposed > 1 && std::abs(std::log(supposed / count_step_)) < kSameStep ? count_step_ : 1;
}

std::vector<Pose2> Replay::poses(std::size_t index, const std::vector<Effect>& effects,
                                 double roughness_m_per_sqrt_m) const {
  return of_run(recording_.runs[index], [&] {
    std::vector<Pose2> track = driven(index, effects, roughness_m_per_sqrt_m);
    if (roughness_m_per_sqrt_m == 0) return at_truth(recording_.runs[index], track);
    const std::vector<Pose2> mirrored = driven(index, effects, -roughness_m_per_sqrt_m);
    for (std::size_t i = 0; i < track.size(); ++i) track[i] = between(track[i], mirrored[i], 0.5);
    return at_truth(recording_.runs[index], track);
  });
}

double Replay::wheel_width_m() const {
  if (recording_.robot.urdf.empty()) return 0;
  return std::min(nominal_.wheels[0].width_m, nominal_.wheels[1].width_m);
}

bool Replay::scrubs(const std::vector<Effect>& effects) const {
  const std::vector<Effect> all = combined(scenario_.effects, effects);
  const auto has = [&](const char* name) {
    return std::any_of(all.begin(), all.end(), [&](const Effect& e) { return e.info->name == name; });
  };
  return has("wheel_misalignment") && !has("tyre_creep");
}

// The rig whose shafts turn as counted, whatever the motors do: the ticks already say what they did, and where their
// torque ended. A wheel without a motor still has none.
Rig Replay::shafts_as_counted(Rig r) const {
  constexpr double kAnyTorque_nm = 1e6;
  r.encoders.ticks_per_revolution = recording_.robot.ticks_per_revolution;
  for (Motor& m : r.drivetrain.motor) {
    if (m.torque_limit_nm > 0) m.torque_limit_nm = kAnyTorque_nm;
    m.gain = 1;
    m.lag_s = 0;
    m.droop_radps_per_nm = 0;
    m.deadband_radps = 0;
  }
  return r;
}

std::array<std::vector<double>, 2> Replay::shafts(std::size_t index, const Rig& supposed) const {
  const RecordedRun& run = recording_.runs[index];
  const double step = coarse_step(supposed);
  EncoderSpec e = supposed.encoders;
  e.ticks_per_revolution = recording_.robot.ticks_per_revolution;
  return {shaft_speeds(run, e, e.left, true, lag_[index], steps_, step),
          shaft_speeds(run, e, e.right, false, lag_[index], steps_, step)};
}

std::shared_ptr<const EvenStretches> Replay::even(std::size_t index,
                                                  const std::array<std::vector<double>, 2>& shafts) const {
  const std::vector<EncoderSample>& samples = recording_.runs[index].encoders;
  return std::make_shared<const EvenStretches>(
      even_stretches(samples, {turned_by(samples, shafts[0], steps_), turned_by(samples, shafts[1], steps_)},
                     {nominal_.wheels[0].radius_m, nominal_.wheels[1].radius_m}, nominal_.wheelbase_m()));
}

// The way of the shafts decides how rough the floor is under the wheels, whatever else happens to the robot.
ShaftDrive Replay::drive_of(std::size_t index, const Rig& supposed, double roughness_m_per_sqrt_m) const {
  const bool as_believed = supposed.encoders == believed_[index];
  auto turning = as_believed ? shafts_[index] : shafts(index, supposed);
  auto stretches = as_believed ? even_[index] : even(index, turning);
  ShaftDrive drive{recording_.runs[index].encoders, std::move(turning[0]), std::move(turning[1]), start_[index],
                   std::move(stretches)};
  if (roughness_m_per_sqrt_m == 0) return drive;
  RollingNoise rolling(roughness_m_per_sqrt_m, supposed);
  std::array<double, 2> shaft_rad{};
  drive.rolling.assign(drive.samples.size(), {1, 1});
  for (std::size_t i = 1; i < drive.samples.size(); ++i) {
    const double period_s = drive.period_s(i);
    drive.rolling[i] = rolling.next(shaft_rad, {drive.left_radps[i], drive.right_radps[i]}, period_s);
    shaft_rad[0] += drive.left_radps[i] * period_s;
    shaft_rad[1] += drive.right_radps[i] * period_s;
  }
  return drive;
}

// Poses at the encoders' samples.
std::vector<Pose2> Replay::driven(std::size_t index, const std::vector<Effect>& effects,
                                  double roughness_m_per_sqrt_m) const {
  const Rig supposed = rig(index, effects);
  const Rig r = shafts_as_counted(supposed);
  const std::vector<Push> pushes = timed(r.pushes, stretches_[index]);
  World world(r.robot, r.drivetrain, r.floor, scenario_.physics, pushes);
  const bool local = !r.floor.cables.empty() || !r.floor.patches.empty() || !pushes.empty();
  if (!local || !same_everywhere(r.floor)) {
    ShaftDrive drive = drive_of(index, supposed, roughness_m_per_sqrt_m);
    return drive.rolling.empty() ? rolled(world, drive) : traced(world, std::move(drive), false).track;
  }
  std::vector<Effect> elsewhere;
  std::copy_if(effects.begin(), effects.end(), std::back_inserter(elsewhere),
               [](const Effect& e) { return !acts_somewhere(e); });
  const std::string key = fmt::format("{} {:a}\n", index, roughness_m_per_sqrt_m) + bytes_of(elsewhere);
  const auto without = traces_->get(key, [&] {
    Floor bare = r.floor;
    bare.cables.clear();
    bare.patches.clear();
    World plain(r.robot, r.drivetrain, bare, scenario_.physics);
    TracedRun run = traced(plain, drive_of(index, supposed, roughness_m_per_sqrt_m));
    if (by_tracker_) run.seen = seen_beside(recording_.runs[index], run.track, TracedRun::kEvery);
    return std::make_shared<const TracedRun>(std::move(run));
  });
  return driven_near(world, r, pushes, *without);
}

std::vector<std::array<double, 2>> Replay::counts(std::size_t index, const std::vector<Effect>& effects) const {
  const RecordedRun& run = recording_.runs[index];
  const Rig r = rig(index, effects);
  World world(r.robot, r.drivetrain, r.floor, scenario_.physics, timed(r.pushes, stretches_[index]));
  world.place(start_[index]);
  std::vector<std::array<double, 2>> shaft{{world.encoder_angle(0), world.encoder_angle(1)}};
  of_run(run, [&] {
    for (std::size_t i = 1; i < run.encoders.size(); ++i) {
      world.command(run.encoders[i].left_command_radps, run.encoders[i].right_command_radps);
      world.advance(run.encoders[i].time_s - run.encoders[i - 1].time_s);
      shaft.push_back({world.encoder_angle(0), world.encoder_angle(1)});
    }
  });
  const double step = coarse_step(r);
  const double step_rad = step > 1 ? 2 * M_PI / recording_.robot.ticks_per_revolution * step : 0;
  return arrived(shaft, run.encoders, r.encoders, step_rad);
}

}  // namespace umbsim

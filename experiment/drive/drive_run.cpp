#include "experiment/drive/drive_run.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "experiment/drive/cable_layer.h"
#include "experiment/drive/commanded_course.h"
#include "experiment/drive/recorder.h"
#include "experiment/drive/rolling_noise.h"
#include "experiment/drive/tip_over.h"

namespace umbsim {
namespace {

// Wheels of the run: the scatter of their radii (wear, temperature, load), the same for the whole run.
void scatter_radii(Rig& rig, double sd) {
  if (sd == 0) return;
  RandomStream random(rig.run.seed, "radius scatter", std::uint64_t(rig.run.number));
  for (Wheel& wheel : rig.robot.wheels) wheel.radius_m *= 1 + random.normal(0, sd);
}

// No speed control is exact.
void scatter_motors(Rig& rig, double sd) {
  if (sd == 0) return;
  RandomStream random(rig.run.seed, "motor scatter", std::uint64_t(rig.run.number));
  for (Motor& motor : rig.drivetrain.motor) motor.gain *= 1 + random.normal(0, sd);
}

// Pushes during a leg as pushes during the run. Legs that the course does not have are never pushed.
std::vector<Push> timed(const std::vector<LegPush>& pushes, const Plan& plan) {
  std::vector<Push> result;
  for (const LegPush& p : pushes) {
    const auto segment = plan.leg_segment(p.leg);
    if (!segment) continue;
    result.push_back(p.push);
    result.back().time_s += plan.segments()[*segment].start_s;
  }
  return result;
}

// Tells of each lap once.
class Laps {
 public:
  explicit Laps(const RunOutput& output) : output_(output) {}
  void done(int laps) {
    for (; told_ < laps; ++told_) {
      if (output_.lap_done) output_.lap_done();
    }
  }

 private:
  const RunOutput& output_;
  int told_ = 0;
};

Encoder encoder(const Rig& rig, const EncoderFaults& faults, const char* stream) {
  return {rig.encoders, faults, RandomStream(rig.run.seed, stream, std::uint64_t(rig.run.number))};
}

}  // namespace

Rig rig_for(const Scenario& s, const RobotModel& nominal, const RunSpec& spec) {
  Rig rig;
  rig.robot = nominal;
  rig.encoders = s.encoders;
  rig.floor.friction = s.floor_friction;
  rig.run = {spec.id, spec.number, s.seed};
  rig.drivetrain = Drivetrain(torque_limit(s, nominal));
  if (spec.bumped) rig.floor.cables = s.bumps.fixed;
  rig.floor.ripples =
      random_ripples(s.noise.floor_rms_m, s.noise.floor_wavelength_m, s.seed, std::uint64_t(spec.number));
  scatter_radii(rig, s.noise.radius_scatter);
  rig = apply_effects(s.effects, std::move(rig));
  scatter_motors(rig, s.noise.motor_scatter);
  return rig;
}

double torque_limit(const Scenario& s, const RobotModel& robot) {
  if (s.robot.torque_limit_nm > 0) return s.robot.torque_limit_nm;
  const double effort = std::min(robot.wheels[0].effort_limit_nm, robot.wheels[1].effort_limit_nm);
  if (effort > 0) return effort;
  // The whole weight on one wheel, at the friction limit: more torque than this a wheel cannot pass on.
  return s.floor_friction * robot.total_mass_kg() * s.physics.gravity_mps2 * robot.wheels[0].radius_m;
}

namespace {

WheelMoment wheels_of(const World& world) {
  WheelMoment now;
  for (int i = 0; i < 2; ++i) {
    now.angle_rad[std::size_t(i)] = world.wheel_angle(i);
    now.load_n[std::size_t(i)] = world.loads().wheel_n[std::size_t(i)];
    now.slid_s[std::size_t(i)] = world.strain(i).slid_s;
  }
  return now;
}

DrivenRun drive_plan(const Scenario& scenario, const Rig& rig, const Plan& plan, const OdometryParameters& odometry,
                     const RunSpec& spec, const RunOutput& output) {
  const DriveGeometry believed{odometry.left_radius_m, odometry.right_radius_m, odometry.wheelbase_m};
  const double period_s = 1 / scenario.encoders.rate_hz;
  const int driven = int(std::ceil(plan.duration_s() / period_s));
  const int periods = driven + int(std::ceil(kRest_s / period_s));

  World world(rig.robot, rig.drivetrain, rig.floor, scenario.physics, timed(rig.pushes, plan));
  world.place({0, 0, scenario.runs.start_heading_rad});
  UncertainReckoning reckoning(odometry, scenario.uncertainty);
  Encoder left_encoder = encoder(rig, rig.encoders.left, "left encoder");
  Encoder right_encoder = encoder(rig, rig.encoders.right, "right encoder");
  RollingNoise rolling(scenario.noise.wheel_noise_m_per_sqrt_m, rig);
  CableLayer cables(scenario, spec, plan);
  TrackKeeper track(scenario, spec, plan, output.rows);
  Recorder recorder(scenario, spec, odometry, periods, output);
  Laps laps(output);
  WheelSpeeds command;
  int segment = 0;
  for (int period = 0;; ++period) {
    const double time_s = period * period_s;
    const std::int64_t left = left_encoder.read(time_s, world.encoder_angle(0));
    const std::int64_t right = right_encoder.read(time_s, world.encoder_angle(1));
    reckoning.update(left, right);
    segment = plan.at(time_s, segment).segment;
    laps.done((plan.segments()[std::size_t(segment)].leg - 1) / legs_per_lap(scenario.course));
    track.fix_if_due(segment, world.pose(), reckoning);
    recorder.encoders(time_s, left, right, command);
    if (recorder.truth_is_due(period)) {
      recorder.truth(time_s, world.pose(), track.note(world.pose(), reckoning), wheels_of(world));
    }
    if (period == periods) break;
    cables.lay_if_due(reckoning.pose(), segment, world, rig, recorder.run());
    command = period < driven ? drive(plan, time_s, period_s, reckoning.pose(), believed, segment) : WheelSpeeds{};
    rolling.roughen(world, command, period_s);
    world.command(command.left_radps, command.right_radps);
    world.advance(period_s);
  }
  laps.done(scenario.course.laps);
  DrivenRun result = recorder.finish();
  result.track = std::move(track.track);
  result.cost = world.cost();
  result.strain = {{world.strain(0), world.strain(1)}, periods * period_s};
  result.cables = cables.count();
  return result;
}

}  // namespace

DrivenRun drive_run(const Scenario& scenario, const RobotModel& nominal, const OdometryParameters& odometry,
                    const RunSpec& spec, const RunOutput& output) {
  const Rig rig = rig_for(scenario, nominal, spec);
  const Plan plan(commanded(scenario.course, rig.commanded_motion), spec.direction);
  try {
    return drive_plan(scenario, rig, plan, odometry, spec, output);
  } catch (const TippedOver& e) {
    throw RunError(tip_over_message(e.fall, scenario, rig, plan, spec));
  }
}

}  // namespace umbsim

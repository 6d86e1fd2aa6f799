#include "bench/fidelity/robots.h"

#include <cmath>

#include "sim/model/inertia.h"

namespace umbsim::fidelity {
namespace {

constexpr double kHeldPeriod_s = 0.02;

RobotModel with_wheels(RobotModel robot, double radius_m, double wheelbase_m) {
  for (int i = 0; i < 2; ++i) {
    robot.wheels[i].centre_m = {0, (i == 0 ? 1 : -1) * wheelbase_m / 2, 0};
    robot.wheels[i].radius_m = radius_m;
  }
  for (Caster& c : robot.casters) c.centre_m.z() = c.radius_m - radius_m;
  return robot;
}

}  // namespace

RobotModel labmate(double radius_m, double wheelbase_m) {
  static const RobotModel robot = load_robot(UMBSIM_ROBOTS_DIR "/labmate.urdf");
  return with_wheels(robot, radius_m, wheelbase_m);
}

RobotModel optiodom(double radius_m, double wheelbase_m) {
  static const RobotModel robot = load_robot(UMBSIM_ROBOTS_DIR "/optiodom.urdf");
  return with_wheels(robot, radius_m, wheelbase_m);
}

Body body_of(const RobotModel& robot) {
  Inertial all = robot.base;
  for (const Wheel& w : robot.wheels) {
    const Eigen::Vector3d moments(w.transverse_inertia_kgm2, w.spin_inertia_kgm2, w.transverse_inertia_kgm2);
    all = lumped(all, {w.mass_kg, w.centre_m, moments.asDiagonal()});
  }
  const Wheel& wheel = robot.wheels[0];
  const Caster& ball = robot.casters.at(0);
  const Eigen::Vector3d above_floor(0, 0, wheel.radius_m);
  return {all.mass_kg,       all.com_m + above_floor, all.inertia_kgm2, robot.wheelbase_m() / 2, ball.centre_m.x(),
          ball.centre_m.y(), ball.friction,           wheel.radius_m,   wheel.spin_inertia_kgm2};
}

PhysicsOptions rigid(double step_s) {
  PhysicsOptions options;
  options.softness.static_sink_m = 0;
  options.step_s = step_s;
  return options;
}

void hold(World& world, double left_radps, double right_radps, double seconds) {
  for (int i = 0; i < std::lround(seconds / kHeldPeriod_s); ++i) {
    world.command(left_radps, right_radps);
    world.advance(kHeldPeriod_s);
  }
}

void trip(World& world, double left_radps, double right_radps, double seconds, double ramp_s) {
  const int ramp = int(std::lround(ramp_s / kHeldPeriod_s));
  for (int i = 1; i <= ramp; ++i) hold(world, left_radps * i / ramp, right_radps * i / ramp, kHeldPeriod_s);
  hold(world, left_radps, right_radps, seconds);
  for (int i = ramp - 1; i >= 0; --i) hold(world, left_radps * i / ramp, right_radps * i / ramp, kHeldPeriod_s);
  hold(world, 0, 0, 0.4);
}

}  // namespace umbsim::fidelity

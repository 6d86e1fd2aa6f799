#include "bench/fidelity/cable.h"

#include <cmath>

#include "core/pose2.h"

namespace umbsim::fidelity {
namespace {

constexpr double kBefore_m = 0.10;  // from the start to the cable's middle
constexpr double kBehind_m = 0.10;  // from there to the stop
constexpr double kAcceleration_mps2 = 0.5;

}  // namespace

Climb closed_form(double radius_m, double cable_height_m) {
  const double R = radius_m, r = cable_height_m / 2;
  const double psi = std::acos((R - r) / (R + r));
  return {2 * (R + r) * psi - 4 * std::sqrt(R * r), std::tan(psi)};
}

CableOutcome cross(const CableCase& c) {
  const double radius_m = c.robot.wheels[0].radius_m;
  Floor floor;
  floor.friction = c.friction;
  World world(c.robot, {20}, floor, c.options);
  world.place({});
  Cable cable;
  cable.x_m = kBefore_m;
  cable.y_m = c.robot.wheels[c.wheel].centre_m.y();
  cable.height_m = c.height_m;
  world.lay_cable(cable);
  const double seconds = (kBefore_m + kBehind_m) / c.speed_mps;
  const double ramp_s = std::ceil(c.speed_mps / kAcceleration_mps2 / 0.02) * 0.02;
  trip(world, c.speed_mps / radius_m, c.speed_mps / radius_m, seconds, ramp_s);
  CableOutcome out;
  out.crossed = world.wheel_centre(c.wheel).x() > cable.x_m + 0.5 * kBehind_m;
  const double odometry_rad = radius_m * (world.wheel_angle(1) - world.wheel_angle(0)) / c.robot.wheelbase_m();
  out.heading_rad = (c.wheel == 0 ? 1 : -1) * (world.pose().theta_rad - odometry_rad);
  out.ratio = out.heading_rad * c.robot.wheelbase_m() / closed_form(radius_m, c.height_m).extra_path_m;
  out.solver_fallbacks = world.cost().solver_fallbacks;
  return out;
}
}

#include "bench/fidelity/contact/cable.h"

#include <cmath>

namespace umbsim::fidelity {
namespace {

constexpr double kBefore_m = 0.10;  // from the start to the cable's middle
constexpr double kBehind_m = 0.10;  // from there to the stop
constexpr double kAcceleration_mps2 = 0.5;
constexpr double kPeriod_s = 0.02;

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
  const double ramp_s = std::ceil(c.speed_mps / kAcceleration_mps2 / kPeriod_s) * kPeriod_s;
  trip(world, c.speed_mps / radius_m, c.speed_mps / radius_m, seconds, ramp_s);
  CableOutcome out;
  out.crossed = world.wheel_centre(c.wheel).x() > cable.x_m + 0.5 * kBehind_m;
  const double odometry_rad = radius_m * (world.wheel_angle(1) - world.wheel_angle(0)) / c.robot.wheelbase_m();
  out.heading_rad = (c.wheel == 0 ? 1 : -1) * (world.pose().theta_rad - odometry_rad);
  out.ratio = out.heading_rad * c.robot.wheelbase_m() / closed_form(radius_m, c.height_m).extra_path_m;
  out.X_WB = world.pose();
  out.solver_fallbacks = world.cost().solver_fallbacks;
  out.simulated_s = world.cost().simulated_s;
  return out;
}

CableCase in_rigid_limit(CableCase c, double sink_share) {
  c.options.softness.static_sink_m = sink_share * c.height_m;
  c.options.fine_step_s = 0.0001;
  c.speed_mps = 0.02;
  return c;
}

std::vector<CableCase> cable_grid(Grid grid) {
  std::vector<CableCase> cases;
  const auto add = [&](const char* name, const RobotModel& robot, double height_m, double friction) {
    cases.push_back({robot, name, height_m, friction, 0.2, 0, {}});
  };
  if (grid == Grid::coarse) {
    for (const double height_m : {0.004, 0.010}) {
      for (const double friction : {0.5, 0.9}) {
        add("LabMate", labmate(), height_m, friction);
        add("OptiOdom", optiodom(), height_m, friction);
      }
    }
    return cases;
  }
  for (const double height_m : {0.004, 0.006, 0.010}) {
    for (const double friction : {0.4, 0.6, 0.9}) {
      for (const double radius_m : {0.075, 0.100}) add("LabMate", labmate(radius_m), height_m, friction);
      for (const double radius_m : {0.042, 0.060}) add("OptiOdom", optiodom(radius_m), height_m, friction);
    }
  }
  return cases;
}

}  // namespace umbsim::fidelity

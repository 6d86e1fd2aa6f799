#include "bench/fidelity/contact/cone.h"

#include <fmt/format.h>

#include <cmath>

#include "bench/fidelity/plane_dynamics.h"

namespace umbsim::fidelity {
namespace {

constexpr double kSlope_rad = 20 * M_PI / 180;
constexpr double kFriction = 0.25;      // friction angle 14 degrees; larger, and the small robot would tip
constexpr double kSettle_s = 0.2;       // World::place settles for so long: the robot already slides
constexpr double kSlide_s = 0.5;
constexpr double kInterval_s = 0.2;

Floor slope() {
  Floor floor;
  floor.friction = kFriction;
  floor.slope_rad = kSlope_rad;
  return floor;
}

World on_slope(const RobotModel& robot, double heading_rad, const PhysicsOptions& options, bool left_free = false) {
  Drivetrain motors(20);
  if (left_free) motors.motor[0].torque_limit_nm = 0;
  World world(robot, motors, slope(), options);
  world.place({0, 0, heading_rad});
  return world;
}

// Second difference along the direction of fall.
double acceleration(World& world) {
  double x_m[3];
  for (double& x : x_m) {
    hold(world, 0, 0, kInterval_s);
    x = world.pose().x_m;
  }
  return (x_m[2] - 2 * x_m[1] + x_m[0]) / (kInterval_s * kInterval_s);
}

}  // namespace

DownhillSlide slide_downhill(const RobotModel& shipped, double heading_rad, const PhysicsOptions& options) {
  RobotModel robot = shipped;
  robot.casters[0].friction = kFriction;
  World world = on_slope(robot, heading_rad, options);
  const double measured = acceleration(world);
  const Pose2 X_WB = world.pose();
  const double expected = kG_mps2 * (std::sin(kSlope_rad) - kFriction * std::cos(kSlope_rad));
  return {heading_rad, std::atan2(X_WB.y_m, X_WB.x_m), X_WB.theta_rad - heading_rad, measured / expected};
}

double ball_share_ratio(const RobotModel& robot, int sense, const PhysicsOptions& options) {
  const Body b = body_of(robot);
  World world = on_slope(robot, sense > 0 ? 0 : M_PI, options);
  const double share = (b.ball_x_m - b.com_m.x()) / (b.ball_x_m + sense * kFriction * b.com_m.z());
  const double expected = kG_mps2 * (std::sin(kSlope_rad) - kFriction * std::cos(kSlope_rad) * share);
  return acceleration(world) / expected;
}

TurningSlide slide_and_turn(const RobotModel& robot, bool left_free, double heading_rad) {
  const auto end = [&](double step_s) {
    World world = on_slope(robot, heading_rad, rigid(step_s), left_free);
    hold(world, 0, 0, kSlide_s);
    return world.pose();
  };
  const SlopeState expected =
      integrate({body_of(robot), kSlope_rad, kFriction, {!left_free, true}, heading_rad}, kSettle_s + kSlide_s);
  const Pose2& goal = expected.X_WB;
  const auto off = [&](const Pose2& X_WB) {
    return EndError{std::hypot(X_WB.x_m - goal.x_m, X_WB.y_m - goal.y_m), X_WB.theta_rad - goal.theta_rad};
  };
  const Pose2 fine = end(0.001), twice = end(0.002);
  const Pose2 limit{2 * fine.x_m - twice.x_m, 2 * fine.y_m - twice.y_m, 2 * fine.theta_rad - twice.theta_rad};
  return {heading_rad,
          std::hypot(goal.x_m, goal.y_m),
          goal.theta_rad - heading_rad,
          off(end(PhysicsOptions{}.step_s)),
          off(fine),
          off(limit),
          expected.least_load_n};
}

std::vector<double> slide_headings(Grid grid) {
  // Not exactly uphill: there the frictionless ball makes an unstable balance.
  const int count = grid == Grid::full ? 16 : 4;
  std::vector<double> headings;
  for (int i = 0; i < count; ++i) headings.push_back(0.1 + 2 * M_PI * i / count);
  return headings;
}

}  // namespace umbsim::fidelity

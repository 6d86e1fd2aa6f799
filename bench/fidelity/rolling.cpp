#include "bench/fidelity/rolling.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/fidelity/table.h"
#include "core/pose2.h"

namespace umbsim::fidelity {
namespace {

constexpr double kSpeed_radps = 2;
constexpr double kSlow_radps = 1;  // of the eccentric wheel
constexpr int kRevolutions = 4;

constexpr const char* kRollingText = R"(## 6. Rolling

**Distance and arcs.** Wheels that turn by φ_L and φ_R in a constant ratio roll R φ_L and R φ_R on two concentric circles:
the robot turns by R (φ_R - φ_L) / b and its middle advances R (φ_R + φ_L) / 2 along the arc. Ramps of 1 s, 10 s of
driving. The contacts creep by 1e-9 m/s per newton (see [physics.md](physics.md)); nothing else is left, at any step.

)";

constexpr const char* kToeText =
    R"(**Toe and skew.** Both wheels turned by δ in the same sense: nothing slides, the robot moves askew, along δ, by R φ.
Toe-in (each wheel towards the other): equal loads drag sideways against each other; along the robot the drag must be
zero, so the slip has no part along it, and the robot advances R φ cos δ, straight.

)";

constexpr const char* kEccentricText =
    R"(**Eccentric wheel.** The left rim's centre is e off the axle, forward at first. The rim's centre advances by R φ, the axle by
R φ - e (cos φ - 1): the heading is (e / b) (cos φ - 1), a ripple of amplitude e / b at the wheel's frequency, which
returns to zero after each revolution. The lean of the axle and the robot's turning change this in second order of e.
1 rad/s, four revolutions; the step's part is of second order.

)";

std::string rolling_table() {
  Table table({"robot", "drive", "path", "turns by", "off at 20 ms", "off at 1 ms"});
  for (const auto& [name, robot] : {std::pair{"LabMate", labmate()}, std::pair{"OptiOdom", optiodom()}}) {
    for (const auto& [text, left, right] : {std::tuple{"straight", 2.0, 2.0}, std::tuple{"wide arc", 1.9, 2.1},
                                           std::tuple{"tight arc", 0.5, 2.0}, std::tuple{"on the spot", -1.5, 1.5}}) {
      const RollingCheck coarse = roll(robot, left, right, {}), fine = roll(robot, left, right, [] {
                                  PhysicsOptions o;
                                  o.step_s = 0.001;
                                  return o;
                                }());
      const auto off = [](const RollingCheck& c) {
        return fmt::format("{:.1e} mm, {:.1e}°", 1000 * c.off_m, degrees(c.off_rad));
      };
      table.row({name, text, fmt::format("{:.3f} m", fine.path_m), fmt::format("{:.1f}°", degrees(fine.turned_rad)),
                 off(coarse), off(fine)});
    }
  }
  return table.text();
}

std::string toe_table() {
  Table table({"wheels", "δ", "along", "closed form", "across", "closed form", "turned"});
  for (const auto& [text, kind] : {std::pair{"skewed", Skew::skewed}, std::pair{"toe-in", Skew::toe_in}}) {
    for (const double toe_deg : {0.5, 1.0, 2.0, 5.0}) {
      const ToeCheck c = roll_with_toe(kind, radians(toe_deg));
      const auto mm = [](double m) { return fmt::format("{:.4f} mm", 1000 * m); };
      table.row({text, fmt::format("{}°", toe_deg), mm(c.along_m), mm(c.expected_along_m), mm(c.across_m),
                 mm(c.expected_across_m), fmt::format("{:.1e}°", degrees(c.turned_rad))});
    }
  }
  return table.text();
}

std::string eccentric_table() {
  Table table({"e", "ripple", "e / b", "worst off, 20 ms", "1 ms", "0.1 ms", "drift per revolution"});
  for (const double e_m : {0.0005, 0.001, 0.002, 0.004}) {
    const EccentricCheck coarse = roll_eccentric(e_m, 0.02), fine = roll_eccentric(e_m, 0.001),
                         finest = roll_eccentric(e_m, 0.0001);
    const auto deg = [](double rad) { return fmt::format("{:.1e}°", degrees(rad)); };
    table.row({fmt::format("{} mm", 1000 * e_m), fmt::format("{:.5f}°", degrees(finest.ripple_rad)),
               fmt::format("{:.5f}°", degrees(finest.expected_ripple_rad)), deg(coarse.off_rad), deg(fine.off_rad),
               deg(finest.off_rad), deg(finest.drift_rad)});
  }
  return table.text();
}

}  // namespace

RollingCheck roll(const RobotModel& robot, double left_radps, double right_radps, const PhysicsOptions& options) {
  World world(robot, {20}, {}, options);
  world.place({});
  trip(world, left_radps, right_radps, 10);
  const double R = robot.wheels[0].radius_m;
  const double path_m = R * (world.wheel_angle(0) + world.wheel_angle(1)) / 2;
  const double turn = R * (world.wheel_angle(1) - world.wheel_angle(0)) / robot.wheelbase_m();
  const Pose2 goal = arc(path_m, turn), X_WB = world.pose();
  return {path_m, turn, std::hypot(X_WB.x_m - goal.x_m, X_WB.y_m - goal.y_m), X_WB.theta_rad - turn};
}

ToeCheck roll_with_toe(Skew kind, double toe_rad) {
  RobotModel robot = labmate();
  for (int i = 0; i < 2; ++i) {
    const double turned = kind == Skew::skewed || i == 1 ? toe_rad : -toe_rad;
    robot.wheels[i].axis = {-std::sin(turned), std::cos(turned), 0};
  }
  World world(robot, {20}, {}, {});
  world.place({});
  trip(world, kSpeed_radps, kSpeed_radps, 10);
  const double rolled_m = 0.075 * (world.wheel_angle(0) + world.wheel_angle(1)) / 2;
  const Pose2 X_WB = world.pose();
  return {X_WB.x_m, X_WB.y_m, rolled_m * std::cos(toe_rad), kind == Skew::skewed ? rolled_m * std::sin(toe_rad) : 0,
          X_WB.theta_rad};
}

EccentricCheck roll_eccentric(double eccentricity_m, double step_s) {
  RobotModel robot = labmate();
  robot.wheels[0].eccentricity_m = eccentricity_m;
  PhysicsOptions options;
  options.step_s = step_s;
  World world(robot, {20}, {}, options);
  world.place({});
  EccentricCheck check;
  check.expected_ripple_rad = eccentricity_m / robot.wheelbase_m();
  double low = 0, high = 0, off_sum[kRevolutions + 1]{};
  int samples[kRevolutions + 1]{};
  for (int k = 1; world.wheel_angle(0) < 2 * M_PI * kRevolutions; ++k) {
    const double speed_radps = kSlow_radps * std::min(1.0, k / 50.0);  // no slip at the start
    hold(world, speed_radps, speed_radps, 0.02);
    const double phi = world.wheel_angle(0), heading = world.pose().theta_rad;
    const double off = heading - check.expected_ripple_rad * (std::cos(phi) - 1);
    off_sum[int(phi / (2 * M_PI))] += off;
    ++samples[int(phi / (2 * M_PI))];
    low = std::min(low, heading);
    high = std::max(high, heading);
    check.off_rad = std::max(check.off_rad, std::abs(off));
  }
  check.ripple_rad = (high - low) / 2;
  check.drift_rad =
      (off_sum[kRevolutions - 1] / samples[kRevolutions - 1] - off_sum[1] / samples[1]) / (kRevolutions - 2);
  return check;
}

std::string rolling_chapter(Grid) {
  return kRollingText + rolling_table() + kToeText + toe_table() + kEccentricText + eccentric_table();
}

}  // namespace umbsim::fidelity

// Drivers on a robot that does exactly what it is told.
#include "bench/worlds/drivers/driver.h"

#include <gtest/gtest.h>

namespace umbsim::worlds {
namespace {

constexpr DriveGeometry kRobot{0.05, 0.05, 0.3};

Way square(double side_m, Direction direction) {
  Course c;
  c.side_m = side_m;
  return {c, Plan(c, direction).segments()};
}

Way circle() {
  Course c;
  return {
      c,
      {Segment{.kind = Segment::Kind::turn, .leg = 1, .length_m = 2 * M_PI, .angle_rad = 2 * M_PI, .X_SB_start = {}}}};
}

struct Driven {
  Pose2 X_SB;
  double time_s = 0;
  bool done = false;
};

// Set-points hold (jumps) or ramp over a period.
Driven drive_ideal(const DriverChoice& choice, const Way& way, double wheelbase_m = kRobot.wheelbase_m) {
  const std::unique_ptr<Driver> driver = make_driver(choice, way, kRobot, RandomStream(1, "test driver"));
  Driven d;
  WheelSpeeds last;
  const double period_s = 1 / choice.rate_hz;
  for (int k = 0; k * period_s < 200 && !d.done; ++k) {
    d.time_s = k * period_s;
    const WheelSpeeds next = driver->command(d.time_s, {d.X_SB, d.X_SB});
    if (driver->jumps()) last = next;
    const double left_m = (last.left_radps + next.left_radps) / 2 * period_s * kRobot.left_radius_m;
    const double right_m = (last.right_radps + next.right_radps) / 2 * period_s * kRobot.right_radius_m;
    d.X_SB = d.X_SB * arc((left_m + right_m) / 2, (right_m - left_m) / wheelbase_m);
    last = next;
    d.done = driver->done();
  }
  return d;
}

struct Ends {
  const char* kind;
  double position_m;  // that the driver leaves, by its own tolerance of arriving, at each of eight segments
  double heading_rad;
};

class EveryDriver : public testing::TestWithParam<Ends> {};

TEST_P(EveryDriver, ComesHomeFromASquareBothWays) {
  for (const Direction direction : {Direction::cw, Direction::ccw}) {
    DriverChoice choice;
    choice.kind = GetParam().kind;
    choice.tremor_radps = 0.02;
    choice.heading_gain_1ps = choice.kind == "joystick" ? 1 : 1.5;
    choice.across_gain_radpms = choice.kind == "joystick" ? 0.5 : 1;
    const Driven d = drive_ideal(choice, square(2, direction));
    EXPECT_TRUE(d.done);
    EXPECT_LT(std::hypot(d.X_SB.x_m, d.X_SB.y_m), GetParam().position_m);
    EXPECT_NEAR(std::abs(d.X_SB.theta_rad), 2 * M_PI, GetParam().heading_rad);
  }
}

TEST_P(EveryDriver, ClosesACircle) {
  DriverChoice choice;
  choice.kind = GetParam().kind;
  choice.heading_gain_1ps = 1;
  choice.across_gain_radpms = 0.5;
  const Driven d = drive_ideal(choice, circle());
  EXPECT_TRUE(d.done);
  EXPECT_LT(std::hypot(d.X_SB.x_m, d.X_SB.y_m), GetParam().position_m + 0.1);
  EXPECT_NEAR(d.X_SB.theta_rad, 2 * M_PI, GetParam().heading_rad + 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, EveryDriver,
                         testing::Values(Ends{"own", 0.01, 0.01}, Ends{"s_curve", 0.01, 0.01},
                                         Ends{"heading", 0.02, 0.01}, Ends{"pursuit", 0.02, 0.02},
                                         Ends{"jumps", 0.06, 0.05}, Ends{"joystick", 0.15, 0.12}),
                         [](const auto& each) { return std::string(each.param.kind); });

// The goal of a pursuit lies on the line: from beside a leg the robot comes back to it and stops at its end.
TEST(Pursuit, EndsAtItsWaypoint) {
  DriverChoice choice;
  choice.kind = "pursuit";
  Course c;
  const Way way{c, {Segment{.kind = Segment::Kind::leg, .leg = 1, .length_m = 3, .X_SB_start = {}}}};
  const std::unique_ptr<Driver> driver = make_driver(choice, way, kRobot, RandomStream(1, "test driver"));
  Pose2 X_SB{0, 0.2, 0};
  for (int k = 0; k < 3000 && !driver->done(); ++k) {
    const WheelSpeeds w = driver->command(k * 0.02, {X_SB, X_SB});
    const double left_m = w.left_radps * 0.02 * 0.05, right_m = w.right_radps * 0.02 * 0.05;
    X_SB = X_SB * arc((left_m + right_m) / 2, (right_m - left_m) / 0.3);
  }
  EXPECT_NEAR(X_SB.x_m, 3, 0.01);
  EXPECT_NEAR(X_SB.y_m, 0, 0.005);
  EXPECT_NEAR(X_SB.theta_rad, 0, 0.02);
}

// Who looks corrects a wrong wheelbase; who does not turns too far, by as much.
TEST(OpenLoop, NeverLooks) {
  DriverChoice choice;
  choice.open_loop = true;
  const double wrong = 0.3 / 1.05;  // turns 5 % too far
  const Driven blind = drive_ideal(choice, square(1, Direction::ccw), wrong);
  EXPECT_NEAR(blind.X_SB.theta_rad, 2 * M_PI * 1.05, 0.01);
  choice.open_loop = false;
  EXPECT_NEAR(drive_ideal(choice, square(1, Direction::ccw), wrong).X_SB.theta_rad, 2 * M_PI, 0.01);
}

// Flash & Hogan: an S-curve takes 15/8 of the time that the top speed alone would.
TEST(SCurve, TakesItsTime) {
  DriverChoice choice;
  choice.kind = "s_curve";
  Course c;
  c.linear_acceleration_mps2 = 100;
  c.dwell_s = 0;
  const Way way{c, {Segment{.kind = Segment::Kind::leg, .leg = 1, .length_m = 2, .X_SB_start = {}}}};
  EXPECT_NEAR(drive_ideal(choice, way).time_s, 15.0 / 8 * 2 / c.linear_speed_mps, 0.05);
}

}  // namespace
}  // namespace umbsim::worlds

// Backlash and the motors' response against closed forms.
#include <iostream>

#include "tests/effects/drives.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::error_after;
using testing::kRadius_m;
using testing::kWheelbase_m;
using testing::run_of;
using testing::segments;
using testing::text;
using testing::truth_at;
using testing::wheel_rad;

// The play's ends are reached at rest but for the driver's last small corrections, relative to the play.
constexpr double kPlay = 0.02;
// Of an odometry that sees everything: the contact's mobility and the ticks' rounding.
constexpr double kNothing_m = 2e-6, kNothing_rad = 2e-6;
constexpr double kSaturated_m = 1e-5;  // steps with a motor at its limit are solved to 1e-6 of the largest impulse

// Play of each wheel (left, right), and where it stands, in halves of the zone, after legs and after turns to the left.
struct Play {
  double left_rad, right_rad;
  int after_leg, turned_left, turned_right;
};

// Wheel behind shaft by play p, p = 0 at the start: the way is short by R p, the heading by R (p_R - p_L) / b.
void expect_play(const Play& play, const std::vector<std::string>& settings, const std::string& more) {
  const ExperimentResult r =
      drive(fmt::format("backlash: {{left_rad: {}, right_rad: {}}}{}", play.left_rad, play.right_rad, more), settings);
  const double left_m = kRadius_m * play.left_rad / 2, right_m = kRadius_m * play.right_rad / 2;
  for (const Direction direction : {Direction::cw, Direction::ccw}) {
    const bool ccw = direction == Direction::ccw;
    for (const Segment& s : segments(r, direction)) {
      const bool leg = s.kind == Segment::Kind::leg;
      // A turn to the right is the mirror image of one to the left.
      const int left = leg ? play.after_leg : ccw ? play.turned_left : play.turned_right;
      const int right = leg ? play.after_leg : ccw ? play.turned_right : play.turned_left;
      const double expected_rad = -(right * right_m - left * left_m) / kWheelbase_m;
      const Pose2 e = error_after(r, std::string(name(direction)) + "-1", s, 0.15);
      const double zone_m = std::max(left_m, right_m) * 2;
      std::cout << fmt::format("{} {} {}: heading {:+.4f} mrad, play gives {:+.4f}\n", name(direction),
                               leg ? "leg " : "turn", s.leg, 1e3 * e.theta_rad, 1e3 * expected_rad);
      EXPECT_NEAR(e.theta_rad, expected_rad, kPlay * zone_m / kWheelbase_m);
      if (leg && s.leg == 1) {
        EXPECT_NEAR(e.x_m, -play.after_leg * (left_m + right_m) / 2, kPlay * zone_m);
      }
    }
  }
}

// Wheels that the floor holds back are always pushed: legs end with both wheels behind their shafts, a turn to the left
// reverses the left wheel alone, which loses its whole zone, and the next leg gives it back.
const std::vector<std::string> kGentle{"course.linear_acceleration_mps2=0.05",
                                       "course.angular_acceleration_radps2=0.2"};
const std::string kDrag = ", caster_drag: {coefficient: 0.03}";  // 2.8 N: more than 43 kg at 0.05 m/s2

TEST(Backlash, UnderDragTheReversingWheelLosesItsZone) {
  for (const auto& [left, right] : {std::pair{0.02, 0.02}, {0.02, 0.0}, {0.01, 0.03}}) {
    expect_play({left, right, 1, -1, 1}, kGentle, kDrag);
  }
}

// Stopped faster than the drag would, the robot runs on against its braking motors: every stop takes the play to its
// other end. (Without any drag it would float between both ends.)
TEST(Backlash, BrakedWheelsRunThroughTheirZones) {
  for (const auto& [left, right] : {std::pair{0.02, 0.02}, {0.01, 0.03}})
    expect_play({left, right, -1, 1, -1}, {}, kDrag);
}

TEST(Backlash, ShowsNothingBetweenReversals) {
  const ExperimentResult r = drive("backlash: {left_rad: 0.02, right_rad: 0.02}" + kDrag, kGentle);
  const RecordedRun& run = run_of(r, "ccw-1");
  const std::vector<Pose2> odometry = testing::calculated(run, r.odometry);
  double least_m = 1, most_m = -1, turned_rad = 0;
  for (const TruthSample& t : run.truth) {
    if (t.time_s < 1 || t.time_s > 19) continue;
    const Pose2& o = odometry[std::size_t(std::lround(t.time_s * 50))];
    least_m = std::min(least_m, o.x_m - t.X_WB.x_m);
    most_m = std::max(most_m, o.x_m - t.X_WB.x_m);
    turned_rad = std::max(turned_rad, std::abs(t.X_WB.theta_rad));
  }
  std::cout << fmt::format(
      "first leg from 1 s to 19 s: behind by {:.5f} to {:.5f} mm, turned {:.2e} rad; half zone {:.5f} mm\n",
      1e3 * least_m, 1e3 * most_m, turned_rad, 1e3 * 0.01 * kRadius_m);
  EXPECT_NEAR(least_m, 0.01 * kRadius_m, kNothing_m);
  EXPECT_NEAR(most_m, 0.01 * kRadius_m, kNothing_m);
  EXPECT_LT(turned_rad, kNothing_rad);
}

TEST(MotorResponse, GainShowsInTheCommandsAndNotInTheReturnError) {
  for (const double g : {-0.05, 0.03, 0.1}) {
    const ExperimentResult r = drive(fmt::format("motor_response: {{gain_asymmetry: {}}}", g));
    const EncoderSample& cruise = run_of(r, "ccw-1").encoders.at(50 * 15);
    const double ratio = cruise.left_command_radps / cruise.right_command_radps;
    std::cout << fmt::format("gain asymmetry {}: commands left / right {:.7f}; {}\n", g, ratio, text(r.ccw.errors[0]));
    EXPECT_NEAR(ratio, 1 + g, 1e-5);
    EXPECT_LT(r.ccw.r_cg_m, kNothing_m);
    EXPECT_LT(std::abs(r.ccw.heading_rad), kNothing_rad);
  }
}

// What a first-order lag makes of commands that ramp from period to period, in closed form.
double worst_against_lag(const RecordedRun& run, const OdometryParameters& odometry, double lag_s,
                         double until_s = 1e9) {
  constexpr double T = 0.02;
  double speed = 0, angle = 0, worst = 0;
  for (std::size_t i = 1; i < run.encoders.size() && run.encoders[i].time_s < until_s; ++i) {
    const double from = run.encoders[i - 1].right_command_radps, to = run.encoders[i].right_command_radps;
    const double slope = (to - from) / T, off = speed - from + slope * lag_s, decay = std::exp(-T / lag_s);
    angle += from * T + slope * (T * T / 2 - lag_s * T) + off * lag_s * (1 - decay);
    speed = to - slope * lag_s + off * decay;
    worst = std::max(worst, std::abs(wheel_rad(run.encoders[i].right_ticks, odometry) - angle));
  }
  return worst;
}

TEST(MotorResponse, LagIsOfFirstOrderAndTheStepsErrorShrinksWithIt) {
  for (const double lag_s : {0.008, 0.05, 0.1}) {  // the first is shorter than a step
    double last = 0;
    for (const double step_s : {0.02, 0.01, 0.005}) {
      const ExperimentResult r =
          drive(fmt::format("motor_response: {{lag_s: {}}}", lag_s), {fmt::format("physics.step_s={}", step_s)});
      const double worst = worst_against_lag(run_of(r, "ccw-1"), r.odometry, lag_s);
      std::cout << fmt::format(
          "lag {} s, step {} s: wheel angle within {:.5f} rad of the exact response ({:.3f} steps' way)"
          "; {}\n",
          lag_s, step_s, worst, worst / (0.2 / kRadius_m * step_s), text(r.ccw.errors[0]));
      EXPECT_LT(worst, 0.6 * step_s * 0.2 / kRadius_m) << "half a step's way: set-points stay for a step";
      if (last > 0) {
        EXPECT_LT(worst, 0.6 * last) << "half the step";
      }
      EXPECT_LT(r.ccw.r_cg_m, kNothing_m);
      EXPECT_LT(std::abs(r.ccw.heading_rad), kNothing_rad);
      last = worst;
    }
  }
}

constexpr double kMass_kg = 42, kSpun_kg = 1;  // the wheels' spin is worth 2 x 0.5 kg

// A motor whose speed control has no integral part, torque = (set - speed) / droop, follows a first-order lag whose
// time constant is droop times the inertia that it moves.
TEST(MotorResponse, DroopIsALagAgainstTheRobotsInertia) {
  const double inertia_kgm2 = (kMass_kg + kSpun_kg) / 2 * kRadius_m * kRadius_m;
  double last = 0;
  for (const double step_s : {0.02, 0.01, 0.005}) {
    const double lag_s = 0.05;
    const ExperimentResult r = drive(fmt::format("motor_response: {{droop_radps_per_nm: {}}}", lag_s / inertia_kgm2),
                                     {fmt::format("physics.step_s={}", step_s)});
    const double worst = worst_against_lag(run_of(r, "ccw-1"), r.odometry, lag_s, 5);
    std::cout << fmt::format("step {} s: wheel angle within {:.5f} rad of a lag of {} s; {}\n", step_s, worst, lag_s,
                             text(r.ccw.errors[0]));
    EXPECT_LT(worst, 0.6 * step_s * 0.2 / kRadius_m);
    if (last > 0) {
      EXPECT_LT(worst, 0.6 * last) << "half the step";
    }
    EXPECT_LT(r.ccw.r_cg_m, kNothing_m);
    last = worst;
  }
}

// Downhill the wheels turn faster than commanded by droop times m g sin(slope) R / 2, uphill slower; the encoders see
// it, so that the odometry knows.
TEST(MotorResponse, DroopGivesWayOnASlope) {
  constexpr double kDroop = 0.2, kSlope_rad = 0.02, kDownhill_rad = 0.6;
  const ExperimentResult r =
      drive(fmt::format("motor_response: {{droop_radps_per_nm: {}}}, floor_slope: {{slope_rad: {}, downhill_rad: {}}}",
                        kDroop, kSlope_rad, kDownhill_rad));
  const double most_radps = kDroop * kMass_kg * 9.81 * std::sin(kSlope_rad) * kRadius_m / 2;
  for (const Segment& s : segments(r, Direction::ccw)) {
    if (s.kind != Segment::Kind::leg) continue;
    const RecordedRun& run = run_of(r, "ccw-1");
    double beyond_rad = 0, time_s = 0;
    for (std::size_t i = 1; i < run.encoders.size(); ++i) {
      const EncoderSample &a = run.encoders[i - 1], &b = run.encoders[i];
      if (b.time_s < s.start_s + 0.25 * s.duration_s || b.time_s > s.start_s + 0.75 * s.duration_s) continue;
      // Of both wheels: the centre of mass beside the axle's middle loads one of them more.
      const long ticks = b.left_ticks - a.left_ticks + b.right_ticks - a.right_ticks;
      const double commanded_radps = (b.left_command_radps + b.right_command_radps) / 2;
      beyond_rad += wheel_rad(ticks, r.odometry) / 2 - commanded_radps * (b.time_s - a.time_s);
      time_s += b.time_s - a.time_s;
    }
    const double expected = most_radps * std::cos((s.leg - 1) * M_PI / 2 - kDownhill_rad);
    std::cout << fmt::format("leg {}: {:+.5f} rad/s beyond the command over {:.1f} s; {:+.5f} expected; {}\n", s.leg,
                             beyond_rad / time_s, time_s, expected, text(r.ccw.errors[0]));
    EXPECT_GT(time_s, 5);
    EXPECT_NEAR(beyond_rad / time_s, expected, 0.01 * most_radps);
  }
  EXPECT_LT(r.ccw.r_cg_m, 1e-5) << "on a slope the contacts' mobility shows";
}

TEST(MotorResponse, SmallCommandsMoveNothing) {
  constexpr double kDeadband_radps = 0.4, kPeriod_s = 0.02;
  const ExperimentResult r = drive(fmt::format("motor_response: {{deadband_radps: {}}}", kDeadband_radps));
  const RecordedRun& run = run_of(r, "cw-1");
  const double tick_rad = 2 * M_PI / r.odometry.ticks_per_revolution;
  int still = 0;
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample &a = run.encoders[i - 1], &b = run.encoders[i];
    const double wanted = std::abs(b.left_command_radps) < kDeadband_radps ? 0 : b.left_command_radps;
    still += wanted == 0 && b.left_command_radps != 0;
    // One tick: the rounding of both readings.
    EXPECT_NEAR(wheel_rad(b.left_ticks - a.left_ticks, r.odometry), wanted * kPeriod_s, tick_rad * 1.01) << b.time_s;
  }
  std::cout << still << " of " << run.encoders.size() << " commands were too small; " << text(r.cw.errors[0]) << "\n";
  EXPECT_GT(still, 20);
  EXPECT_LT(r.cw.r_cg_m, kNothing_m);
}

// Both motors at their limit: 2 M / R moves 42 kg and what the wheels' spin is worth, 2 x 0.5 kg.
TEST(MotorResponse, TorqueLimitIsAForceOnTheRobot) {
  for (const double limit_nm : {0.1, 0.2}) {
    const ExperimentResult r = drive(fmt::format("motor_response: {{torque_limit_nm: {}}}", limit_nm));
    const RecordedRun& run = run_of(r, "ccw-1");
    const double a = 2 * (truth_at(run, 1.5).x_m - 2 * truth_at(run, 1).x_m + truth_at(run, 0.5).x_m) / 2 / 0.25;
    const double expected = 2 * limit_nm / kRadius_m / 43;
    std::cout << fmt::format("limit {} N m: {:.5f} m/s2, force balance {:.5f}; {}\n", limit_nm, a, expected,
                             text(r.ccw.errors[0]));
    EXPECT_NEAR(a, expected, 0.005 * expected);
    EXPECT_LT(r.ccw.r_cg_m, kSaturated_m);
  }
}

}  // namespace
}  // namespace umbsim

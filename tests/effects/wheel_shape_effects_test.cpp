// Toe and eccentricity against force balance and exact kinematics.
#include <array>
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
using testing::truth_at;
using testing::wheel_rad;

constexpr double kSide_m = 4;
// Toe: terms of the third order in toe, and the slips at the leg's start and stop, relative to the formula.
constexpr double kBalance = 0.02;
// Eccentricity, relative to e / b: what is of second order in e / R and in the step.
constexpr double kRipple = 0.03, kRippleSecondOrder = 0.06;

struct Toe {
  double left, right, along, across;
};

std::string yaml(const Toe& t) {
  return fmt::format(
      "wheel_misalignment: {{left_toe_rad: {}, right_toe_rad: {}}}, tyre_creep: {{along: {}, across: {}}}", t.left,
      t.right, t.along, t.across);
}

// Both wheels carry the same load. Sideways forces balance where the axle drifts in the mean of both rolling
// directions, m = (l + r) / 2; each wheel then slips by d = (r - l) / 2 across, with forces -+ N d / C_across whose
// parts along the robot need traction, which costs slip: with k = C_along / C_across the heading grows by -2 k d m / b
// per metre, and each metre is short by (m^2 - d^2) / 2 + k d^2.
TEST(WheelMisalignment, DriftsAndLosesDistanceAsForcesBalance) {
  for (const Toe& t : {Toe{0, 0.006, 0.02, 0.02},
                       {0.006, 0.006, 0.02, 0.02},
                       {-0.006, 0.006, 0.02, 0.02},
                       {0.012, -0.004, 0.02, 0.04},
                       {0, 0.01, 0.03, 0.02}}) {
    const double m = (t.left + t.right) / 2, d = (t.right - t.left) / 2, k = t.along / t.across;
    const double turn_rad = -2 * k * d * m / kWheelbase_m * kSide_m;
    const double sideways_m = m * kSide_m + turn_rad * kSide_m / 2;
    const double lost_m = ((m * m - d * d) / 2 + k * d * d) * kSide_m + m * turn_rad * kSide_m / 2;
    const ExperimentResult r = drive(yaml(t), {"physics.step_s=0.005"});
    const Pose2 e = error_after(r, "ccw-1", segments(r, Direction::ccw)[0], 0.1);
    std::cout << fmt::format(
        "toe {}, {} creep {}, {}: sideways {:.4f} mm ({:.4f}), lost {:.5f} mm ({:.5f}), heading "
        "{:.5f} mrad ({:.5f})\n",
        t.left, t.right, t.along, t.across, 1e3 * e.y_m, 1e3 * sideways_m, -1e3 * e.x_m, 1e3 * lost_m,
        1e3 * e.theta_rad, 1e3 * turn_rad);
    EXPECT_NEAR(e.y_m, sideways_m, kBalance * std::abs(sideways_m) + 1e-6);
    EXPECT_NEAR(-e.x_m, lost_m, kBalance * std::abs(lost_m) + 4e-6) << "micrometres of creep at start and stop";
    EXPECT_NEAR(e.theta_rad, turn_rad, kBalance * std::abs(turn_rad) + 2e-6);
  }
}

double travel(double eccentricity_m, double phase_rad, double wheel) {
  return kRadius_m * wheel - eccentricity_m * (std::cos(wheel + phase_rad) - std::cos(phase_rad));
}

struct Off {
  double metres = 0, radians = 0;
};

// The rim's centre moves at R times the wheel's angle, and the axle circles round it: the axle's way is
// R w - e (cos(w + phase) - cos(phase)), exactly. Integrated over the recorded ticks this is the path; the most that
// the absolute pose is off it.
Off off_kinematics(const RecordedRun& run, const OdometryParameters& odometry, const std::array<double, 4>& e) {
  Pose2 X;
  double left_m = 0, right_m = 0;
  Off worst;
  std::size_t next = 0;
  for (const EncoderSample& s : run.encoders) {
    const double l = travel(e[0], e[2], wheel_rad(s.left_ticks, odometry));
    const double q = travel(e[1], e[3], wheel_rad(s.right_ticks, odometry));
    X = X * arc((l - left_m + q - right_m) / 2, (q - right_m - l + left_m) / kWheelbase_m);
    left_m = l, right_m = q;
    if (next == run.truth.size() || s.time_s < run.truth[next].time_s - 1e-9) continue;
    const Pose2& T = run.truth[next++].X_WB;
    worst.metres = std::max(worst.metres, std::hypot(T.x_m - X.x_m, T.y_m - X.y_m));
    worst.radians = std::max(worst.radians, std::abs(T.theta_rad - X.theta_rad));
  }
  return worst;
}

TEST(WheelEccentricity, IsExactKinematicsOfTheRecordedTicks) {
  for (const std::array<double, 4>& c :
       {std::array{0.0, 0.001, 0.0, 0.0}, {0.001, 0.001, 0.5, -1.2}, {0.002, 0.0, 1.57, 0.0}}) {
    const double e_m = std::max(c[0], c[1]), limit_rad = e_m / kWheelbase_m;
    for (const double step_s : {0.02, 0.001}) {
      const ExperimentResult r =
          drive(fmt::format("wheel_eccentricity: {{left_m: {}, right_m: {}, left_phase_rad: {}, right_phase_rad: {}}}",
                            c[0], c[1], c[2], c[3]),
                {fmt::format("physics.step_s={}", step_s)});
      for (const char* id : {"cw-1", "ccw-1"}) {
        const Off off = off_kinematics(run_of(r, id), r.odometry, c);
        std::cout << fmt::format(
            "e {}, {} mm, step {} s, {}: off kinematics by {:.4f} mm, {:.4f} mrad; e / b {:.4f} mrad\n", 1e3 * c[0],
            1e3 * c[1], step_s, id, 1e3 * off.metres, 1e3 * off.radians, 1e3 * limit_rad);
        EXPECT_LT(off.radians, kRippleSecondOrder * limit_rad);
        // The axle's middle sways as the robot rolls (R e / b) and pitches (R e / 0.5 m), there and back: 0.8 e at
        // most.
        EXPECT_LT(off.metres, 0.8 * (c[0] + c[1]) + 6 * off.radians);
      }
    }
  }
}

struct Ripple {
  double amplitude_rad, mean_rad;
};

// Of the heading on the first leg's cruise, at the wheel's frequency (least squares against its angle).
Ripple ripple(const RecordedRun& run, const OdometryParameters& odometry, double from_s, double to_s) {
  const double n_turns = std::floor((wheel_rad(run.encoders[std::size_t(to_s * 50)].right_ticks, odometry) -
                                     wheel_rad(run.encoders[std::size_t(from_s * 50)].right_ticks, odometry)) /
                                    (2 * M_PI));
  const double start = wheel_rad(run.encoders[std::size_t(from_s * 50)].right_ticks, odometry);
  double c = 0, s = 0, mean = 0;
  int n = 0;
  for (const TruthSample& t : run.truth) {
    const double w = wheel_rad(run.encoders[std::size_t(std::lround(t.time_s * 50))].right_ticks, odometry);
    if (t.time_s < from_s || w > start + n_turns * 2 * M_PI) continue;
    if (t.time_s > to_s) break;
    c += t.X_WB.theta_rad * std::cos(w), s += t.X_WB.theta_rad * std::sin(w), mean += t.X_WB.theta_rad;
    ++n;
  }
  return {2 * std::hypot(c, s) / n, mean / n};
}

TEST(WheelEccentricity, RipplesTheHeadingByEOverB) {
  for (const double e_m : {0.0002, 0.001, 0.002}) {
    const ExperimentResult r = drive(fmt::format("wheel_eccentricity: {{right_m: {}}}", e_m));
    const Ripple found = ripple(run_of(r, "ccw-1"), r.odometry, 2, 19);
    std::cout << fmt::format("e {} mm: ripple {:.5f} mrad, e / b {:.5f}; mean {:.5f}\n", 1e3 * e_m,
                             1e3 * found.amplitude_rad, 1e3 * e_m / kWheelbase_m, 1e3 * found.mean_rad);
    EXPECT_NEAR(found.amplitude_rad, e_m / kWheelbase_m, kRipple * e_m / kWheelbase_m);
  }
}

// Started where the ripple crosses its mean, the heading has none, and what is lost of each metre is its mean square
// half: (e / b)^2 / 4. Seen over whole turns of the wheel, one each 2.5 s.
TEST(WheelEccentricity, LosesDistanceInTheSecondOrderOnly) {
  constexpr double kTurn_s = 2.5, kFrom_s = 2.5, kTo_s = 17.5;
  for (const double e_m : {0.005, 0.010}) {
    const ExperimentResult r =
        drive(fmt::format("wheel_eccentricity: {{right_m: {}, right_phase_rad: {}}}", e_m, M_PI / 2),
              {"runs.directions=[ccw]", "physics.step_s=0.001",
               fmt::format("course.linear_speed_mps={}", 2 * M_PI * kRadius_m / kTurn_s)});
    const RecordedRun& run = run_of(r, "ccw-1");
    const Pose2 A = truth_at(run, kFrom_s), B = truth_at(run, kTo_s);
    const double believed_m = 2 * M_PI * kRadius_m * (kTo_s - kFrom_s) / kTurn_s;
    const double lost_m = believed_m - std::hypot(B.x_m - A.x_m, B.y_m - A.y_m);
    const double expected_m = std::pow(e_m / kWheelbase_m, 2) / 4 * believed_m;
    std::cout << fmt::format("e {} mm: lost {:.5f} mm of {:.3f} m, (e / b)^2 / 4 gives {:.5f}; turned {:.5f} mrad\n",
                             1e3 * e_m, 1e3 * lost_m, believed_m, 1e3 * expected_m, 1e3 * (B.theta_rad - A.theta_rad));
    EXPECT_NEAR(lost_m, expected_m, 0.1 * expected_m) << "terms of the next order: e / R";
    EXPECT_LT(std::abs(B.theta_rad - A.theta_rad), kRipple * e_m / kWheelbase_m);
  }
}

}  // namespace
}  // namespace umbsim

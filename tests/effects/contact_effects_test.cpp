// Tyres and casters against statics: what the floor must push is known, so what the tyre gives way is known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "effects/contact.h"
#include "effects/geometry.h"
#include "tests/effects/trial_drive.h"

namespace umbsim {
namespace {

using testing::kCreep;
using testing::kG;
using testing::kRadius_m;
using testing::kWheelbase_m;
using testing::rig_with;
using testing::Statics;
using testing::TrialDrive;

constexpr double kMu = 0.9;
// The laws are linear; the closed forms leave out second-order terms (slip 1e-3) and the step is finite (20 ms).
constexpr double kLinear = 2e-3;
// What "rigid" contact gives way: 1e-9 m/s per newton, over ten seconds.
constexpr double kRigid_m = 1e-7, kRigid_rad = 1e-7;

void expect_share(const char* what, double measured, double expected, double tolerance) {
  std::cout << what << ": " << measured << " (" << expected << ", " << 100 * (measured / expected - 1) << " %)\n";
  EXPECT_NEAR(measured, expected, tolerance * std::abs(expected)) << what;
}

// Rolling radius R - c N_i: distance falls short by c (N_L + N_R) / 2R, heading turns by c (N_L - N_R) / (R b) a metre.
void expect_compliance(const Rig& rig, double c, const PhysicsOptions& options = {}) {
  const Statics load(rig.robot);
  TrialDrive drive(rig, options);
  EXPECT_NEAR(drive.world.loads().wheel_n[0], load.left_n, 1e-3 * load.left_n);
  drive.leg(0.3, 0, 5);
  const double distance_m = drive.odometry.x_m;
  const double turn_radpm = c * (load.left_n - load.right_n) / (kRadius_m * kWheelbase_m);
  const double curved = std::pow(turn_radpm * distance_m, 2) / 6;  // an arc's chord is shorter by this
  const double expected = -c * load.wheels_n / 2 / kRadius_m - curved;
  expect_share("compliance: distance", drive.error().x_m / distance_m, expected, kLinear);
  if (std::abs(turn_radpm) < 1e-12) {
    EXPECT_NEAR(drive.error().theta_rad, 0, kRigid_rad);
  } else {
    expect_share("compliance: heading", drive.error().theta_rad / distance_m, turn_radpm, kLinear);
  }
}

TEST(TyreCompliance, RollingRadiusFollowsTheLoad) {
  for (const double c : {0.2e-6, 1.5e-6, 3e-6, 5e-6}) expect_compliance(rig_with(TyreCompliance{c}), c);
}

TEST(TyreCompliance, PayloadOnOneSideTurnsTheLeg) {
  for (const double left_m : {0.1, -0.1}) {
    expect_compliance(rig_with(LoadShift{15, 0, left_m, 0.1}, TyreCompliance{1.5e-6}), 1.5e-6);
  }
}

// Load and rolling radius act on each other from step to step: neither may start to bounce.
TEST(TyreCompliance, SameAtEveryStep) {
  for (const double step_s : {0.001, 0.002, 0.005, 0.01}) {
    PhysicsOptions options;
    options.step_s = step_s;
    expect_compliance(rig_with(TyreCompliance{5e-6}), 5e-6, options);
  }
}

// What one contact does that turns at 1 rad/s, rolls at `rolled_m` per radian and slips along by `slip_m` per radian:
// a line of many points, each pulling with its creep, up to mu. Force over N, and moment over N, metres.
struct LineContact {
  double along = 0;
  double moment_m = 0;
};

LineContact line_contact(double width_m, double creep, double rolled_m, double slip_m) {
  constexpr int kPoints = 200000;
  LineContact sum;
  for (int i = 0; i < kPoints; ++i) {
    const double y = width_m * ((i + 0.5) / kPoints - 0.5);
    const double slip = y - slip_m;
    const double sliding = slip < 0 ? -kMu : kMu;
    const double pull = creep > 0 ? std::clamp(slip / (creep * rolled_m), -kMu, kMu) : sliding;
    sum.along -= pull / kPoints;
    sum.moment_m += y * pull / kPoints;
  }
  return sum;
}

// Turning on the spot the wheels work against both moments with a force 2 M / b each, for which they must slip. The
// share of the turn that is lost, by bisection of the slip; the load does not matter.
double share_lost(double width_m, double creep) {
  double low = 0;
  double high = width_m / 2 + 0.01;
  for (int i = 0; i < 60; ++i) {
    const double slip = (low + high) / 2;
    const LineContact c = line_contact(width_m, creep, kWheelbase_m / 2 + slip, slip);
    (c.along * kWheelbase_m < 2 * c.moment_m ? low : high) = slip;
  }
  return low / (kWheelbase_m / 2 + low);
}

double turn_lost(double width_m, double creep, double rate_radps, double step_s = 0.001) {
  PhysicsOptions options;
  options.step_s = step_s;
  TrialDrive drive(rig_with(TyreCreep{creep, creep}, ContactPatch{width_m}), options);
  drive.ramp(0, rate_radps, 1);
  const double before = drive.error().theta_rad, start_rad = drive.odometry.theta_rad;
  drive.go(0, rate_radps, 4);
  return -(drive.error().theta_rad - before) / (drive.odometry.theta_rad - start_rad);
}

TEST(ContactPatch, ResistsTurningOnTheSpot) {
  for (const double creep : {0.0, 0.005, 0.02}) {
    for (const double width_m : {0.01, 0.02, 0.04, 0.1}) {
      SCOPED_TRACE(fmt::format("width {} m, creep {}", width_m, creep));
      const double expected = share_lost(width_m, creep);
      expect_share("patch: share of the turn lost", turn_lost(width_m, creep, 0.5), expected, kLinear);
      EXPECT_NEAR(turn_lost(width_m, creep, 0.5), turn_lost(width_m, creep, -0.5), 1e-9) << "left and right";
      EXPECT_NEAR(turn_lost(width_m, creep, 0.5), turn_lost(width_m, creep, 0.5, 0.02), 0.003 * expected) << "the step";
    }
  }
  EXPECT_NEAR(share_lost(0.02, 0), 0.02 * 0.02 / (2 * kWheelbase_m * kWheelbase_m), 1e-5) << "w^2 / (2 b^2)";
  EXPECT_LT(std::abs(turn_lost(0, kCreep, 0.5)), 1e-6) << "no width, no loss";
}

TEST(ContactPatch, DoesNothingOnAStraightLeg) {
  TrialDrive drive(rig_with(TyreCreep{kCreep, kCreep}, ContactPatch{0.04}));
  TrialDrive point(rig_with(TyreCreep{kCreep, kCreep}));
  for (TrialDrive* d : {&drive, &point}) d->leg(0.2, 0, 5);
  EXPECT_NEAR(drive.error().x_m, point.error().x_m, 1e-9);
  EXPECT_NEAR(drive.error().theta_rad, 0, 1e-9);
}

// In a gentle curve of curvature k the ends of the line creep by k w / 2 and no more: moment N w^2 k / (12 C) for each
// tyre, and the curvature loses the share w^2 / (3 b^2), whatever C.
TEST(ContactPatch, GentleCurvesStayCurved) {
  const auto heading = [](double width_m) {
    TrialDrive drive(rig_with(TyreCreep{kCreep, kCreep}, ContactPatch{width_m}, WheelRadiusDifference{0.002}));
    drive.leg(0.2, 0, 10);
    return drive.error().theta_rad;
  };
  const double width_m = 0.04;
  const double share = width_m * width_m / (3 * kWheelbase_m * kWheelbase_m);
  expect_share("patch: share of a gentle curve lost", 1 - heading(width_m) / heading(0), share, 0.02);
}

// Rigid tyres slide at any curvature: w^2 / (2 b^2) of it is lost, as on the spot, and no unequal radii are hidden.
TEST(ContactPatch, RigidTyresLoseTheSameShareOfEveryCurve) {
  const auto heading = [](double width_m) {
    TrialDrive drive(rig_with(ContactPatch{width_m}, WheelRadiusDifference{0.002}));
    drive.leg(0.2, 0, 10);
    return drive.error().theta_rad;
  };
  const double share = 0.04 * 0.04 / (2 * kWheelbase_m * kWheelbase_m);
  expect_share("patch on rigid tyres: share of a gentle curve lost", 1 - heading(0.04) / heading(0), share, 0.02);
}

// A robot at 0.2 m/s that is held back, driven on or pushed aside at the axle by a steady force.
struct Pushed {
  double traction = 0;  ///< F / N, of both wheels
  double slip_along = 0;
  double slip_across = 0;
};

Pushed pushed(double force_n, double direction_rad) {
  Rig rig = rig_with(TyreCreep{kCreep, kCreep / 2});
  const double duration_s = 10;
  rig.pushes.push_back({1, {0, duration_s, force_n * duration_s, direction_rad, 0, 0}});
  TrialDrive drive(rig);
  drive.ramp(0.2, 0, 1);
  drive.go(0.2, 0, 1);
  const Pose2 before = drive.error();
  const double start_m = drive.odometry.x_m;
  drive.go(0.2, 0, 2);
  const double distance_m = drive.odometry.x_m - start_m;
  // The force at axle height tips the robot about the wheels' contact line.
  const double tipped_n = force_n * std::cos(direction_rad) * kRadius_m / rig.robot.casters[0].centre_m.x();
  const Pose2 after = drive.error();
  EXPECT_NEAR(after.theta_rad, before.theta_rad, 1e-6) << "a force at the axle does not turn it";
  return {force_n / (Statics(rig.robot).wheels_n - tipped_n), (after.x_m - before.x_m) / distance_m,
          (after.y_m - before.y_m) / distance_m - after.theta_rad};
}

TEST(TyreCreep, SlipIsProportionalToTractionUpToTheFrictionLimit) {
  for (const double force_n : {-200.0, -100.0, -25.0, 25.0, 100.0, 200.0}) {
    const Pushed along = pushed(force_n, 0);
    const Pushed across = pushed(force_n, M_PI / 2);
    EXPECT_LT(std::abs(along.traction), kMu);
    expect_share("creep along", along.slip_along, kCreep * along.traction, kLinear);
    expect_share("creep across", across.slip_across, kCreep / 2 * across.traction, kLinear);
  }
}

// Pulled on by more than friction holds, the robot speeds up: m a = F - mu N, with N from the moments about the wheels'
// contact line. Slower than that it only creeps.
TEST(TyreCreep, BeyondTheLimitItSlides) {
  const Rig rig = rig_with();
  const double force_n = 450, x_c = rig.robot.casters[0].centre_m.x();
  const double tip_kgm = 40 * (kRadius_m + 0.05) + 2 * kRadius_m;  // sum of mass times height
  const double m = rig.robot.total_mass_kg();
  const double level_n = Statics(rig.robot).wheels_n - force_n * kRadius_m / x_c;
  const double expected = (force_n - kMu * level_n) / (m + kMu * tip_kgm / x_c);
  const Pushed slides = pushed(force_n, 0);
  EXPECT_GT(slides.traction, kMu);
  // Between 2 s and 4 s of constant acceleration from rest it goes 6 s^2 a, and the odometry 0.4 m.
  constexpr double kOdometry_m = 0.4, kStart = 0.005;  // the start: wheels that do not yet turn, springs that tip
  expect_share("sliding: acceleration", (slides.slip_along + 1) * kOdometry_m / 6, expected, kStart);
}

// A caster that drags with D = c N beside the middle: F_L - F_R = 2 D y / b, and the tyres creep under it.
TEST(CasterDrag, TurnsInProportionToDistanceWhenOffTheMiddle) {
  for (const double left_m : {0.05, -0.05}) {
    const Rig rig = rig_with(TyreCreep{kCreep, kCreep}, CasterDrag{0.03, left_m});
    const Statics load(rig.robot);
    const double drag_n = 0.03 * load.caster_n, uneven_n = drag_n * left_m / kWheelbase_m;
    const double slip_l = kCreep * (drag_n / 2 + uneven_n) / load.left_n;
    const double slip_r = kCreep * (drag_n / 2 - uneven_n) / load.right_n;
    // At cruise: starting and stopping, unevenly loaded wheels creep unevenly too.
    TrialDrive drive(rig);
    drive.ramp(0.2, 0, 1);
    drive.go(0.2, 0, 0.4);
    for (const double seconds : {2.0, 4.0, 8.0}) {
      const Pose2 before = drive.error();
      const double distance_m = 0.2 * seconds;
      drive.go(0.2, 0, seconds);
      const Pose2 after = drive.error();
      expect_share("drag: yaw", (after.theta_rad - before.theta_rad) / distance_m, (slip_l - slip_r) / kWheelbase_m,
                   kLinear);
      const double heading = (before.theta_rad + after.theta_rad) / 2;  // it drives askew: cosine
      expect_share("drag: distance", (after.x_m - before.x_m) / distance_m,
                   -(slip_l + slip_r) / 2 - heading * heading / 2, kLinear);
    }
  }
}

TEST(CasterDrag, InTheMiddleItOnlyShortensTheLeg) {
  TrialDrive drive(rig_with(TyreCreep{kCreep, kCreep}, CasterDrag{0.03, 0}));
  drive.leg(0.2, 0, 9);
  EXPECT_NEAR(drive.error().theta_rad, 0, kRigid_rad);
  EXPECT_LT(drive.error().x_m, -10 * kRigid_m);
  TrialDrive rigid(rig_with(CasterDrag{0.03, 0.05}));
  rigid.leg(0.2, 0, 9);
  EXPECT_NEAR(rigid.error().theta_rad, 0, kRigid_rad) << "without creep nothing yields";
}

}  // namespace
}  // namespace umbsim

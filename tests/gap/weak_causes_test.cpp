// Causes that a search finds only where it looks closely, and numbers that a recording hardly tells.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "gap/output/parameter_estimates.h"
#include "gap/replay/command_response.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

/// The estimate of a parameter of the first cause, printed.
ParameterEstimate estimate(const Diagnosis& d, const std::string& parameter) {
  for (const ParameterEstimate& e : parameter_estimates(d.causes.front(), d)) {
    if (e.parameter != parameter) continue;
    std::cout << fmt::format("{}: {} {:.5g} [{:.5g}, {:.5g}] {}\n", d.causes.front().name, parameter, e.value,
                             e.ci95[0], e.ci95[1], e.unit);
    return e;
  }
  ADD_FAILURE() << d.causes.front().name << " has no " << parameter;
  return {};
}

bool holds(const ParameterEstimate& e, double truth) { return e.ci95[0] <= truth && truth <= e.ci95[1]; }

// A hole as long as a thumb under one wheel's track at a corner: some centimetres beside it nothing is felt.
TEST(WeakCause, AShortLiftAtACorner) {
  const double x_m = 2 + 0.17 * std::cos(0.3);
  const double y_m = 0.17 * std::sin(0.3);
  const Subject p(campaign({effect("wheel_lift", {{"x_m", x_m}, {"y_m", y_m}, {"length_m", 0.03}})}, 71));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "wheel_lift");
  EXPECT_LT(std::hypot(estimate(d, "x_m").value - x_m, estimate(d, "y_m").value - y_m), 0.02);
  EXPECT_NEAR(estimate(d, "length_m").value, 0.03, 0.006);
}

// Toed against each other by the same angle, wheels only scrub: nothing of that is proportional to the angle near zero.
TEST(WeakCause, WheelsToedAlike) {
  const Subject p(campaign({effect("wheel_misalignment", {{"left_toe_rad", 0.04}, {"right_toe_rad", -0.04}})}, 72, 4));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "wheel_misalignment");
  EXPECT_TRUE(holds(estimate(d, "left_toe_rad"), 0.04));
  EXPECT_TRUE(holds(estimate(d, "right_toe_rad"), -0.04));
}

// How much of one wheel's toe moves the robot sideways hangs on the floor's roughness.
TEST(WeakCause, OneToedWheelOnARoughFloor) {
  const Subject p(campaign({effect("wheel_misalignment", {{"left_toe_rad", 0.015}})}, 73));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "wheel_misalignment");
  const ParameterEstimate e = estimate(d, "left_toe_rad");
  EXPECT_NEAR(e.value, 0.015, 0.15 * 0.015);
  EXPECT_TRUE(holds(e, 0.015));
  // What the scenario believes scrubs on the same floor: with the twin's toe nothing is left.
  const Subject again(p.recording, {effect("wheel_misalignment", {{"left_toe_rad", e.value}})});
  EXPECT_EQ(again.diagnosed().causes.front().name, "none");
}

// Both make turns smaller; a contact's width does so more while the turn speeds up, for that takes force.
TEST(WeakCause, AContactsWidthIsNoWheelbase) {
  const double width_m = 0.025;
  const Subject wide(campaign({effect("contact_patch", {{"width_m", width_m}})}, 83));
  const Diagnosis d = wide.diagnosed();
  ASSERT_EQ(d.causes.front().name, "contact_patch");
  const ParameterEstimate e = estimate(d, "width_m");
  EXPECT_NEAR(e.value, width_m, 0.05 * width_m);
  EXPECT_TRUE(holds(e, width_m));
  const double alike = width_m * width_m / (2 * 0.34 * 0.34);
  const Subject based(campaign({effect("wheelbase", {{"relative", alike}})}, 84));
  const Diagnosis other = based.diagnosed();
  ASSERT_EQ(other.causes.front().name, "wheelbase");
  EXPECT_TRUE(holds(estimate(other, "relative"), alike));
}

// A contact of 48 mm would do what this wheelbase does, but the wheels are 30 mm wide.
TEST(WeakCause, AContactIsNoWiderThanItsWheel) {
  const Subject p(campaign({effect("wheelbase", {{"relative", 0.01}})}, 85));
  EXPECT_DOUBLE_EQ(p.model.wheel_width_m(), 0.03);
  EXPECT_EQ(p.diagnosed({"wheelbase"}).causes.front().name, "unknown");
}

// Recordings of this engine show that no other one made them: then a turn that is off by 0.06 % is no engine's.
TEST(WeakCause, AWheelbaseThatIsHardlyOff) {
  const Subject p(campaign({effect("wheelbase", {{"relative", 6e-4}})}, 77));
  // So little takes as much from turns as a contact of 12 mm, and the runs can hardly tell the two apart.
  const std::vector<std::string> set = p.diagnosed().set;
  EXPECT_EQ(std::count(set.begin(), set.end(), "wheelbase"), 1);
  EXPECT_EQ(std::count(set.begin(), set.end(), "none"), 0);
  const Diagnosis d = p.diagnosed({"contact_patch"});
  ASSERT_EQ(d.causes.front().name, "wheelbase");
  EXPECT_TRUE(holds(estimate(d, "relative"), 6e-4));
}

// Tyres that give way sideways by 15 % more than this engine's: such a recording's turns may be off by more. By 6 %
// more, as MuJoCo's do, they take little enough for 0.02 % of the wheelbase to be found, in three of four draws.
TEST(WeakCause, AnotherEnginesTurnsAreNoWheelbase) {
  const Subject p(campaign({effect("tyre_creep", {{"across", 0.15}}), effect("wheelbase", {{"relative", 2e-4}})}, 78));
  const Diagnosis d = p.diagnosed({"tyre_creep"});
  EXPECT_EQ(d.causes.front().name, "none");
}

// A floor that grips by 0.4 is as good as many. A robot that turns eight times too fast slips on it: the twin needs the
// floor, and the cause is the driving.
TEST(WeakCause, AnOrdinaryFloorIsNone) {
  const Effect fast = effect("fast_turning", {{"factor", 8}});
  const Subject p(campaign({fast, effect("slippery_floor", {{"friction", 0.4}})}, 91));
  const Diagnosis d = p.diagnosed();
  EXPECT_EQ(d.causes.front().name, "fast_turning");
  EXPECT_EQ(d.twin.name(), "fast_turning+slippery_floor");
  EXPECT_EQ(std::count(d.set.begin(), d.set.end(), "fast_turning+slippery_floor"), 1);
  std::cout << d.causes.front().name << ", twin " << d.twin.name() << ", closure " << d.closure.fraction << "\n";
  const Subject slippery(campaign({fast, effect("slippery_floor", {{"friction", 0.1}})}, 92));
  EXPECT_EQ(slippery.diagnosed().causes.front().name, "fast_turning+slippery_floor");
}

TEST(WeakCause, MotorsThatLagByFifteenMilliseconds) {
  const Subject p(campaign({effect("motor_response", {{"lag_s", 0.015}})}, 79));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "motor_response");
  const ParameterEstimate e = estimate(d, "lag_s");
  EXPECT_NEAR(e.value, 0.015, 0.15 * 0.015);
  EXPECT_TRUE(holds(e, 0.015));
}

constexpr double kDroop = 0.17;  // rad/s per N m: the LabMate's motors then lag by 20 ms, 43 kg R^2 / 2 times that

// A slope moves no robot on rigid tyres. Motors that give way turn faster downhill than they are told, by droop times
// m g sin(slope) R / 2, and the counts say which way that is.
TEST(WeakCause, ASlopeThatCountsAloneShow) {
  const double slope_rad = 0.02, downhill_rad = 1.1;
  const Subject p(campaign({effect("floor_slope", {{"slope_rad", slope_rad}, {"downhill_rad", downhill_rad}}),
                            effect("motor_response", {{"droop_radps_per_nm", kDroop}})},
                           90));
  const double expected_radps = kDroop * 42 * 9.81 * std::sin(slope_rad) * 0.075 / 2;
  const RecordedRobot& robot = p.recording.robot;
  for (const RecordedRun& run : p.recording.runs) {
    if (run.payload_kg) continue;
    const Eigen::Vector2d by_heading =
        command_response(run, robot, counted_rad(run, robot), 2 * M_PI / robot.ticks_per_revolution).by_heading_radps;
    std::cout << fmt::format("{}: {:.5f} rad/s at {:.4f} rad, expected {:.5f} at {}\n", run.id, by_heading.norm(),
                             std::atan2(by_heading.y(), by_heading.x()), expected_radps, downhill_rad);
    EXPECT_NEAR(by_heading.norm(), expected_radps, 0.03 * expected_radps);
    EXPECT_NEAR(std::atan2(by_heading.y(), by_heading.x()), downhill_rad, 0.03);
  }
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "floor_slope");
  EXPECT_TRUE(holds(estimate(d, "slope_rad"), slope_rad));
  EXPECT_TRUE(holds(estimate(d, "downhill_rad"), downhill_rad));
}

// On level ground the same motors lag behind what speeds the robot up, and that is all.
TEST(WeakCause, MotorsThatGiveWayOnLevelGround) {
  const Subject p(campaign({effect("motor_response", {{"droop_radps_per_nm", kDroop}})}, 91));
  EXPECT_EQ(p.diagnosed().causes.front().name, "motor_response");
}

// A caster's drag holds such motors back, on the way and in turns alike. On tyres that do not creep it moves no robot.
TEST(WeakCause, ADragThatCountsAloneShow) {
  const double friction = 0.1;
  const Subject p(campaign(
      {effect("caster_drag", {{"coefficient", friction}}), effect("motor_response", {{"droop_radps_per_nm", kDroop}})},
      94));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "caster_drag");
  EXPECT_TRUE(holds(estimate(d, "coefficient"), friction));
}

// Beside the middle it loads one motor more than the other, and the counts say which.
TEST(WeakCause, ADragBesideTheMiddleThatCountsAloneShow) {
  const double friction = 0.1, left_m = -0.06;
  const Subject p(campaign({effect("caster_drag", {{"coefficient", friction}, {"left_m", left_m}}),
                            effect("motor_response", {{"droop_radps_per_nm", kDroop}})},
                           97));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "caster_drag");
  EXPECT_TRUE(holds(estimate(d, "coefficient"), friction));
  EXPECT_TRUE(holds(estimate(d, "left_m"), left_m));
}

// Beside the middle it turns the robot as well, as far as the tyres creep. Nobody says by how much these do: the runs
// tell which side drags, and drag and creep together.
TEST(WeakCause, ADragBesideTheMiddleOnTyresThatCreep) {
  const double friction = 0.1, left_m = -0.06;
  const Subject p(campaign({effect("caster_drag", {{"coefficient", friction}, {"left_m", left_m}}),
                            effect("tyre_creep", {{"along", 0.03}, {"across", 0.03}})},
                           96));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "caster_drag");
  EXPECT_TRUE(holds(estimate(d, "coefficient"), friction));
  EXPECT_TRUE(holds(estimate(d, "left_m"), left_m));
}

// A payload beside the middle rolls its wheel on a smaller radius, as far as the tyres give way: the runs tell load and
// softness together, and which side is loaded.
TEST(WeakCause, APayloadOnTyresThatNobodyKnows) {
  const Subject p(campaign({effect("load_shift", {{"payload_kg", 3}, {"ahead_m", 0.02}, {"left_m", 0.1}}),
                            effect("tyre_compliance", {{"metres_per_newton", 2e-6}})},
                           98));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "load_shift");
  EXPECT_GT(estimate(d, "left_m").value, 0);
}

// Casters have friction, and few servos are stiff: that much is no effect.
TEST(WeakCause, AnOrdinaryCasterOnMotorsThatGiveWay) {
  const Subject p(campaign(
      {effect("caster_drag", {{"coefficient", 0.01}}), effect("motor_response", {{"droop_radps_per_nm", kDroop}})},
      95));
  const Diagnosis d = p.diagnosed();
  const std::string named = d.causes.front().name;
  std::cout << fmt::format("{}: score {:.1f}\n", named, d.causes.front().score);
  EXPECT_EQ(named.find("caster"), std::string::npos) << named;
}

// A hole alone is fitted so that it makes up for the radii where it can, and a wheel comes across it or not by
// millimetres.
// Does not hold at present: of -1e-3 the interval is -0.93e-3 to -0.68e-3, since contacts that open are solved in the
// robot's own coordinates or since the search changed; not found out yet.
TEST(WeakCause, RadiiBesideALift) {
  const Effect lift =
      effect("wheel_lift", {{"x_m", 2 + 0.17 * std::cos(0.3)}, {"y_m", 0.17 * std::sin(0.3)}, {"length_m", 0.045}});
  const Subject p(campaign({effect("wheel_radius_scale", {{"relative", -1e-3}}), lift}, 81));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "wheel_lift+wheel_radius_scale");
  EXPECT_TRUE(holds(estimate(d, "relative"), -1e-3));
  EXPECT_NEAR(estimate(d, "length_m").value, 0.045, 0.009);
}

// Late counts shake the tracks by much and move the robot by little: no error of theirs is a wheelbase.
TEST(WeakCause, AWheelbaseBesideLateCounts) {
  const Subject p(
      campaign({effect("encoder_latency", {{"seconds", 0.02}}), effect("wheelbase", {{"relative", -0.002}})}, 75));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "encoder_latency+wheelbase");
  EXPECT_TRUE(holds(estimate(d, "relative"), -0.002));
}

// Samples a tenth rarer than the readings lag by anything up to a period already.
TEST(WeakCause, RareSamplesBesideLateCounts) {
  const Subject p(campaign(
      {effect("encoder_latency", {{"seconds", 0.04}}), effect("encoder_sampling", {{"interval_s", 0.0222}})}, 76));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "encoder_latency+encoder_sampling");
  const ParameterEstimate e = estimate(d, "interval_s");
  EXPECT_NEAR(e.value, 0.0222, 0.0005);
  EXPECT_TRUE(holds(e, 0.0222));
}

// One encoder that loses counts is simpler than two, and hardly differs from two of which one loses few.
TEST(WeakCause, AnIntervalAllowsForTheOtherWheel) {
  const Subject p(campaign({effect("encoder_missed_counts", {{"left_probability", 0.002}})}, 74));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "encoder_missed_counts");
  ASSERT_FALSE(d.causes.front().variants.empty());
  EXPECT_TRUE(holds(estimate(d, "left_probability"), 0.002));
  const ParameterEstimate other = estimate(d, "right_probability");
  EXPECT_TRUE(holds(other, 0));
  EXPECT_LT(other.ci95[0], other.ci95[1]);
}

// Turns hardly faster than declared move no robot otherwise: only the commands show them.
TEST(WeakCause, TurnsALittleFasterThanDeclared) {
  const std::vector<Effect> faster{effect("fast_turning", {{"factor", 1.15}})};
  const Subject p(campaign(faster, 75));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "fast_turning");
  const ParameterEstimate e = estimate(d, "factor");
  EXPECT_NEAR(e.value, 1.15, 0.02);
  EXPECT_TRUE(holds(e, 1.15));
  const Diagnosis without = p.diagnosed({"fast_turning"});
  EXPECT_EQ(without.causes.front().name, "unknown");
}

// A hypothesis with one number, 1 +- 0.1 of its units.
Fit told(const std::string& variant, double value, double sd) {
  Fit fit;
  for (const Hypothesis& f : plain_hypotheses(0.02, 2000)) {
    if (f.effect == "wear" && f.variant == variant) fit.hypotheses = {f};
  }
  const Eigen::Index n = Eigen::Index(fit.hypotheses.front().parameters.size());
  fit.p = Eigen::VectorXd::Constant(n, value);
  fit.covariance = Eigen::MatrixXd::Identity(n, n) * sd * sd;
  return fit;
}

TEST(WeakCause, VariantsWidenIntervalsAndChangeNoValue) {
  const Fit right = told("right", 1e-4, 1e-5);
  Cause cause{"wear", right, 0, 0};
  const std::vector<ParameterEstimate> alone = parameter_estimates(cause, Diagnosis{});
  ASSERT_EQ(alone.size(), 1u);
  cause.variants = {told("both", 6e-5, 2e-5)};
  const std::vector<ParameterEstimate> all = parameter_estimates(cause, Diagnosis{});
  ASSERT_EQ(all.size(), 2u);
  for (const ParameterEstimate& e : all) {
    if (e.parameter == "right_relative_per_run") {
      EXPECT_EQ(e.value, 1e-4);
      EXPECT_EQ(e.ci95[1], alone.front().ci95[1]);
      EXPECT_NEAR(e.ci95[0], 6e-5 - 1.96 * 2e-5, 3e-6);
    } else {
      EXPECT_EQ(e.parameter, "left_relative_per_run");
      EXPECT_EQ(e.value, 0);
      EXPECT_EQ(e.ci95[0], 0) << "the fit keeps it there";
      EXPECT_NEAR(e.ci95[1], 6e-5 + 1.96 * 2e-5, 3e-6);
    }
  }
}

}  // namespace
}  // namespace umbsim::gap

// The effects' table: what it builds, what it leaves alone, what it refuses.
#include "effects/catalogue.h"

#include <gtest/gtest.h>

#include <cstring>
#include <iostream>
#include <set>

#include "effects/geometry.h"
#include "sim/world.h"

namespace umbsim {
namespace {

constexpr double kRoundOff = 1e-15;

Rig nominal() {
  Rig rig;
  rig.robot = load_robot(std::string(UMBSIM_SOURCE_DIR) + "/robots/labmate.urdf");
  return rig;
}

std::vector<Effect> effects(const std::string& yaml) { return read_effects(YamlValue::parse(yaml, "effects.yaml")); }
Rig with(const std::string& yaml) { return apply_effects(effects(yaml), nominal()); }

double e_d(const Rig& rig) { return rig.robot.wheels[1].radius_m / rig.robot.wheels[0].radius_m; }
double mean_radius(const Rig& rig) { return (rig.robot.wheels[0].radius_m + rig.robot.wheels[1].radius_m) / 2; }

// Every number of a rig, in a fixed order.
std::vector<double> numbers(const Rig& rig) {
  std::vector<double> all;
  const auto add = [&](const auto& matrix) {
    for (int i = 0; i < matrix.size(); ++i) all.push_back(matrix.data()[i]);
  };
  const RobotModel& r = rig.robot;
  all.push_back(r.base.mass_kg);
  add(r.base.com_m);
  add(r.base.inertia_kgm2);
  for (const Wheel& w : r.wheels) {
    add(w.centre_m);
    add(w.axis);
    all.insert(all.end(), {w.radius_m, w.width_m, w.mass_kg, w.spin_inertia_kgm2, w.transverse_inertia_kgm2,
                           w.effort_limit_nm, w.eccentricity_m, w.eccentricity_rad, w.compliance_mpn, w.creep_along,
                           w.creep_across, w.slip_along_mps_per_n, w.slip_across_mps_per_n, w.patch_width_m});
  }
  for (const Caster& c : r.casters) {
    add(c.centre_m);
    all.insert(all.end(), {c.radius_m, c.friction, double(c.swivels), c.swivel_friction_nm, c.initial_angle_rad});
  }
  for (const Motor& m : rig.drivetrain.motor) {
    all.insert(all.end(), {m.torque_limit_nm, m.gain, m.lag_s, m.droop_radps_per_nm, m.deadband_radps, m.backlash_rad});
  }
  const Floor& f = rig.floor;
  all.insert(all.end(),
             {rig.encoders.ticks_per_revolution, rig.encoders.rate_hz, f.friction, f.slope_rad, f.downhill_rad,
              f.drift_x, f.drift_y, double(f.ripples.size()), double(f.cables.size()), double(f.patches.size())});
  const EncoderSpec& e = rig.encoders;
  for (const EncoderFaults& faults : {e.left, e.right}) {
    all.insert(all.end(), {faults.missed_probability, faults.missed_probability_per_radps});
  }
  all.insert(all.end(), {e.sampling_interval_s, e.latency_s, rig.commanded_motion.acceleration_factor,
                         rig.commanded_motion.turn_speed_factor, double(rig.pushes.size())});
  return all;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

std::vector<double> driven(const Rig& rig) {
  World world(rig.robot, rig.drivetrain, rig.floor, {});
  world.place({});
  for (int i = 0; i < 100; ++i) {
    world.command(i * 0.03, i * 0.02);
    world.advance(0.02);
  }
  const Pose2 p = world.pose();
  return {p.x_m, p.y_m, p.theta_rad, world.wheel_angle(0), world.wheel_angle(1), world.energy()};
}

TEST(Catalogue, EveryEffectAtItsNeutralValueChangesNotOneBit) {
  const std::vector<double> before = numbers(nominal()), path = driven(nominal());
  for (const EffectInfo& info : catalogue()) {
    const Effect effect = neutral_effect(info);
    const Rig rig = apply_effects({effect}, nominal());
    EXPECT_TRUE(same_bits(numbers(rig), before)) << info.name;
    EXPECT_TRUE(same_bits(driven(rig), path)) << info.name;
    EXPECT_TRUE(same_bits(numbers(with(info.name + ": {}")), before)) << info.name << " with parameters left out";
  }
}

TEST(Catalogue, EveryEffectAtAPlausibleValueChangesTheRig) {
  Rig third_run = nominal();
  third_run.run.number = 2;  // wear shows from the second run on
  const std::vector<double> before = numbers(third_run);
  for (const EffectInfo& info : catalogue()) {
    Effect effect = neutral_effect(info);
    for (std::size_t i = 0; i < info.parameters.size(); ++i)
      effect.values.numbers[i] = info.parameters[i].plausible_max;
    EXPECT_FALSE(same_bits(numbers(apply_effects({effect}, third_run)), before)) << info.name;
  }
}

TEST(Catalogue, LinesAreComplete) {
  std::set<std::string> names;
  for (const EffectInfo& info : catalogue()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name << " is there twice";
    EXPECT_FALSE(info.text.lecture.empty() || info.text.source.empty() || info.text.description.empty() ||
                 info.text.signature.empty() || info.text.confused_with.empty())
        << info.name;
    ASSERT_FALSE(info.parameters.empty());
    for (const EffectParameter& p : info.parameters) {
      EXPECT_TRUE(p.bounds.contains(p.neutral)) << info.name;
      EXPECT_TRUE(p.bounds.contains(p.plausible_min) && p.bounds.contains(p.plausible_max)) << info.name;
      EXPECT_LE(p.plausible_min, p.plausible_max) << info.name;
    }
  }
}

TEST(WheelRadiusDifference, IsTheRatioAndKeepsTheMean) {
  for (const double relative : {-0.01, 0.00084, 0.3}) {
    const Rig rig = with("wheel_radius_difference: {relative: " + std::to_string(relative) + "}");
    EXPECT_NEAR(e_d(rig), 1 + relative, kRoundOff * 4);
    EXPECT_NEAR(mean_radius(rig), 0.075, kRoundOff);
    EXPECT_EQ(rig.robot.wheelbase_m(), nominal().robot.wheelbase_m());
    for (int i = 0; i < 2; ++i) {  // a solid cylinder of the same mass
      const Wheel& w = rig.robot.wheels[i];
      EXPECT_NEAR(w.spin_inertia_kgm2, w.mass_kg * w.radius_m * w.radius_m / 2, kRoundOff);
    }
  }
}

TEST(WheelRadiusScale, IsTheMeanAndKeepsTheRatio) {
  const Rig rig = with("wheel_radius_scale: {relative: 0.02}");
  EXPECT_NEAR(mean_radius(rig), 0.075 * 1.02, kRoundOff);
  EXPECT_EQ(e_d(rig), 1);
  EXPECT_EQ(rig.robot.wheelbase_m(), nominal().robot.wheelbase_m());
}

TEST(WheelbaseEffect, MovesBothWheelsAndNothingElse) {
  const Rig rig = with("wheelbase: {relative: -0.011264706}");
  EXPECT_NEAR(rig.robot.wheelbase_m(), 0.33617, 1e-9);  // the published value; the ratio has nine decimals
  EXPECT_EQ(rig.robot.wheels[0].centre_m.y(), -rig.robot.wheels[1].centre_m.y());
  EXPECT_EQ(mean_radius(rig), 0.075);
  EXPECT_EQ(rig.robot.casters[0].centre_m, nominal().robot.casters[0].centre_m);
  EXPECT_EQ(rig.robot.base.com_m, nominal().robot.base.com_m);
}

TEST(Effects, AreIndependentOfTheirOrderInTheFile) {
  const Rig a = with(
      "wheelbase: {relative: 0.01}\nwheel_radius_scale: {relative: 0.02}\n"
      "wheel_radius_difference: {relative: 0.003}\n");
  const Rig b = with(
      "wheel_radius_difference: {relative: 0.003}\nwheel_radius_scale: {relative: 0.02}\n"
      "wheelbase: {relative: 0.01}\n");
  EXPECT_TRUE(same_bits(numbers(a), numbers(b)));
  EXPECT_NEAR(e_d(a), 1.003, 4 * kRoundOff);
  EXPECT_NEAR(mean_radius(a), 0.075 * 1.02, kRoundOff);
  EXPECT_NEAR(a.robot.wheelbase_m(), 0.34 * 1.01, kRoundOff);
}

void expect_refused(const std::string& yaml, const std::vector<std::string>& parts) {
  try {
    effects(yaml);
    ADD_FAILURE() << "accepted: " << yaml;
  } catch (const InputError& e) {
    std::cout << e.what() << "\n";
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << " is not in: " << e.what();
    }
  }
}

Effect with(const std::string& name, const std::string& parameter, double value) {
  Effect e = neutral_effect(find_effect(name));
  for (std::size_t i = 0; i < e.info->parameters.size(); ++i) {
    if (e.info->parameters[i].name == parameter) e.values.numbers[i] = value;
  }
  return e;
}

TEST(Effects, FoundOnTopOfBelieved) {
  const std::vector<Effect> both = combined(
      {with("wheelbase", "relative", 0.02), with("fast_turning", "factor", 2), with("slippery_floor", "friction", 0.5),
       with("bump", "x_m", 1)},
      {with("wheelbase", "relative", 0.01), with("fast_turning", "factor", 1.5),
       with("slippery_floor", "friction", 0.1), with("bump", "x_m", 2), with("wear", "left_relative_per_run", 1e-4)});
  ASSERT_EQ(both.size(), 6u);
  EXPECT_NEAR(both[0].values.numbers[0], 0.03, 1e-15) << "departures from neutral are added";
  EXPECT_NEAR(both[1].values.numbers[0], 2.5, 1e-15);
  EXPECT_EQ(both[2].values.numbers[0], 0.1) << "0 stands for the scenario's: the new one goes";
  EXPECT_EQ(both[3].values.numbers[1], 1);
  EXPECT_EQ(both[4].values.numbers[1], 2) << "cables lie beside each other";
  EXPECT_EQ(both[5].info->name, "wear");
  const std::vector<Effect> far = combined({with("wheelbase", "relative", 0.4)}, {with("wheelbase", "relative", 0.4)});
  EXPECT_EQ(far[0].values.numbers[0], far[0].info->parameters[0].bounds.max);
}

TEST(Effects, BadOnesAreRefusedByName) {
  expect_refused("wheel_base: {relative: 0.1}", {"effects.yaml:1", "wheel_base", "did you mean 'wheelbase'"});
  expect_refused("wheelbase: {relative: 0.1}\nwheelbase: {relative: 0.2}",
                 {"effects.yaml:2", "wheelbase", "duplicate"});
  expect_refused("wheelbase:\n  relative: 0.6", {"effects.yaml:2", "wheelbase.relative", "0.6", "0.5"});
  expect_refused("wheelbase:\n  relativ: 0.1", {"effects.yaml:2", "relativ", "did you mean 'relative'"});
  expect_refused("wheelbase: {relative: much}", {"wheelbase.relative", "much"});
  expect_refused("wheelbase: {relative: .nan}", {"wheelbase.relative"});
  expect_refused("wheelbase: 0.1", {"effects.yaml:1", "wheelbase"});
  try {
    find_effect("slip");
    ADD_FAILURE();
  } catch (const InputError& e) {
    for (const EffectInfo& info : catalogue()) EXPECT_NE(std::string(e.what()).find(info.name), std::string::npos);
  }
}

}  // namespace
}  // namespace umbsim

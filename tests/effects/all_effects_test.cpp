// What holds for every effect: neutral is nominal, the shipped scenario runs quickly, effects combine.
#include <cstring>
#include <ctime>
#include <iostream>

#include "tests/effects/drives.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::shipped;
using testing::text;

constexpr double kLongest_s = 10;
constexpr int kFallbacks = 5;  // steps of some ten thousand in which friction is solved to 1e-6 only
// Products of effects of a thousandth, and the driver's different path, relative to the larger error.
constexpr double kSuperposition = 0.01;
constexpr double kDoubling = 0.02;
constexpr double kNothing = 3e-6;  // m and rad: contact mobility, rounding of 1e6 ticks per revolution

// Ticks, commands and absolute poses, bit for bit.
std::vector<std::uint64_t> bits(const ExperimentResult& r) {
  std::vector<std::uint64_t> all;
  const auto add = [&](double value) {
    all.emplace_back();
    std::memcpy(&all.back(), &value, sizeof value);
  };
  for (const RecordedRun& run : r.recording.runs) {
    for (const EncoderSample& s : run.encoders) {
      all.push_back(std::uint64_t(s.left_ticks));
      all.push_back(std::uint64_t(s.right_ticks));
      add(s.left_command_radps), add(s.right_command_radps);
    }
    for (const TruthSample& t : run.truth) add(t.time_s), add(t.X_WB.x_m), add(t.X_WB.y_m), add(t.X_WB.theta_rad);
  }
  return all;
}

const std::vector<std::string> kShort{"course.side_m=0.4"};

TEST(EveryEffect, NeutralIsNominalToTheLastBit) {
  const std::vector<std::uint64_t> nominal = bits(drive("", kShort));
  EXPECT_GT(nominal.size(), 1000u);
  EXPECT_EQ(catalogue().size(), 28u);
  for (const EffectInfo& info : catalogue()) {
    Scenario s = shipped("nominal", kShort);
    s.effects = {neutral_effect(info)};
    EXPECT_EQ(bits(run_experiment(s, 1)), nominal) << info.name;
    EXPECT_EQ(bits(drive(info.name + ": {}", kShort)), nominal) << info.name << " with its parameters left out";
  }
}

TEST(EveryEffect, ScenarioRunsQuicklyAndIsSolved) {
  for (const EffectInfo& info : catalogue()) {
    const Scenario s = shipped("effects/" + info.name);
    const std::clock_t begun = std::clock();
    const ExperimentResult r = run_experiment(s, 1);
    const double processor_s = double(std::clock() - begun) / CLOCKS_PER_SEC;  // a busy machine's clock says nothing
    std::cout << fmt::format("{:<24} {:6.3f} s, {} steps, {} sliding, {} fallbacks; cw {}; ccw {}\n", info.name,
                             processor_s, r.cost.steps, r.cost.newton_steps, r.cost.solver_fallbacks,
                             text(r.cw.errors[0]), text(r.ccw.errors[0]));
    EXPECT_LT(processor_s, kLongest_s) << info.name;
    EXPECT_LE(r.cost.solver_fallbacks, kFallbacks) << info.name;
    const auto has = [&](const Effect& e) { return e.info->name == info.name; };
    EXPECT_TRUE(std::any_of(s.effects.begin(), s.effects.end(), has)) << info.name << " is not in its own scenario";
  }
}

// An effect's own line of its scenario, at the typical values.
std::string typical(const EffectInfo& info) {
  std::string values = info.one_run ? "run: ccw-1" : "";
  for (const EffectParameter& p : info.parameters) {
    values += fmt::format("{}{}: {}", values.empty() ? "" : ", ", p.name, p.typical);
  }
  return info.name + ": {" + values + "}";
}

TEST(TwoEffects, CombineInAnyOrderOfTheFile) {
  const std::vector<EffectInfo>& all = catalogue();
  const std::vector<std::uint64_t> nominal = bits(drive("", kShort));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string a = typical(all[i]), b = typical(all[(i + 5) % all.size()]);
    const std::vector<std::uint64_t> ab = bits(drive(a + ", " + b, kShort));
    EXPECT_EQ(ab, bits(drive(b + ", " + a, kShort))) << a << " and " << b;
    EXPECT_NE(ab, nominal) << a << " and " << b;
  }
}

// A return error as one vector of lengths: the heading at the end of a metre.
Eigen::Vector3d vector(const ReturnError& e) { return {e.x_m, e.y_m, e.theta_rad}; }

using Errors = Eigen::Matrix<double, 6, 1>;

Errors errors(const std::string& effects) {
  const ExperimentResult r = drive(effects);
  Errors e;
  e << vector(r.cw.errors[0]), vector(r.ccw.errors[0]);
  return e;
}

// (Not with backlash: whatever else makes the driver correct himself opens and closes the play.)
TEST(TwoEffects, SmallOnesSuperpose) {
  const std::vector<std::string> small{
      "wheel_radius_scale: {relative: 0.001}",  "wheel_radius_difference: {relative: 0.0002}",
      "wheelbase: {relative: 0.001}",           "carpet_drift: {metres_per_metre: 0.0005, direction_rad: 0.8}",
      "wear: {right_relative_per_run: 0.0002}", "tyre_compliance: {metres_per_newton: 1.0e-7}",
      "motor_response: {lag_s: 0.04}",          "encoder_latency: {seconds: 0.04}"};
  double worst = 0;
  for (std::size_t i = 0; i < small.size(); ++i) {
    for (std::size_t j = i + 1; j < small.size(); ++j) {
      const Errors a = errors(small[i]), b = errors(small[j]), both = errors(small[i] + ", " + small[j]);
      const double larger = std::max(a.norm(), b.norm()), off = (both - a - b).norm();
      if (larger > 100 * kNothing) worst = std::max(worst, off / larger);
      EXPECT_LT(off, kSuperposition * larger + kNothing) << small[i] << " and " << small[j];
    }
  }
  std::cout << "sum of two errors against the error of both: at most " << worst << " of the larger one\n";
}

// Order of the return error in the parameter: 1, 2, or 0 for none at all. Negative: above what the parameters beside it
// make.
struct Power {
  const char* effect;
  double value;
  int order;
};

TEST(EveryEffect, DoublesOrQuadruplesAsItShould) {
  for (const Power& p : {
           Power{"wheel_radius_scale: {{relative: {}}}", 0.0005, 1},
           {"wheel_radius_difference: {{relative: {}}}", 0.0002, 1},
           {"wheelbase: {{relative: {}}}", 0.0005, 1},
           {"wheel_misalignment: {{right_toe_rad: {}}}, tyre_creep: {{along: 0.02, across: 0.02}}", 0.006, -2},
           {"load_shift: {{payload_kg: 10, left_m: {}}}, tyre_compliance: {{metres_per_newton: 1.0e-7}}", 0.05, -1},
           {"wear: {{right_relative_per_run: {}}}", 0.0002, 1},
           {"backlash: {{left_rad: {0}, right_rad: {0}}}, caster_drag: {{coefficient: 0.03}}", 0.01, 1},
           {"tyre_compliance: {{metres_per_newton: {}}}", 1e-7, 1},
           {"carpet_drift: {{metres_per_metre: {}, direction_rad: 0.8}}", 0.001, 1},
           {"floor_slope: {{slope_rad: {}, downhill_rad: 1}}, tyre_creep: {{along: 0.02, across: 0.02}}", 0.005, 1},
           {"motor_response: {{lag_s: {}}}", 0.05, 0},
           {"motor_response: {{gain_asymmetry: {}}}", 0.02, 0},
           {"encoder_latency: {{seconds: {}}}", 0.04, 0},
           {"encoder_sampling: {{interval_s: {}}}", 0.06, 0},
       }) {
    const auto at = [&](double value) -> Errors { return errors(fmt::format(fmt::runtime(p.effect), value)); };
    const Errors zero = p.order < 0 ? at(0) : Errors::Zero();
    const Errors once = at(p.value) - zero, twice = at(2 * p.value) - zero;
    const double ratio = twice.norm() / once.norm();
    std::cout << fmt::format("{} at {}: {:.4g}, doubled {:.4g}, ratio {:.4f}\n", p.effect, p.value, once.norm(),
                             twice.norm(), ratio);
    if (p.order == 0) {
      EXPECT_LT(twice.norm(), kNothing) << p.effect;
      continue;
    }
    const double factor = std::pow(2, std::abs(p.order));
    EXPECT_LT((twice - factor * once).norm(), kDoubling * twice.norm()) << p.effect;
  }
}

}  // namespace
}  // namespace umbsim

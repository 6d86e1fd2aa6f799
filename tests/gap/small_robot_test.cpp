// Robots that are nothing like a LabMate: what a trial of an effect does to them must not end the diagnosis.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include "calibration/intake/intake.h"
#include "gap/answer/closure.h"
#include "gap/noise/clock.h"
#include "gap/output/diagnosis_json.h"
#include "gap/search/drivable.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::effect;
using testing::Subject;

Scenario optiodom(const std::vector<Effect>& hidden) {
  Scenario s = testing::squares(1, 2);
  s.robot.urdf = "optiodom.urdf";
  s.course.linear_speed_mps = 0.2;
  testing::add_noise(s, 5);
  s.effects = hidden;
  return s;
}

Recording optiodom_squares(const std::vector<Effect>& hidden) { return run_experiment(optiodom(hidden), 0).recording; }

// Mass (3.3 kg) times what the centre of mass lies ahead of the axle is all that holds it against a load behind.
TEST(SmallRobot, ALoadThatTipsItIsSteppedLess) {
  const Subject p(optiodom_squares({effect("wheelbase", {{"relative", 0.01}})}));
  const Hypothesis whole = testing::hypothesis_of("load_shift", "payload");
  Eigen::VectorXd tips = Eigen::VectorXd::Zero(Eigen::Index(whole.parameters.size()));
  tips[1] = whole.parameters[1].step;
  EXPECT_THROW(p.model.predict({effects_of(whole, tips)}), InputError) << "else this shows nothing";
  const std::vector<Hypothesis> kept = drivable(p.model, {whole});
  ASSERT_EQ(kept.size(), 1u);
  for (std::size_t i = 0; i < kept.front().parameters.size(); ++i) {
    Eigen::VectorXd stepped = Eigen::VectorXd::Zero(Eigen::Index(kept.front().parameters.size()));
    stepped[Eigen::Index(i)] = kept.front().parameters[i].step;
    std::cout << kept.front().parameters[i].name << " " << stepped[Eigen::Index(i)] << "\n";
    EXPECT_NO_THROW(p.model.predict({effects_of(kept.front(), stepped)}));
  }
  const Diagnosis d = p.diagnosed();
  EXPECT_EQ(d.causes.front().name, "wheelbase");
  EXPECT_NEAR(d.causes.front().fit.p[0], 0.01, 0.001);
}

TEST(SmallRobot, WhatNoStepDrivesIsLeftOut) {
  const Subject p(optiodom_squares({}));
  Hypothesis heavy;
  for (const Hypothesis& f : plain_hypotheses(0.02, 2000)) {
    if (f.effect == "load_shift") heavy = f;
  }
  ASSERT_FALSE(heavy.parameters.empty());
  heavy.parameters[1].step = 1000;
  heavy.parameters[1].min = -1e6;
  heavy.parameters[1].max = 1e6;
  EXPECT_TRUE(drivable(p.model, {heavy}).empty());
}

// A fit's next step may lead to where the robot tips over: it is taken back, and the fit goes on from where it stands.
TEST(SmallRobot, AStepTooFarIsTakenBack) {
  constexpr double kStandsUpTo = 0.008, kTruth = 0.01;
  const Recording recording = optiodom_squares({effect("wheelbase", {{"relative", kTruth}})});
  const Replay replay(scenario_of(recording, "."), recording);
  Simulator narrow = testing::simulator(replay);
  narrow.ticks = [wide = narrow.ticks](std::size_t run, const std::vector<Effect>& effects, double roughness) {
    for (const Effect& e : effects) {
      if (e.info->name == "wheelbase" && e.values.numbers[0] > kStandsUpTo) throw RunError("it tips over");
    }
    return wide(run, effects, roughness);
  };
  const Campaign campaign = campaign_of(recording);
  const Model model(campaign, narrow, Scatter{});
  std::vector<Hypothesis> wheelbase = plain_hypotheses(0.02, 2000);
  std::erase_if(wheelbase, [](const Hypothesis& f) { return f.effect != "wheelbase"; });
  ASSERT_EQ(wheelbase.size(), 1u);
  EXPECT_THROW(model.density_at(wheelbase, Eigen::VectorXd::Constant(1, kTruth)), RunError)
      << "else this shows nothing";
  const Fit fit = model.fit(wheelbase);
  std::cout << "stands up to " << kStandsUpTo << ", fitted " << fit.p[0] << "\n";
  EXPECT_GT(fit.p[0], 0.5 * kStandsUpTo);
  EXPECT_LE(fit.p[0], kStandsUpTo);
  EXPECT_NO_THROW(held_out_closure(model, fit));
}

// Dimensions of a robot that a free tracker saw are fitted first. What stands for one of them is still found: counts
// that one wheel loses do what its radius does.
TEST(SmallRobot, LostCountsStandForARadius) {
  Scenario s =
      optiodom({effect("wheelbase", {{"relative", 0.01}}), effect("wheel_radius_scale", {{"relative", -0.003}}),
                effect("encoder_missed_counts", {{"left_probability", 0.002}})});
  s.truth.heading_sd_rad = 0.003;
  s.noise.wheel_noise_m_per_sqrt_m = 1e-3;
  const Diagnosis d = Subject(run_experiment(s, 0).recording).diagnosed();
  EXPECT_EQ(d.causes.front().name, "encoder_missed_counts+wheel_radius_scale+wheelbase");
}

// A real robot of that kind, measured by motion capture.
TEST(SmallRobot, ARealOneIsDiagnosed) {
  const std::filesystem::path folder = std::filesystem::path(UMBSIM_SHARED_DIR) / "recordings/optiodom-square-1.7m";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const Recording recording = read_recording(folder);
  intake::check_recording(recording, folder.string());
  std::vector<std::string> limits;
  const Subject p(followed_through(recording, limits));
  const Diagnosis d = p.diagnosed();
  std::cout << d.causes.front().name << ", closure " << d.closure.fraction << "\n";
  EXPECT_NE(d.causes.front().name.find("wheelbase"), std::string::npos) << d.causes.front().name;
  EXPECT_GT(d.closure.fraction, 0.5);
}

}  // namespace
}  // namespace umbsim::gap

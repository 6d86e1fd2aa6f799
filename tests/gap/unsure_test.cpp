// A model in which what an effect does is unsure, as it is from engine to engine.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "gap/evidence/signature_shares.h"
#include "gap/search/addition.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::effect;
using testing::fit_of;
using testing::Subject;

// Log density that is lost where the robot moves under other effects than those of the fit.
double lost(const Model& model, const Fit& fit, const std::vector<Effect>& others) {
  Fit moved = fit;
  moved.predicted = model.predict({others}).front();
  return model.held_density(fit) - model.held_density(moved);
}

// A robot with one toed wheel, its runs another engine's: a tenth of what is unsure would be left in runs of this one.
struct ToedWheel {
  static constexpr double kToe_rad = 0.01;

  ToedWheel() : subject(run_experiment(scenario(), 0).recording), model(subject.model) {
    model.take_for_another_engines();
    std::vector<Hypothesis> toed = plain_hypotheses(0.02, 2000);
    std::erase_if(toed, [](const Hypothesis& h) { return h.effect != "wheel_misalignment" || h.variant != "right"; });
    fit = model.fit(toed);
  }

  static Scenario scenario() {
    Scenario s = testing::squares(2, 2);
    testing::add_noise(s, 11);
    s.effects = {effect("wheel_misalignment", {{"right_toe_rad", kToe_rad}})};
    return s;
  }

  Model unsure(double turned) const { return unsure(turned, model); }
  Model unsure(double turned, const Model& where) const {
    return where.unsure_of(where.held(fit), [turned](const std::string&) {
      return SignatureErrors{{0.3, 0.3, 0.6, 1.5}, 0.3, 0.1, turned};
    });
  }

  std::vector<Effect> toed(double times) const {
    return {effect("wheel_misalignment", {{"right_toe_rad", times * fit.p[0]}})};
  }
  std::vector<Effect> beside(const Effect& other) const { return {toed(1).front(), other}; }
  // Ways are longer by this share, and turns stay what they are: wheels and wheelbase are larger alike.
  std::vector<Effect> beside_longer_ways(double share) const {
    return {toed(1).front(), effect("wheel_radius_scale", {{"relative", share}}),
            effect("wheelbase", {{"relative", share}})};
  }

  Subject subject;
  Model model;
  Fit fit;
};

// Toed wheels may scrub otherwise on other tyres, a wheelbase is a wheelbase.
TEST(UnsureModel, ForgivesWhatTheEffectsOfAFitMayDoOtherwise) {
  const ToedWheel t;
  ASSERT_NEAR(t.fit.p[0], t.kToe_rad, 0.1 * t.kToe_rad);
  const Model unsure = t.unsure(0);
  const auto toed_more = t.toed(1.6), wider = t.beside(effect("wheelbase", {{"relative", 0.02}}));
  const double toe = lost(t.model, t.fit, toed_more), unsure_toe = lost(unsure, t.fit, toed_more);
  const double base = lost(t.model, t.fit, wider), unsure_base = lost(unsure, t.fit, wider);
  std::printf("toe by 0.6 more: %.1f lost, unsure %.1f; a wheelbase: %.1f, unsure %.1f\n", toe, unsure_toe, base,
              unsure_base);
  EXPECT_GT(toe, 50);
  EXPECT_LT(unsure_toe, 0.2 * toe);
  EXPECT_GT(base, 100);
  EXPECT_GT(unsure_base, 0.3 * base);
}

// A wheel that slips across may give way along as well: the robot turns on its legs, as with unequal wheels. No tyre
// makes it turn by as much as a wheelbase does at the corners.
TEST(UnsureModel, WhatSlipsAcrossMayTurnTheRobot) {
  const ToedWheel t;
  const Model straight = t.unsure(0), turned = t.unsure(1);
  const auto unequal = t.beside(effect("wheel_radius_difference", {{"relative", 0.001}}));
  const auto wider = t.beside(effect("wheelbase", {{"relative", 0.02}}));
  const double curve = lost(straight, t.fit, unequal), turned_curve = lost(turned, t.fit, unequal);
  const double base = lost(straight, t.fit, wider), turned_base = lost(turned, t.fit, wider);
  std::printf("unequal wheels: %.1f lost, %.1f where slip may turn; a wheelbase: %.1f, %.1f\n", curve, turned_curve,
              base, turned_base);
  EXPECT_GT(curve, 20);
  EXPECT_LT(turned_curve, 0.3 * curve);
  EXPECT_GT(turned_base, 0.5 * base);
}

// Nor has it grip left along its way: on legs it rolls further, or less far, by more than robots differ by, though not
// by much.
TEST(UnsureModel, WhatSlipsAcrossMayRollFurther) {
  const ToedWheel t;
  const Model robots = t.subject.model.with_little_differences();
  const Model straight = t.unsure(0, robots), further = t.unsure(1, robots);
  const Fit fit = robots.held(t.fit);
  const auto little = t.beside_longer_ways(0.002), much = t.beside_longer_ways(0.03);
  const double before = lost(straight, fit, little), after = lost(further, fit, little);
  const double much_before = lost(straight, fit, much), much_after = lost(further, fit, much);
  std::printf("ways longer by 0.2 %%: %.1f lost, %.1f where slip may roll on; by 3 %%: %.1f, %.1f\n", before, after,
              much_before, much_after);
  EXPECT_GT(before, 50);
  EXPECT_LT(after, 0.5 * before);
  EXPECT_GT(much_after, 10 * before);
}

// How much of a wheel's slip is lost as misfit: log density of a fit under the slip of another floor, against none.
double lost_by_slip(const Recording& recording, const Scatter& scatter, double friction) {
  const Replay replay(scenario_of(recording, "."), recording);
  const Campaign campaign = campaign_of(recording);
  const Model model(campaign, remembered(testing::simulator(replay), recording), scatter);
  return lost(model, model.none(), {effect("slippery_floor", {{"friction", friction}})});
}

// A robot that turns eight times too fast slips on ordinary floors, and no header says how well they hold. One that
// keeps to its course slips on none of them, and on ice as much as before.
TEST(OrdinaryFloor, ForgivesTheSlipOfARobotThatIsDrivenTooHard) {
  Scatter unforgiving;
  unforgiving.friction = 10;
  Scenario s = testing::squares(2, 1);
  testing::add_noise(s, 13);
  const Recording calm = run_experiment(s, 0).recording;
  s.effects = {effect("fast_turning", {{"factor", 8}})};
  const Recording hard = run_experiment(s, 0).recording;
  const double slip = lost_by_slip(hard, unforgiving, 0.35), forgiven = lost_by_slip(hard, Scatter{}, 0.35);
  const double ice = lost_by_slip(calm, unforgiving, 0.02), same_ice = lost_by_slip(calm, Scatter{}, 0.02);
  std::printf("driven too hard, a floor of 0.35: %.0f lost, %.0f; calm, on ice: %.0f, %.0f\n", slip, forgiven, ice,
              same_ice);
  EXPECT_GT(slip, 100);
  EXPECT_LT(forgiven, 0.1 * slip);
  EXPECT_GT(ice, 10);
  EXPECT_EQ(same_ice, ice);
}

// What an effect may do otherwise excuses what is added to it, and no explanation that does without it.
TEST(UnsureModel, IsAskedForWhatStandsBesideAnEffectAndNotForWhatStandsInItsPlace) {
  Scenario s = testing::squares(2, 2);
  testing::add_noise(s, 12);
  s.effects = {effect("wheelbase", {{"relative", 0.013}}), effect("wheel_radius_difference", {{"relative", 0.0005}})};
  const Subject subject(run_experiment(s, 0).recording);
  const Model& model = subject.model;
  const Fit none = model.none();
  const Fit wider = fit_of(model, {"wheelbase"});
  const Fit toed = fit_of(model, {"wheel_misalignment"});
  const Fit pair = fit_of(model, {"wheelbase", "wheel_radius_difference"});
  Needed beside_wider = addition_needed(model, wider, none, Thresholds{});
  Needed beside_toed = addition_needed(model, toed, none, Thresholds{});
  EXPECT_TRUE(pays(model, wider, pair, beside_wider));
  EXPECT_TRUE(pays(model, toed, pair, beside_toed));
  // A model that excuses whatever the first effect leaves.
  for (Needed* needed : {&beside_wider, &beside_toed}) {
    needed->beside = std::make_shared<const Model>(model);
    needed->base_beside = 1e6;
  }
  EXPECT_FALSE(pays(model, wider, pair, beside_wider));
  EXPECT_TRUE(pays(model, toed, pair, beside_toed));
}

// Held at four fifths of its size an effect that acts in proportion does a quarter more than it should, in whatever
// part of the course it shows.
TEST(SignatureShares, SayByHowMuchEachPieceIsOff) {
  Scenario s = testing::squares(2, 2);
  testing::add_noise(s, 11);
  s.effects = {effect("wheelbase", {{"relative", 0.03}})};
  const Subject subject(run_experiment(s, 0).recording);
  std::vector<Hypothesis> wider = plain_hypotheses(0.02, 2000);
  std::erase_if(wider, [](const Hypothesis& h) { return h.effect != "wheelbase"; });
  const Fit fit = subject.model.fit(wider);
  Fit less = fit;
  less.p *= 0.8;
  less.predicted = subject.model.predict({less.effects()}).front();
  const SignatureShares shares = signature_shares(subject.model, less, 0);
  const Eigen::Index n = Eigen::Index(shares.part.size());
  ASSERT_EQ(shares.precision.rows(), n);
  const Eigen::MatrixXd covariance = (shares.precision + Eigen::MatrixXd::Identity(n, n)).inverse();
  const Eigen::VectorXd off = covariance * shares.pull;
  int known = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double sd = std::sqrt(covariance(i, i));
    std::printf("piece %d, part %d: %.3f +- %.3f\n", int(i), int(shares.part[std::size_t(i)]), off[i], sd);
    if (sd > 0.05) continue;
    ++known;
    EXPECT_NEAR(off[i], 0.25, 3 * sd);
  }
  EXPECT_GE(known, 1);
  const Eigen::VectorXd wide = Eigen::VectorXd::Constant(n, 0.3);
  std::printf("pieces that are off gain %.1f, those of the fit %.1f\n", shares.gain(wide),
              signature_shares(subject.model, fit, 0).gain(wide));
  EXPECT_GT(shares.gain(wide), 50);
  EXPECT_LT(signature_shares(subject.model, fit, 0).gain(wide), 0);
}

}  // namespace
}  // namespace umbsim::gap

// Effects that the catalogue lacks, and what makes them known as unknown.
#include "gap/answer/unknown.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "core/random.h"
#include "gap/answer/twin.h"
#include "gap/evidence/generic.h"
#include "gap/evidence/impulsive_residuals.h"
#include "gap/plan/ties.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

std::string first(const Diagnosis& d) { return d.causes.front().name; }

TEST(Unknown, NothingWrongHasNeitherImpulsesNorLateReadings) {
  double impulse = 0;
  double late = 0;
  for (const std::uint64_t seed : {61, 62, 63}) {
    const Subject p(campaign({}, seed));
    impulse = std::max(impulse, strongest(find_impulses(p.model, p.model.none())));
    late = std::max(late, late_gain(p.model, p.model.none()));
  }
  std::cout << "log evidence without any effect: impulse " << impulse << ", late readings " << late << "\n";
  EXPECT_LT(impulse, Thresholds{}.sudden / 2);
  EXPECT_LT(late, Thresholds{}.late / 10);
}

// A camera that is three centimetres off sees a robot that stands here and there: it passes no place again by that.
TEST(Unknown, ARobotThatStandsPassesNoPlaceAgain) {
  Recording r = campaign({}, 61);
  r.truth_position_sd_m = r.truth_heading_sd_rad = 0.03;
  RandomStream random(5, "camera");
  for (RecordedRun& run : r.runs) {
    const double still_s = 30;
    const EncoderSample last = run.encoders.back();
    for (double t = 0.02; t < still_s; t += 0.02) {
      run.encoders.push_back(last);
      run.encoders.back().time_s += t;
    }
    const TruthSample end = run.truth.back();
    for (double t = 0.05; t < still_s - 0.1; t += 0.05) run.truth.push_back({end.time_s + t, end.X_WB});
    for (TruthSample& t : run.truth) {
      for (double* number : {&t.X_WB.x_m, &t.X_WB.y_m, &t.X_WB.theta_rad}) *number += 0.03 * random.normal();
    }
  }
  const Subject p(std::move(r));
  const Impulses found = find_impulses(p.model, p.model.none());
  ASSERT_FALSE(found.places.empty());
  int most = 0;
  for (const PlaceImpulse& place : found.places) most = std::max(most, place.passes);
  std::cout << "impulse " << strongest(found) << " of log evidence, " << most << " passes at most of "
            << p.recording.runs.size() << " runs\n";
  EXPECT_LT(strongest(found), Thresholds{}.sudden / 2);
  EXPECT_LE(most, 3 * int(p.recording.runs.size()));
}

// What acts through contacts may leave 15 % in another engine, what rolls and what is of this engine 1 %.
// Where errors of no particular cause alone are likelier, a cause is none.
TEST(Unknown, ACauseMayLeaveAsMuchAsEnginesDiffer) {
  constexpr double kExplained = 1000;
  constexpr bool kElsewhere = true, kAtHome = false;
  const Thresholds t;
  LeftUnexplained none, left;
  none.density = -500;
  left.density = -100;
  left.in_tracks = 60;
  EXPECT_FALSE(is_unknown(left, none, kExplained, kElsewhere, t));
  EXPECT_TRUE(is_unknown(left, none, kExplained, kAtHome, t));
  left.density = -600;
  EXPECT_TRUE(is_unknown(left, none, kExplained, kElsewhere, t));
  left.in_tracks = 1;
  EXPECT_FALSE(is_unknown(left, none, kExplained, kElsewhere, t)) << "nothing is left that could be another cause";
}

// A motor's lag explains that counts follow commands late, and not that the tracker saw the robot turn before.
TEST(Unknown, LateCountsAreNoSlowMotor) {
  const Subject p(campaign({effect("encoder_latency", {{"seconds", 0.03}})}, 64));
  EXPECT_EQ(first(p.diagnosed()), "encoder_latency");
  const Diagnosis without = p.diagnosed({"encoder_latency"});
  std::cout << "late readings: " << late_gain(p.model, p.model.none()) << " of log evidence, then " << first(without)
            << "\n";
  EXPECT_GT(late_gain(p.model, p.model.none()), Thresholds{}.late);
  EXPECT_EQ(first(without), "unknown");
}

// Rare counts are late by half an interval on the mean, and stand still in between. Where the catalogue lacks them that
// is what is named, and it is said that something is left.
TEST(Unknown, RareCountsAreMoreThanLateOnes) {
  const Subject p(campaign({effect("encoder_sampling", {{"interval_s", 0.024}})}, 67));
  EXPECT_EQ(first(p.diagnosed()), "encoder_sampling");
  const Diagnosis without = p.diagnosed({"encoder_sampling"});
  std::cout << "left of " << without.closure.before_mm << " mm: " << without.closure.after_mm << ", noise makes "
            << without.closure.floor_mm << "\n";
  EXPECT_TRUE(without.unexplained);
  EXPECT_GT(without.closure.after_mm, 1.2 * without.closure.floor_mm);
}

// Wheels that wear alike shorten every run more; in the mean over all they are smaller wheels.
TEST(Unknown, WearOfBothWheelsIsNoSmallerWheel) {
  Scenario worn = testing::squares(2, 4);
  testing::add_noise(worn, 68);
  worn.effects = {effect("wear", {{"left_relative_per_run", -2e-4}, {"right_relative_per_run", -2e-4}})};
  const Subject p(run_experiment(worn, 0).recording);
  EXPECT_EQ(first(p.diagnosed()), "wear");
  EXPECT_EQ(first(p.diagnosed({"wear"})), "unknown");
}

TEST(Unknown, AWeakPushThatTheCatalogueLacks) {
  const Effect push = effect("push", {{"impulse_newton_seconds", 20}, {"leg", 2}, {"seconds_into_leg", 3}}, "cw-1");
  const Subject p(campaign({push}, 65));
  EXPECT_EQ(first(p.diagnosed()), "push");
  const Diagnosis without = p.diagnosed({"push"});
  std::cout << "impulse: " << strongest(find_impulses(p.model, p.model.none())) << " of log evidence, then "
            << first(without) << "\n";
  EXPECT_EQ(first(without), "unknown");
}

// Were both radii off by little, soft tyres would be named in their place: the exclusion decides, and is told so.
TEST(Unknown, AnExcludedDoubleIsListedAsSuch) {
  const Subject p(campaign({effect("wheel_radius_scale", {{"relative", -0.0004}})}, 66));
  const std::set<std::string> excluded{"wheel_radius_scale"};
  const Diagnosis d = p.diagnosed(excluded);
  ASSERT_EQ(first(d), "tyre_compliance");
  const Ties ties = find_ties(p.model, d, excluded, Thresholds{});
  const bool listed = std::any_of(ties.groups.begin(), ties.groups.end(), [](const std::vector<std::string>& g) {
    return std::count(g.begin(), g.end(), "wheel_radius_scale") > 0;
  });
  EXPECT_TRUE(listed);
  EXPECT_EQ(std::count(ties.members.begin(), ties.members.end(), "wheel_radius_scale"), 0);
}

// A cable mends a part of any misfit: what it takes away does not speak for what is named beside it.
TEST(Unknown, WhatAPlaceTakesAwayIsNotCounted) {
  Recording real = campaign({}, 64);
  real.truth_heading_sd_rad = 0.002;
  const Subject p(real);
  Fit fit;
  for (const Hypothesis& f : plain_hypotheses(0.02, 2000)) {
    if (f.effect == "wheelbase") fit.hypotheses.push_back(f);
  }
  fit.hypotheses.push_back(bump_hypothesis(1, 0, 0));
  Closure closure;
  closure.known = true;
  closure.before_mm = 40;
  closure.after_mm = 10;
  closure.worth = {{25, 0}, {5, 0}};
  EXPECT_TRUE(worth_more_than_rest(p.model, fit, closure));
  closure.worth = {{5, 0}, {25, 0}};
  EXPECT_FALSE(worth_more_than_rest(p.model, fit, closure));
  std::rotate(fit.hypotheses.begin(), fit.hypotheses.begin() + 1, fit.hypotheses.end());
  fit.hypotheses.pop_back();
  closure.worth = {{30, 0}};
  EXPECT_FALSE(worth_more_than_rest(p.model, fit, closure)) << "a place alone";
  fit.hypotheses.front() = plain_hypotheses(0.02, 2000).front();
  EXPECT_TRUE(worth_more_than_rest(p.model, fit, closure));
  const Subject known(campaign({}, 64));
  EXPECT_FALSE(worth_more_than_rest(known.model, fit, closure)) << "a tracker that is known";
  closure.most_noise_mm = 12;
  EXPECT_TRUE(worth_more_than_rest(known.model, fit, closure)) << "another engine's runs are told within their noise";
  closure.before_mm = 15;
  EXPECT_FALSE(worth_more_than_rest(known.model, fit, closure)) << "noise may be all that is left, but most is left";
  closure.before_mm = 40;
  fit.prior = known.model.none().prior;
  ASSERT_TRUE(known.model.same_engine(fit));
  EXPECT_FALSE(worth_more_than_rest(known.model, fit, closure)) << "this engine has no error of its own";
}

// On another engine's runs a radius or a wheelbase may mend its contacts. On this engine's they do not.
TEST(Unknown, DimensionsAndContactsMendAnotherEngine) {
  Subject p(campaign({}, 65));
  EXPECT_FALSE(mends_contacts(p.model, p.model.none(), "wheelbase"));
  p.model.take_for_another_engines();
  for (const char* effect : {"wheelbase", "wheel_radius_scale", "tyre_creep", "slippery_floor"})
    EXPECT_TRUE(mends_contacts(p.model, p.model.none(), effect)) << effect;
  for (const char* effect : {"wear", "encoder_latency", "wheel_eccentricity", "fast_turning"})
    EXPECT_FALSE(mends_contacts(p.model, p.model.none(), effect)) << effect;
}

}  // namespace
}  // namespace umbsim::gap

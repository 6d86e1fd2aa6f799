// What a diagnosis says in plain words, for every kind of answer.
#include "gap/output/verdict.h"

#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "core/text/wrapped_text.h"
#include "effects/catalogue.h"
#include "gap/answer/where.h"
#include "gap/output/diagnosis_json.h"
#include "gap/output/diagnosis_text.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::hypothesis_of;

/// A cause whose numbers are known to `share` of themselves.
Cause cause(const std::vector<Hypothesis>& hypotheses, const std::vector<double>& numbers, double share) {
  Cause c;
  c.fit.hypotheses = hypotheses;
  c.fit.p = Eigen::Map<const Eigen::VectorXd>(numbers.data(), Eigen::Index(numbers.size()));
  const Eigen::VectorXd sd = share * c.fit.p.cwiseAbs();
  c.fit.covariance = sd.cwiseAbs2().asDiagonal();
  c.name = c.fit.name();
  c.probability = 0.99;
  return c;
}

Cause wheelbase(double relative) { return cause({hypothesis_of("wheelbase", "relative")}, {relative}, 0.1); }

Cause unknown_cause() {
  Cause c;
  c.name = "unknown";
  c.probability = 0.99;
  return c;
}

/// A gap of 45 mm, of which one cause takes 34 mm away.
Diagnosis found(std::vector<Cause> causes) {
  Diagnosis d;
  d.detected = true;
  d.before_mm = 45.2;
  d.noise_floor_mm = 6.1;
  d.closure = {true, 0.95, {0.9, 0.98}, 45.2, 11.1, 6.1, 8.0, 3, 0.4, {{34.1, 2.6}}};
  d.causes = std::move(causes);
  d.twin = d.causes.front().fit;
  d.set = {d.causes.front().name};
  return d;
}

std::string said(const Diagnosis& d, const std::vector<NextExperiment>& next = {}) {
  const std::string text = verdict(d, next);
  std::cout << text << "\n\n";
  EXPECT_EQ(text.back(), '.');
  EXPECT_EQ(text.find("  "), std::string::npos) << text;
  EXPECT_EQ(text.find_first_of("{}[]_"), std::string::npos) << text;
  return text;
}

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

TEST(Verdict, OneCauseWithWhatItTakesAwayAndWhereTheRestSits) {
  Diagnosis d = found({wheelbase(0.005)});
  d.left_over.where = "along the legs";
  const std::string text = said(d);
  EXPECT_EQ(text.find("The wheelbase is 0.50 % (0.40 to 0.60 %) larger than believed. That takes away 34 of 45 mm on "
                      "runs that were held out. 11 mm remain unexplained, mostly along the legs, where noise alone "
                      "makes 6 mm."),
            0u)
      << text;
  EXPECT_EQ(text.find("cannot tell"), std::string::npos) << "nothing is tied";
}

TEST(Verdict, WhatIsNoMoreThanNoiseIsNotCalledUnexplained) {
  Diagnosis d = found({wheelbase(-0.005)});
  d.closure.after_mm = 7.4;
  d.left_over.where = "in the turns";
  const std::string text = said(d);
  expect_in(text, "smaller than believed");
  expect_in(text, "The 7 mm that remain are no more than noise makes.");
  EXPECT_EQ(text.find("unexplained"), std::string::npos) << text;
}

TEST(Verdict, SeveralCausesAreASentenceEachInTheOrderOfTheirNames) {
  const std::string text = said(found(
      {cause({hypothesis_of("wheelbase", "relative"), hypothesis_of("encoder_latency", "delay")}, {0.005, 0.1}, 0.1)}));
  EXPECT_EQ(text.find("The encoders' readings arrive 100 ms"), 0u) << text;
  expect_in(text, ". The wheelbase is 0.50 %");
  expect_in(text, "Together they take away 34 of 45 mm");
}

TEST(Verdict, TiesAndTheNextExperiment) {
  Diagnosis d = found({wheelbase(0.005)});
  d.set = {"wheelbase", "backlash+wheel_radius_difference"};
  d.indistinguishable = {{"wheelbase", "contact_patch"}};
  const std::string text = said(d, {{"fast (0.4 m/s), cw and ccw", {"wheelbase", "contact_patch"}, 20}});
  expect_in(text,
            "These runs cannot tell it from play between motors and wheels together with wheels of unequal size or "
            "wheels that touch the floor over some width.");
  expect_in(text, "Next, to tell them apart, drive: fast (0.4 m/s), cw and ccw.");
  expect_in(said(d), "No kind of run that the diagnosis knows is expected to.");
}

TEST(Verdict, OfCombinationsOnlyThePartInDoubtIsNamed) {
  Diagnosis d = found(
      {cause({hypothesis_of("wheelbase", "relative"), hypothesis_of("encoder_latency", "delay")}, {0.005, 0.1}, 0.1)});
  d.set = {"encoder_latency+wheelbase", "motor_response+wheelbase"};
  d.indistinguishable = {{"wheelbase", "contact_patch"}};
  expect_in(said(d),
            "These runs cannot tell encoder readings that arrive late from motors that do not follow their "
            "commands, nor a wheelbase other than believed from wheels that touch the floor over some width.");
}

TEST(Verdict, NoGapSaysHowFarOffAndWhatCouldStillBe) {
  Diagnosis d;
  d.before_mm = 9.5;
  d.noise_floor_mm = 7.6;
  Cause none;
  none.name = "none";
  d.causes = {none};
  d.set = {"none"};
  EXPECT_EQ(said(d),
            "No gap beyond noise is proved: the scenario is off by 9.5 mm along the runs, and run-to-run noise alone "
            "makes 7.6 mm.");
  d.set = {"none", "wheelbase"};
  expect_in(said(d), "Too small to be proved by these runs, but possible: a wheelbase other than believed.");
}

TEST(Verdict, UnknownNamesWhatComesNearestAndWhereTheRestSits) {
  Cause nearest = cause({hypothesis_of("slippery_floor", "friction")}, {0.06}, 0.1);
  nearest.squared_error_drop = 0.19;
  Diagnosis d = found({unknown_cause(), nearest});
  d.set = {"unknown", "slippery_floor"};
  d.left_over.where = "in the turns";
  EXPECT_EQ(said(d),
            "No effect of the catalogue explains the gap: the scenario is off by 45 mm along the runs, and "
            "run-to-run noise alone makes 6.1 mm. What comes nearest is a slippery floor, with 4 of 45 mm on "
            "these very runs; 41 mm would remain, mostly in the turns.");
  d.causes.back().squared_error_drop = 0.01;
  expect_in(said(d), "Nothing in it comes near. The gap sits mostly in the turns.");
}

TEST(Verdict, APlaceHasItsWheel) {
  Diagnosis d = found({cause({bump_hypothesis(2, -0.17, 0)}, {0.006, 0.001}, 0.1)});
  d.has_place = true;
  d.place_m[0] = 2.001;
  d.place_m[1] = -0.17;
  d.place_wheel = "right";
  const std::string text = said(d);
  EXPECT_EQ(text.find("A cable or step of 6.0 mm"), 0u) << text;
  expect_in(text, "under the right wheel at (2.00");
}

TEST(Verdict, APushHasItsRunAndLeg) {
  const std::string text = said(found({cause({push_hypothesis("cw-1", 2, 6, 40)}, {-30, 0.001}, 0.1)}));
  EXPECT_EQ(text.find("Something pushed the robot to the right with 30"), 0u) << text;
  expect_in(text, "into leg 2 of run cw-1.");
}

TEST(Verdict, MissingClosureIsSaid) {
  Diagnosis d = found({wheelbase(0.005)});
  d.closure = {};
  d.causes.front().squared_error_drop = 0.75;
  expect_in(said(d),
            "On these very runs that takes away 22 of 45 mm; how much it would be on others is not known, for "
            "all were driven alike.");
  d.closure.before_mm = d.closure.after_mm = 5;  // held out, but within noise
  d.closure.most_noise_mm = 6;
  expect_in(said(d), "No track strays by more than noise makes it");
  d.closure.most_noise_mm = 4;  // a gap, and a cause that moves no pose
  expect_in(said(d), "But that takes nothing away on runs that were held out.");
  d = found({wheelbase(0.005)});
  d.twin = {};
  d.closure.after_mm = d.closure.before_mm;
  expect_in(said(d), "takes nothing away on runs that were held out: the twin goes without.");
}

// Dimensions that foretell what a cause leaves belong to the twin, on the page and in the file.
TEST(Verdict, EffectiveDimensionsAreNoCause) {
  Diagnosis d = found({cause({hypothesis_of("wheel_radius_difference", "right over left")}, {0.002}, 0.1)});
  d.closure.before_mm = 45;
  d.closure.after_mm = 40;
  d.effective = EffectiveTwin{{"wheelbase"}, wheelbase(0.013).fit, d.closure};
  d.effective->closure.fraction = 0.98;
  d.effective->closure.after_mm = 6;
  expect_in(said(d), "That takes away 5 of 45 mm on runs that were held out.");
  expect_in(said(d), "In the twin, the wheelbase is 1.3");
  expect_in(said(d), "larger than believed, in place of what is named. That is no cause");
  expect_in(said(d), "with it 6 mm of 45 mm remain");
  const nlohmann::json json = diagnosis_json(d);
  EXPECT_EQ(json["closure"]["held_out_fraction"], 0.98);
  const auto& effective = json["closure"]["effective"];
  EXPECT_EQ(effective["after_mm_without"], 40);
  EXPECT_FALSE(effective["beside_causes"]);
  EXPECT_EQ(effective["dimensions"]["wheelbase"]["relative"]["value"], 0.013);
  EXPECT_FALSE(json["causes"][0]["effects"].contains("wheelbase"));
}

// What goes with a scrub is said, too: it stands in the twin.
TEST(Verdict, AScrubNamesTheCreepThatItNeeds) {
  Diagnosis d = found({wheelbase(0.005)});
  const Cause scrubs = cause({hypothesis_of("wheelbase", "relative"), scrub_hypothesis()}, {0.005, 0.13}, 0.1);
  d.effective = EffectiveTwin{{"caster_drag"}, scrubs.fit, d.closure};
  expect_in(said(d), "In the twin, the casters drag with 13");
  expect_in(said(d), "of their load and the tyres creep by 5 % along their way");
  EXPECT_TRUE(diagnosis_json(d)["closure"]["effective"]["beside_causes"]);
}

// Everything of the catalogue at once, with the longest names.
TEST(DiagnosisText, FitsATerminal) {
  std::vector<Hypothesis> longest{hypothesis_of("wheel_radius_difference", "right over left"),
                                  hypothesis_of("encoder_missed_counts", "left and right"),
                                  hypothesis_of("wheel_misalignment", "both")};
  Diagnosis d = found({cause(longest, {0.002, 0.001, 0.002, 0.01, -0.01}, 0.3),
                       cause({longest[0], longest[1]}, {0.002, 0.001, 0.002}, 0.3), wheelbase(0.01)});
  for (const Cause& c : d.causes) d.set.push_back(c.name);
  d.indistinguishable = {{"wheel_radius_difference", "encoder_missed_counts", "wheel_eccentricity", "slippery_patch"}};
  d.unexplained = true;
  d.left_over.description =
      "55 % of what is left sits in the turns, 60 % in run ccw-1; most in run ccw-1, leg 3 (cruise), near (1, 2) m";
  d.limits = {std::string(60, 'a') + " " + std::string(60, 'b')};
  const std::string text =
      diagnosis_text(d, {{"dwell of 3 s at the corners, cw and ccw",
                          {"encoder_missed_counts", "wheel_radius_difference", "wheel_misalignment"},
                          9}});
  std::cout << text;
  std::size_t widest = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    widest = std::max(widest, columns_of(text.substr(at, end - at)));
    at = end + 1;
  }
  EXPECT_LE(widest, kColumns);
  EXPECT_GT(widest, kColumns / 2);
  // Each number by its effect: the names come in their order, and the numbers stand with them.
  const std::size_t missed = text.find("encoder_missed_counts: left 0.10 %");
  const std::size_t toe = text.find("wheel_misalignment: left toe 0.57°");
  const std::size_t radii = text.find("wheel_radius_difference: 0.2");
  EXPECT_LT(missed, toe);
  EXPECT_LT(toe, radii);
  EXPECT_NE(radii, std::string::npos) << text;
}

// A table that the compiler does not check against the catalogue.
TEST(Pattern, EveryEffectHasOne) {
  for (const EffectInfo& info : catalogue()) EXPECT_NE(traits_of(info.name).pattern, "") << info.name;
  EXPECT_EQ(traits_of("no such effect").pattern, "");
}

}  // namespace
}  // namespace umbsim::gap

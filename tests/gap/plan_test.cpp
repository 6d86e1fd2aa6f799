// What runs can tell apart before any data, against closed forms and what is known of the effects.
#include "gap/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "experiment/drive/planned_runs.h"
#include "gap/plan/menu.h"
#include "gap/plan/select.h"
#include "tests/gap/recordings.h"

namespace umbsim::gap {
namespace {

constexpr double kSeverity = 3;
constexpr double kScatter = 5e-5;

/// Runs of the menu that the nominal LabMate drove, by the part of their ids after the direction.
Recording driven(const std::vector<std::string>& kinds, bool commands = true) {
  const Scenario s = testing::squares(2, 1);
  Recording all = run_experiment(s, 0).recording;
  all.runs.clear();
  for (const std::string& kind : kinds) {
    for (const MenuRun& m : plan_menu(all.path, s.course.dwell_s, 15)) {
      if (m.run.id != "menu-cw-" + kind && m.run.id != "menu-ccw-" + kind) continue;
      Recording planned = all;
      planned.runs = {m.run};
      all.runs.push_back(drive_planned_runs(s, load_scenario_robot(s), planned).runs.front());
    }
  }
  if (!commands) {
    for (RecordedRun& run : all.runs) run.has_commands = false;
  }
  return all;
}

struct PlannedSubject {
  explicit PlannedSubject(Recording r)
      : recording(std::move(r)),
        replay(scenario_of(recording, "."), recording),
        campaign(campaign_of(recording)),
        model(campaign, testing::simulator(replay), Scatter{}, NoiseModel{}) {}

  /// Mean probability of naming one of two effects for the other, both at the usual severity; -1 if one is not shown.
  double alike(const std::string& a, const std::string& b) const {
    PlanOptions options;
    options.effects = {a, b};
    const Separation s = plan(model, recording.runs.size(), kScatter, options).given;
    const double mistaken = (s.race.mistaken(0, 1) + s.race.mistaken(1, 0)) / 2;
    std::cout << a << ", " << b << ": mistaken " << mistaken << ", none " << s.race.named(0, 2) << " "
              << s.race.named(1, 2) << "\n";
    return s.not_shown.empty() ? mistaken : -1;
  }

  Recording recording;
  Replay replay;
  Campaign campaign;
  Model model;
};

constexpr double kAlike = 0.1;  // of PlanOptions
// Soft tyres and missed counts act as wheels that are too small, never as wheels that are too large. Of two effects
// with one signature the one with the narrower prior wins always: of the wheels too small one way, which are half of
// them.
constexpr double kOneSignature = 0.25;
constexpr double kSamplingError =
    0.05;  // four standard errors of a quarter over 400 draws, halved by the mean, and the noise

TEST(Plan, PlainSquaresDoNotTellSoftTyresFromSmallWheelsAndAPayloadDoes) {
  EXPECT_NEAR(PlannedSubject(driven({"plain"})).alike("tyre_compliance", "wheel_radius_scale"), kOneSignature,
              kSamplingError);
  const double with_payload =
      PlannedSubject(driven({"plain", "loaded"})).alike("tyre_compliance", "wheel_radius_scale");
  EXPECT_GE(with_payload, 0);
  EXPECT_LT(with_payload, kAlike);
}

TEST(Plan, MissedCountsAreRadiiUnlessCommandsShowThem) {
  const double without = PlannedSubject(driven({"plain"}, false)).alike("encoder_missed_counts", "wheel_radius_scale");
  const double with = PlannedSubject(driven({"plain"})).alike("encoder_missed_counts", "wheel_radius_scale");
  EXPECT_NEAR(without, kOneSignature, kSamplingError);
  EXPECT_LT(with, kAlike);
}

TEST(Plan, PlainSquaresDoNotTellCarpetFromSlope) {
  PlanOptions options;
  options.effects = {"carpet_drift", "floor_slope"};
  const PlannedSubject s(driven({"plain"}));
  const Plan p = plan(s.model, s.recording.runs.size(), kScatter, options);
  EXPECT_EQ(p.given.separated, 0);
}

TEST(Plan, ARotatedStartTellsCarpetFromGeometry) {
  const PlannedSubject s(driven({"plain", "rotated"}));
  for (const char* geometry : {"wheel_misalignment", "wheel_radius_difference", "wheelbase"}) {
    const double alike = s.alike("carpet_drift", geometry);
    EXPECT_GE(alike, 0) << geometry;
    EXPECT_LT(alike, kAlike) << geometry;
  }
}

Signature one_number(const std::string& effect, int first, double prior_sd) {
  Signature s;
  s.planned.hypothesis = {effect,
                          "",
                          {{"x", 0, 1, prior_sd, -1e9, 1e9}},
                          [effect](const Eigen::VectorXd&) { return neutral_effect(find_effect(effect)).values; },
                          {},
                          true,
                          0};
  s.first = first;
  s.count = 1;
  s.prior_sd = Eigen::VectorXd::Constant(1, prior_sd);
  s.positive = {false};
  s.unit = Eigen::VectorXd::Ones(1);
  s.rows = {Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1)};
  s.features = Eigen::MatrixXd(0, 1);
  return s;
}

TEST(PlanRace, OneNumberAgainstNoneInClosedForm) {
  constexpr double kInformation = 2.5, kPrior = 4, kSize = 3;
  constexpr int kDraws = 20000;
  const std::vector<Signature> signatures{one_number("wheelbase", 0, kPrior)};
  const Thresholds t;
  const Race r = race(Eigen::MatrixXd::Constant(1, 1, kInformation), signatures, t, {kSize, kDraws, 1});
  // b ~ N(a p, a); found where b^2 / (2 (a + 1 / s^2)) - log(1 + a s^2) / 2 - cost > what an effect that rolls needs.
  const double a = kInformation;
  const double limit = std::sqrt(2 * (a + 1 / (kPrior * kPrior)) *
                                 (t.detect_rolling + t.effect_cost + 0.5 * std::log(1 + a * kPrior * kPrior)));
  const auto above = [&](double mean) { return 0.5 * std::erfc((limit - mean) / std::sqrt(2 * a)); };
  const double expected = above(a * kSize) + above(-a * kSize);
  const double sampling_error = 4 * std::sqrt(expected * (1 - expected) / kDraws);
  EXPECT_NEAR(r.named(0, 0), expected, sampling_error);
  EXPECT_NEAR(r.named(0, 1), 1 - expected, sampling_error);
  EXPECT_NEAR(r.severity[0], kSize, 1e-9);
}

TEST(PlanRace, TheSameColumnIsAHalfEachAndAnOrthogonalOneNever) {
  Eigen::Matrix3d A = 20 * Eigen::Matrix3d::Identity();
  A(0, 1) = A(1, 0) = 20;  // one column twice
  const std::vector<Signature> signatures{one_number("wheel_radius_scale", 0, 4), one_number("wheelbase", 1, 4),
                                          one_number("carpet_drift", 2, 4)};
  const Race r = race(A, signatures, Thresholds{}, {kSeverity, 300, 1});
  EXPECT_NEAR(r.mistaken(0, 1), 0.5, 1e-9);
  EXPECT_NEAR(r.mistaken(1, 0), 0.5, 1e-9);
  EXPECT_EQ(r.mistaken(0, 2), 0);
  EXPECT_EQ(r.mistaken(2, 0), 0);
  const Separation s = separation(r, PlanOptions{});
  EXPECT_EQ(s.groups, (std::vector<std::vector<std::string>>{{"wheel_radius_scale", "wheelbase"}}));
  EXPECT_EQ(s.separated, 2);
  // The same draws give the same answer.
  EXPECT_EQ(race(A, signatures, Thresholds{}, {kSeverity, 300, 1}).named, r.named);
}

TEST(PlanSelect, TheShortestSetAndNothingThatIsNotNeeded) {
  // Run 0 separates a little of everything, which lets it go first; runs 1 and 2 together separate all that it does.
  const Judge judge = [](const std::vector<std::size_t>& runs) {
    Separation s;
    const auto has = [&](std::size_t r) { return std::find(runs.begin(), runs.end(), r) != runs.end(); };
    s.separated = (has(0) || has(1) ? 1 : 0) + (has(0) || has(2) ? 1 : 0) + (has(1) ? 1 : 0) + (has(2) ? 1 : 0);
    s.soft = s.separated + (has(0) ? 0.5 : 0);
    return s;
  };
  const Recommendation r = select_runs({}, {0, 1, 2, 3}, judge);
  ASSERT_EQ(r.steps.size(), 2u);
  EXPECT_EQ(r.result.separated, 4);
  for (const PlanStep& step : r.steps) EXPECT_TRUE(step.run == 1 || step.run == 2);
}

TEST(PlanMenu, EveryKindBothWays) {
  RecordedPath path;
  path.side_m = 1;
  const auto menu = plan_menu(path, 0.2, 15);
  for (std::size_t i = 0; i < menu.size(); ++i) EXPECT_EQ(menu[i].run.direction, i % 2 == 0 ? "cw" : "ccw");
  for (const MenuRun& m : menu) {
    if (m.run.turn_radius_m) {
      EXPECT_LT(*m.run.turn_radius_m, path.side_m / 2);
    }
  }
}

}  // namespace
}  // namespace umbsim::gap

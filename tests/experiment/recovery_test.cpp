// The whole way in Bullet without noise: nominal robot, published example, recovery of injected errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "experiment/run.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::shipped;

// Bars of the project's table of figures.
constexpr double kNominal_m = 0.05e-3;
constexpr double kNominal_rad = 0.002 * M_PI / 180;
constexpr double kMirror = 1e-6;
constexpr double kPublished_mm = 0.1;
constexpr double kPublished_deg = 0.005;
constexpr double kCalibrated_mm = 0.5;
constexpr double kRecovered = 1e-5;

TEST(Nominal, ReturnsWithoutErrorAndInMirrorImages) {
  const ExperimentResult r = run_experiment(shipped("nominal"), 0);
  for (const Cluster* c : {&r.cw, &r.ccw}) {
    std::cout << fmt::format("nominal: {:.5f} mm, {:.6f} deg\n", 1000 * c->r_cg_m, degrees(c->heading_rad));
    EXPECT_LE(c->r_cg_m, kNominal_m);
    EXPECT_LE(std::abs(c->heading_rad), kNominal_rad);
  }
  EXPECT_EQ(r.cost.solver_fallbacks, 0);
  const std::vector<TruthSample>&cw = r.recording.runs[0].truth, &ccw = r.recording.runs[1].truth;
  ASSERT_EQ(cw.size(), ccw.size());
  double worst = 0;
  for (std::size_t i = 0; i < cw.size(); ++i) {
    const Pose2 &a = cw[i].X_WB, &b = ccw[i].X_WB;
    worst = std::max({worst, std::abs(a.x_m - b.x_m), std::abs(a.y_m + b.y_m), std::abs(a.theta_rad + b.theta_rad)});
  }
  std::cout << "nominal: cw and mirrored ccw differ by " << worst << " m or rad anywhere on the way\n";
  EXPECT_LE(worst, kMirror);
  EXPECT_NEAR(cw.back().X_WB.theta_rad, -2 * M_PI, 1e-3) << "it has driven the square";
}

TEST(LabmateExact, PublishedFiguresAndCalibration) {
  const ExperimentResult r = run_experiment(shipped("labmate_exact"), 0);
  ASSERT_TRUE(r.umbmark);
  const Umbmark& u = *r.umbmark;
  std::cout << fmt::format("cw ({:.3f}, {:.3f}) mm {:.4f} deg; ccw ({:.3f}, {:.3f}) mm {:.4f} deg; E_max {:.3f} mm\n",
                           1000 * u.cw.centroid_x_m, 1000 * u.cw.centroid_y_m, degrees(u.cw.heading_rad),
                           1000 * u.ccw.centroid_x_m, 1000 * u.ccw.centroid_y_m, degrees(u.ccw.heading_rad),
                           1000 * u.e_max_syst_m);
  EXPECT_NEAR(1000 * u.cw.centroid_x_m, 63.420, kPublished_mm);
  EXPECT_NEAR(1000 * u.cw.centroid_y_m, 62.558, kPublished_mm);
  EXPECT_NEAR(degrees(u.cw.heading_rad), -1.8118, kPublished_deg);
  EXPECT_NEAR(1000 * u.ccw.centroid_x_m, 229.995, kPublished_mm);
  EXPECT_NEAR(1000 * u.ccw.centroid_y_m, -209.397, kPublished_mm);
  EXPECT_NEAR(degrees(u.ccw.heading_rad), 6.3912, kPublished_deg);
  EXPECT_NEAR(1000 * u.e_max_syst_m, 311.0, kPublished_mm);
  ASSERT_FALSE(r.passes.empty());
  const double after_mm = 1000 * r.passes.back().umbmark.e_max_syst_m;
  std::cout << fmt::format(
      "calibrated: E_max {:.4f} mm ({} passes), recovered E_d {:+.1e}, E_b {:+.1e}, fallbacks {}\n", after_mm,
      r.passes.size(), u.heading.e_d - r.injected.e_d, u.heading.e_b - r.injected.e_b, r.cost.solver_fallbacks);
  EXPECT_LE(1000 * r.passes.front().umbmark.e_max_syst_m, kCalibrated_mm) << "with the first pass";
  EXPECT_LE(after_mm, kCalibrated_mm);
  EXPECT_EQ(r.cost.solver_fallbacks, 0);
}

// Runs of several squares are calibrated as runs of one.
TEST(Recovery, SeveralLapsAreCalibratedAsOne) {
  const ExperimentResult r =
      run_experiment(shipped("labmate_exact", {"course.laps=3", "calibration.method=heading"}), 0);
  ASSERT_TRUE(r.umbmark);
  ASSERT_FALSE(r.passes.empty());
  const double after_mm = 1000 * r.passes.back().umbmark.e_max_syst_m;
  std::cout << fmt::format("three laps: E_max {:.3f} -> {:.4f} mm, E_d {:+.1e}, E_b {:+.1e}\n",
                           1000 * r.umbmark->e_max_syst_m, after_mm, r.umbmark->heading.e_d - r.injected.e_d,
                           r.umbmark->heading.e_b - r.injected.e_b);
  EXPECT_NEAR(r.umbmark->heading.e_d, r.injected.e_d, kRecovered);
  EXPECT_NEAR(r.umbmark->heading.e_b, r.injected.e_b, kRecovered);
  EXPECT_LE(after_mm, kCalibrated_mm);
}

TEST(Recovery, HeadingFormFindsWhatWasInjected) {
  double worst_d = 0, worst_b = 0;
  for (const double e_d : {0.99, 1.0, 1.01}) {
    for (const double e_b : {0.96, 1.0, 1.04}) {
      const ExperimentResult r = run_experiment(
          shipped("nominal", {fmt::format("effects.wheel_radius_difference.relative={}", e_d - 1),
                              fmt::format("effects.wheelbase.relative={}", e_b - 1), "truth.kind=endpoints"}),
          0);
      const ErrorEstimate& found = r.umbmark->heading;
      EXPECT_NEAR(found.e_d, e_d, kRecovered) << e_d << " " << e_b;
      EXPECT_NEAR(found.e_b, e_b, kRecovered) << e_d << " " << e_b;
      EXPECT_EQ(r.cost.solver_fallbacks, 0);
      worst_d = std::max(worst_d, std::abs(found.e_d - e_d));
      worst_b = std::max(worst_b, std::abs(found.e_b - e_b));
    }
  }
  std::cout << "recovery over the grid: E_d within " << worst_d << ", E_b within " << worst_b << "\n";
}

// Lecture 7.4: one direction looks perfect, the other shows it all.
TEST(UnidirectionalTrap, TheErrorsHideOneWay) {
  const ExperimentResult r = run_experiment(shipped("unidirectional_trap", {"calibration.method=none"}), 0);
  std::cout << "trap: cw " << 1000 * r.cw.r_cg_m << " mm, ccw " << 1000 * r.ccw.r_cg_m << " mm\n";
  EXPECT_LT(r.cw.r_cg_m, 0.001);
  EXPECT_GT(r.ccw.r_cg_m, 0.5);
}

TEST(ZeroEffect, DrivesTheNominalRunToTheLastBit) {
  const std::vector<std::string> short_course{"course.side_m=0.5", "runs.directions=[ccw]"};
  std::vector<std::string> zero = short_course;
  for (const EffectInfo& info : catalogue()) zero.push_back("effects." + info.name + "={}");
  const RecordedRun a = run_experiment(shipped("nominal", short_course), 1).recording.runs[0];
  const RecordedRun b = run_experiment(shipped("nominal", zero), 1).recording.runs[0];
  ASSERT_EQ(a.truth.size(), b.truth.size());
  for (std::size_t i = 0; i < a.truth.size(); ++i) {
    EXPECT_EQ(a.truth[i].X_WB.x_m, b.truth[i].X_WB.x_m);
    EXPECT_EQ(a.truth[i].X_WB.y_m, b.truth[i].X_WB.y_m);
    EXPECT_EQ(a.truth[i].X_WB.theta_rad, b.truth[i].X_WB.theta_rad);
  }
}

}  // namespace
}  // namespace umbsim

// Ensembles of simulated robots that roll unevenly: their true positions must scatter as the odometry predicts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <iostream>

#include "experiment/output/result_json.h"
#include "experiment/run.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::shipped;
using testing::TemporaryFolder;

constexpr int kRuns = 200;
constexpr double kShare = 0.95;
constexpr double kBar = 0.03;  // two standard errors of a share of 95 % in 200 runs

// A square of 1 m with both wheels' noise as believed; 200 runs in all.
Scenario ensemble(const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{
      "course={side_m: 1, linear_speed_mps: 0.4, angular_speed_radps: 1.4, linear_acceleration_mps2: 0.5}",
      "runs.per_direction=100", "noise.wheel_noise_m_per_sqrt_m=0.001", "uncertainty.left_m_per_sqrt_m=0.001",
      "uncertainty.right_m_per_sqrt_m=0.001", "fixes=[]"};
  settings.insert(settings.end(), more.begin(), more.end());
  return shipped("uncertainty", settings);
}

double inside_at(const ExperimentResult& r, double part) {
  int inside = 0;
  for (const PoseTrack& track : r.tracks) {
    const TrackSample& s = track.samples[std::size_t(part * double(track.samples.size() - 1))];
    inside += inside_95(s.estimate, s.X_SB);
  }
  return double(inside) / double(r.tracks.size());
}

double heading_variance_ratio(const ExperimentResult& r) {
  double ratio = 0;
  for (const PoseTrack& track : r.tracks) {
    const TrackSample& s = track.samples.back();
    ratio += std::pow(s.X_SB.theta_rad - s.estimate.X_OB.theta_rad, 2) / s.estimate.covariance(2, 2) / kRuns;
  }
  return ratio;
}

TEST(Ensemble, TruePositionsLieInTheir95PercentEllipses) {
  const ExperimentResult r = run_experiment(ensemble(), 0);
  ASSERT_EQ(r.tracks.size(), std::size_t(kRuns));
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const double share = inside_at(r, part);
    std::cout << fmt::format("after {:.0f} % of the course {:.1f} % inside\n", 100 * part, 100 * share);
    EXPECT_NEAR(share, kShare, kBar) << part;
  }
  std::cout << fmt::format("heading variance, driven over predicted: {:.3f}\n", heading_variance_ratio(r));
  EXPECT_NEAR(heading_variance_ratio(r), 1, 0.3);  // three standard errors: sqrt(2 / 200) each
  EXPECT_EQ(r.cost.solver_fallbacks, 0);
}

// Two hundred runs go into a page of moderate size; every run keeps its start and end.
TEST(Page, ThinsThePathsWhereRunsAreMany) {
  constexpr std::size_t kMost = 30000;  // poses of the whole page; a page of ten runs shows up to 400 of each
  const ExperimentResult r = run_experiment(ensemble({"truth.rate_hz=50"}), 0);
  const Json page = report_json(r);
  ASSERT_EQ(page["runs"].size(), std::size_t(kRuns));
  std::size_t recorded = 0, shown = 0;
  for (std::size_t i = 0; i < page["runs"].size(); ++i) {
    const auto& truth = r.recording.runs[i].truth;
    recorded += truth.size();
    shown += page["runs"][i]["truth"].size();
    EXPECT_NEAR(page["runs"][i]["truth"].back()[0].get<double>(), truth.back().X_WB.x_m, 1e-6);
    EXPECT_EQ(page["runs"][i]["odometry"].size(), page["runs"][i]["truth"].size());
  }
  EXPECT_GT(recorded, 4 * kMost);
  EXPECT_LT(shown, kMost);
  EXPECT_GT(shown, kMost / 2);
}

// The prediction holds for coarser and finer control periods and time steps, and after a fix.
TEST(Ensemble, HoldsForOtherRatesStepsAndFixes) {
  const std::vector<std::vector<std::string>> variants{
      {"encoders.rate_hz=100"},
      {"encoders.rate_hz=20"},
      {"physics.step_s=0.01"},
      {"fixes=[{leg: 2, position_sd_m: 0.003, heading_sd_rad: 0.002}]"}};
  for (const auto& more : variants) {
    const ExperimentResult r = run_experiment(ensemble(more), 0);
    std::cout << fmt::format("{}: {:.1f} % inside, heading variance {:.3f}\n", more[0], 100 * inside_at(r, 1),
                             heading_variance_ratio(r));
    EXPECT_NEAR(inside_at(r, 1), kShare, kBar) << more[0];
    EXPECT_NEAR(heading_variance_ratio(r), 1, 0.3) << more[0];
  }
}

// Believing too little noise puts the truth outside: half the standard deviation, 1 - exp(-6/8) = 53 % inside.
TEST(Ensemble, AnOverconfidentOdometryIsFoundOut) {
  const ExperimentResult r =
      run_experiment(ensemble({"uncertainty={left_m_per_sqrt_m: 0.0005, right_m_per_sqrt_m: 0.0005}"}), 0);
  EXPECT_NEAR(inside_at(r, 1), 1 - std::exp(-kChiSquare95 / 8), 0.11);  // three standard errors
}

// The covariance just after the fix is that just before it with the measurement's information added; the robot stands.
TEST(Fix, ShrinksTheCovarianceAsKalmanSays) {
  constexpr double kInverse = 1e-5;  // relative: one period of ticks that flicker at standstill, and the inverse
  const double position = 0.003, heading = 0.002;
  const ExperimentResult r = run_experiment(
      ensemble({"runs.per_direction=1", "course.dwell_s=1", "truth.rate_hz=50",
                fmt::format("fixes=[{{leg: 2, position_sd_m: {}, heading_sd_rad: {}}}]", position, heading)}), 0);
  const PoseTrack& track = r.tracks[0];
  ASSERT_EQ(track.fixes.size(), 1u);
  const PoseCovariance& before = track.samples[track.fixes[0] - 1].estimate.covariance;
  const PoseCovariance& after = track.samples[track.fixes[0]].estimate.covariance;
  const Eigen::Matrix3d R =
      Eigen::Vector3d(position * position, position * position, heading * heading).asDiagonal();
  const Eigen::Matrix3d expected = before.inverse() + R.inverse();
  EXPECT_LT((after.inverse() - expected).norm() / expected.norm(), kInverse);
  std::cout << fmt::format("semi-axis {:.2f} -> {:.2f} mm at the fix\n", 1000 * ellipse_95(before).a_m,
                           1000 * ellipse_95(after).a_m);
  EXPECT_LT(ellipse_95(after).a_m, ellipse_95(before).a_m);
}

// What a robot believes of its errors changes nothing that it does, until a fix tells it where it is.
TEST(Uncertainty, ChangesNoRecordedByteWithoutAFix) {
  const std::vector<std::string> small{"course.side_m=0.5", "runs.per_direction=1", "fixes=[]"};
  std::vector<std::string> off = small, fixed = small;
  off.push_back("uncertainty={}");
  fixed.push_back("fixes=[{leg: 1}]");
  const Recording a = run_experiment(shipped("uncertainty", small), 0).recording;
  const ExperimentResult without = run_experiment(shipped("uncertainty", off), 0);
  const Recording c = run_experiment(shipped("uncertainty", fixed), 0).recording;
  ASSERT_EQ(a.runs[0].encoders.size(), without.recording.runs[0].encoders.size());
  bool fix_is_seen = false;
  for (std::size_t i = 0; i < a.runs[0].encoders.size(); ++i) {
    const EncoderSample &x = a.runs[0].encoders[i], &y = without.recording.runs[0].encoders[i];
    EXPECT_EQ(x.left_ticks, y.left_ticks);
    EXPECT_EQ(x.right_command_radps, y.right_command_radps);
    fix_is_seen = fix_is_seen || x.left_ticks != c.runs[0].encoders[i].left_ticks;
  }
  EXPECT_TRUE(without.tracks[0].samples.empty());
  EXPECT_TRUE(fix_is_seen) << "the driver goes on from the corrected estimate";
}

TEST(Uncertainty, BadInputIsRefused) {
  const auto expect_refused = [](const std::vector<std::string>& settings, const std::vector<std::string>& parts) {
    try {
      shipped("nominal", settings);
      ADD_FAILURE() << "accepted: " << settings[0];
    } catch (const InputError& e) {
      for (const std::string& part : parts) {
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << " is not in: " << e.what();
      }
    }
  };
  const std::string on = "uncertainty.left_m_per_sqrt_m=0.001";
  expect_refused({"fixes=[{leg: 1}]"}, {"fixes", "uncertainty.left_m_per_sqrt_m"});
  expect_refused({"fixes=[{leg: 5}]", on}, {"fixes[0].leg", "5", "4"});
  expect_refused({"fixes=[{position_sd_m: 1}]", on}, {"fixes[0]", "leg"});
  expect_refused({"fixes=[{leg: 1, position_sd_m: 0}]", on}, {"fixes[0].position_sd_m", "> 0"});
  expect_refused({"uncertainty.left=0.1"}, {"uncertainty.left", "one of: left_m_per_sqrt_m"});
  expect_refused({"noise.wheel_noise_m_per_sqrt_m=0.1"}, {"noise.wheel_noise_m_per_sqrt_m", "0.005"});
}

TEST(Uncertainty, ResolvedTextMeansTheSame) {
  const TemporaryFolder folder;
  const std::string resolved = resolved_yaml(shipped("uncertainty", {"uncertainty.right_m_per_sqrt_m=0.00071"}));
  EXPECT_EQ(resolved_yaml(read_scenario(folder.write("again.yaml", resolved))), resolved);
  EXPECT_NE(resolved.find("- {leg: 2, position_sd_m: 0.005, heading_sd_rad: 0.002}"), std::string::npos) << resolved;
}

}  // namespace
}  // namespace umbsim

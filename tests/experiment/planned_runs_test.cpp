#include "experiment/drive/planned_runs.h"

#include <set>

#include "tests/experiment/scenarios.h"

namespace umbsim::testing {
namespace {

constexpr double kRoundOff = 1e-12;

Recording planned() {
  Recording r;
  r.robot = {"labmate.urdf", 0.075, 0.34, 2000};
  r.path.side_m = 1;
  r.path.linear_speed_mps = 0.4;
  r.path.angular_speed_radps = 1.4;
  r.encoder_rate_hz = 50;
  r.runs.resize(5);
  const char* ids[] = {"plain", "rotated", "fast", "loaded", "rolling"};
  for (std::size_t i = 0; i < 5; ++i) {
    r.runs[i].id = ids[i];
    r.runs[i].direction = i % 2 ? "ccw" : "cw";
  }
  r.runs[1].start_heading_rad = 1.5;
  r.runs[2].linear_speed_mps = 0.8;
  r.runs[3].payload_kg = 15;
  r.runs[4].turn = "arc";
  r.runs[4].turn_radius_m = 0.3;
  return r;
}

Recording drive(const std::vector<std::string>& settings = {}, const Recording& plan = planned()) {
  const Scenario s = shipped("nominal", settings);
  return drive_planned_runs(s, load_scenario_robot(s), plan);
}

double duration_s(const RecordedRun& run) { return run.encoders.back().time_s; }

TEST(PlannedRuns, EachRunHasItsOwnCourse) {
  const Recording r = drive();
  EXPECT_NEAR(r.runs[1].truth.front().X_WB.theta_rad, 1.5, kRoundOff);
  EXPECT_LT(duration_s(r.runs[2]), duration_s(r.runs[0]));
  double widest = 0, narrowest = 0;  // a rolling turn moves both wheels forward at every moment
  for (const RecordedRun& run : {r.runs[4], r.runs[0]}) {
    double back = 0;
    for (const EncoderSample& e : run.encoders) back = std::min({back, e.left_command_radps, e.right_command_radps});
    (run.id == "rolling" ? widest : narrowest) = back;
  }
  EXPECT_LT(narrowest, -1);
  EXPECT_GT(widest, -0.5);
  // All come home, each in its own frame.
  for (const RecordedRun& run : r.runs) {
    EXPECT_NEAR(run.truth.back().X_WB.x_m, 0, 0.01) << run.id;
    EXPECT_NEAR(run.truth.back().X_WB.y_m, 0, 0.01) << run.id;
  }
}

TEST(PlannedRuns, APayloadCompressesSoftTyresAndNothingElse) {
  const std::vector<std::string> soft{"effects.tyre_compliance.metres_per_newton=5e-6"};
  const auto length = [](const Recording& r, std::size_t run) {
    double farthest = 0;  // of the first leg
    for (const TruthSample& t : r.runs[run].truth) {
      if (std::abs(t.X_WB.theta_rad) > 0.05) break;  // the first turn
      farthest = std::max(farthest, t.X_WB.x_m);
    }
    return farthest;
  };
  Recording plan = planned();
  plan.runs[1] = plan.runs[3];
  plan.runs[1].payload_kg.reset();
  const Recording hard_tyres = drive({}, plan), soft_tyres = drive(soft, plan);
  EXPECT_NEAR(length(hard_tyres, 3), length(hard_tyres, 1), 1e-4);
  EXPECT_LT(length(soft_tyres, 3), length(soft_tyres, 1) - 1e-4);
}

// Run numbers go on through all runs: wear grows, and noise differs.
TEST(PlannedRuns, RunNumbersCountThroughAllRuns) {
  Recording plan = planned();
  for (RecordedRun& run : plan.runs) run = {run.id, "cw", {}, {}, {}, {}, {}, {}, {}, false, {}, {}};
  const Recording worn = drive({"effects.wear.right_relative_per_run=0.002"}, plan);
  for (std::size_t i = 1; i < worn.runs.size(); ++i) {
    EXPECT_GT(worn.runs[i].truth.back().X_WB.theta_rad, worn.runs[i - 1].truth.back().X_WB.theta_rad + 1e-3);
  }
  const Recording noisy = drive({"noise.wheel_noise_m_per_sqrt_m=0.0002"}, plan);
  std::set<double> ends;
  for (const RecordedRun& run : noisy.runs) ends.insert(run.truth.back().X_WB.theta_rad);
  EXPECT_EQ(ends.size(), plan.runs.size());
}

TEST(PlannedRuns, CoarseEncodersCountInStepsOfTheUnitThatIsBelieved) {
  const Recording coarse = drive({"effects.encoder_resolution.ticks_per_revolution=100"});
  const Recording fine = drive();
  EXPECT_EQ(coarse.robot.ticks_per_revolution, 2000);
  for (const EncoderSample& e : coarse.runs[0].encoders) EXPECT_EQ(e.left_ticks % 20, 0);
  // The same distance, to a coarse tick and what the driver makes of it.
  EXPECT_NEAR(double(coarse.runs[0].encoders.back().left_ticks), double(fine.runs[0].encoders.back().left_ticks), 60);
}

TEST(PlannedRuns, AFasterRobotIsRecordedAsLong) {
  const Recording plain = drive(),
                  fast = drive({"effects.over_acceleration.factor=10", "effects.fast_turning.factor=2"});
  for (std::size_t i = 0; i < plain.runs.size(); ++i) {
    ASSERT_EQ(plain.runs[i].encoders.size(), fast.runs[i].encoders.size());
    ASSERT_EQ(plain.runs[i].truth.size(), fast.runs[i].truth.size());
    for (std::size_t k = 0; k < plain.runs[i].truth.size(); ++k) {
      EXPECT_NEAR(plain.runs[i].truth[k].time_s, fast.runs[i].truth[k].time_s, kRoundOff);
    }
  }
  Scenario s = shipped("nominal", {"truth.kind=endpoints", "effects.over_acceleration.factor=10"});
  EXPECT_EQ(drive_planned_runs(s, load_scenario_robot(s), planned()).runs[0].truth.size(), 2u);
}

TEST(PlannedRuns, TheSameWithAnyNumberOfRunsBesides) {
  Recording one = planned();
  one.runs.resize(1);
  const std::vector<std::string> noise{"noise.wheel_noise_m_per_sqrt_m=0.0002", "truth.position_sd_m=0.001"};
  const Recording alone = drive(noise, one), among = drive(noise);
  EXPECT_EQ(alone.runs[0].truth.back().X_WB.x_m, among.runs[0].truth.back().X_WB.x_m);
}

}  // namespace
}  // namespace umbsim::testing

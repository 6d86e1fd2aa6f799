// All methods beside each other: who wins and why, and what parts of a course say.
#include "calibration/compare/compare.h"

#include <gtest/gtest.h>

#include "calibration/compare/residuals.h"
#include "core/error.h"
#include "tests/calibration/tracked_drive.h"

namespace umbsim::calibration {
namespace {

using testing::Moves;
using testing::nominal_odometry;
using testing::TestTracker;
using testing::tracked_squares;
using testing::TrueRobot;

TestTracker noisy() {
  TestTracker t;
  t.position_sd_m = 0.0005;
  t.heading_sd_rad = 0.001;
  t.wheel_noise = 0.0003;
  return t;
}

std::vector<const Method*> all() {
  std::vector<const Method*> chosen;
  for (const Method& m : methods()) chosen.push_back(&m);
  return chosen;
}

Task task_of(std::vector<Recording> train, std::vector<Recording> test = {}) {
  Task task;
  task.nominal = nominal_odometry();
  for (std::size_t i = 0; i < train.size(); ++i) task.train_names.push_back("train" + std::to_string(i));
  for (std::size_t i = 0; i < test.size(); ++i) task.test_names.push_back("test" + std::to_string(i));
  task.train = std::move(train);
  task.test = std::move(test);
  return task;
}

const MethodResult& result(const Comparison& c, const std::string& name) {
  for (const MethodResult& r : c.results) {
    if (r.name == name) return r;
  }
  throw std::logic_error(name);
}

bool warns(const std::vector<std::string>& warnings, const std::vector<std::string>& words) {
  for (const std::string& w : warnings) {
    bool all_there = true;
    for (const std::string& word : words) all_there = all_there && w.find(word) != std::string::npos;
    if (all_there) return true;
  }
  return false;
}

TEST(Compare, TheWinnerPredictsRunsThatItHasNotSeen) {
  const TrueRobot truth = TrueRobot::with(1.004, 1.01);
  const Comparison c = compare(task_of({tracked_squares(truth, nominal_odometry(), 3, noisy())},
                                       {tracked_squares(truth, nominal_odometry(), 1, noisy(), 3)}),
                               all());
  const MethodResult& winner = c.results[c.winner];
  EXPECT_EQ(c.folds, 6);
  EXPECT_NE(winner.name, "nominal");
  // The best, or one that a standard error does not tell from it.
  for (const MethodResult& r : c.results) EXPECT_LE(winner.held_out_mm, 1.5 * r.held_out_mm + 0.2) << r.name;
  EXPECT_LT(winner.test[0].final_mm, result(c, "nominal").test[0].final_mm / 4);
  EXPECT_TRUE(c.parts.warnings.empty()) << c.parts.warnings[0];
}

// What is tested on must not choose.
TEST(Compare, TestsHaveNoSay) {
  const TrueRobot truth = TrueRobot::with(1.002, 1.01);
  const Recording squares = tracked_squares(truth, nominal_odometry(), 2, noisy());
  const Comparison alone = compare(task_of({squares}), all());
  const Comparison tested =
      compare(task_of({squares}, {tracked_squares(TrueRobot::with(0.98, 0.9), nominal_odometry(), 1)}), all());
  EXPECT_EQ(alone.winner, tested.winner);
  for (std::size_t i = 0; i < alone.results.size(); ++i)
    EXPECT_EQ(alone.results[i].held_out_mm, tested.results[i].held_out_mm);
}

// A robot that is as nominal: no method may make it worse by more than the nominal odometry errs.
TEST(Compare, TheWinnerIsNeverWorseThanNominal) {
  for (int pairs = 1; pairs <= 3; ++pairs) {
    const Comparison c = compare(task_of({tracked_squares({}, nominal_odometry(), pairs, noisy())}), all());
    EXPECT_LE(c.results[c.winner].held_out_mm, c.results[0].held_out_mm);
  }
}

TEST(Compare, ConditionsAreLeftOutWhereThereAreSeveral) {
  const TrueRobot truth = TrueRobot::with(1.002, 1.01);
  const Comparison c = compare(task_of({tracked_squares(truth, nominal_odometry(), 2, noisy()),
                                        testing::tracked_circles(truth, nominal_odometry(), 0.8, noisy())}),
                               all());
  EXPECT_EQ(c.folds, 2);
  // Without the squares nothing is left for UMBmark, without the circles nothing for the circle test.
  EXPECT_EQ(result(c, "endpoint").held_out_answers, 1);
  EXPECT_EQ(result(c, "circles").held_out_answers, 1);
  EXPECT_EQ(result(c, "likelihood").held_out_answers, 2);
}

// One circle each way: without one of them nothing tells ratio from wheelbase, so halves of both are left out.
TEST(Compare, RunsThatWereNotRepeatedAreHalved) {
  const TrueRobot truth = TrueRobot::with(1.005, 1.02);
  const Comparison c = compare(task_of({testing::tracked_circles(truth, nominal_odometry(), 0.8, noisy())}), all());
  EXPECT_EQ(c.folds, 2);
  EXPECT_NE(c.held_out.find("half"), std::string::npos);
  EXPECT_LT(c.results[c.winner].held_out_mm, c.results[0].held_out_mm / 2);
}

// What the runs can hardly tell is said before anything is fitted.
TEST(Compare, PoorDataAreNamed) {
  const auto warnings = [](const Moves& moves, const Moves& back) {
    std::vector<RecordedRun> runs;
    for (int i = 0; i < 4; ++i) {
      runs.push_back(testing::tracked_run("free-" + std::to_string(i + 1), "free", {}, nominal_odometry(),
                                          i % 2 ? back : moves, noisy(), unsigned(i + 1)));
    }
    return compare(task_of({testing::recording_of("free", 0, nominal_odometry(), runs)}), all()).warnings;
  };
  const double half_turn_m = M_PI * nominal_odometry().wheelbase_m / 2;
  const Moves left{{-half_turn_m, half_turn_m}, {-half_turn_m, half_turn_m}};
  const Moves right{{half_turn_m, -half_turn_m}, {half_turn_m, -half_turn_m}};
  const Moves ahead{{1, 1}}, left_and_ahead{{1, 1}, {-half_turn_m, half_turn_m}, {1, 1}};
  EXPECT_TRUE(warns(warnings(left, right), {"too little way"}));
  EXPECT_TRUE(warns(warnings(ahead, ahead), {"too little turning"}));
  EXPECT_TRUE(warns(warnings(left_and_ahead, left_and_ahead), {"turn left only"}));
}

// What the page draws: every run, its residuals smaller after than before, and the squares' return errors.
TEST(Residuals, ShrinkByCalibration) {
  const TrueRobot truth = TrueRobot::with(1.004, 1.01);
  const Task task = task_of({tracked_squares(truth, nominal_odometry(), 2, noisy())},
                            {tracked_squares(truth, nominal_odometry(), 1, noisy(), 3)});
  const Comparison c = compare(task, all());
  const std::vector<RunResiduals> runs = run_residuals(task, c, 50);
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_FALSE(runs[3].test);
  EXPECT_TRUE(runs[4].test);
  for (const RunResiduals& r : runs) {
    ASSERT_EQ(r.time_s.size(), 50u);
    ASSERT_EQ(r.final_mm.size(), c.results.size());
    EXPECT_NEAR(1000 * std::hypot(r.before.back().x_m, r.before.back().y_m), r.final_mm[0], 1e-6);
    EXPECT_LT(r.final_mm[c.winner], r.final_mm[0]);
    EXPECT_NEAR(1000 * std::hypot(r.after.back().x_m, r.after.back().y_m), r.final_mm[c.winner], 1e-6);
  }
  const std::vector<SquaresBeforeAfter> squares = squares_before_after(task, c);
  ASSERT_EQ(squares.size(), 1u);
  EXPECT_EQ(squares[0].before.cw.errors.size(), 2u);
  EXPECT_LT(squares[0].after.e_max_syst_m, squares[0].before.e_max_syst_m / 4);
}

TEST(Compare, AnotherRobotIsRefused) {
  Recording other = tracked_squares({}, nominal_odometry(), 1);
  other.robot.ticks_per_revolution = 1234;
  EXPECT_THROW(compare(task_of({tracked_squares({}, nominal_odometry(), 1), other}), all()), InputError);
}

TEST(Compare, OneMethodThatHasNoAnswerIsAnError) {
  Recording cw = tracked_squares({}, nominal_odometry(), 1);
  cw.runs.pop_back();
  EXPECT_THROW(compare(task_of({cw}), {all()[0]}), InputError);
}

// The trap of the real robot: a start heading that the robot has left before its first straight.
TEST(Parts, AStartHeadingThatIsNotThatOfTheFirstStraightIsNamed) {
  const TrueRobot truth = TrueRobot::with(1, 1.008);
  Recording squares = tracked_squares(truth, nominal_odometry(), 3, noisy());
  squares.runs[2].truth.front().X_WB.theta_rad += radians(4.5);  // cw-2
  const Comparison c = compare(task_of({squares}), all());
  EXPECT_TRUE(warns(c.parts.warnings, {"run cw-2", "-4.", "start heading"}));
  // 4.5 deg in one of three cw runs: 1.5 / 8 deg in alpha, over 90 deg.
  const double heading_e_b = figures(*result(c, "heading").fit, c.nominal).e_b.value;
  EXPECT_NEAR(heading_e_b, 1.008 * (1 - 1.5 / 8 / 90), 5e-4);
  for (const PartFit& p : c.parts.fits) {
    if (p.part != "turns, straight to straight") continue;
    EXPECT_NEAR(p.e_b->value, 1.008, 5e-4);
  }
}

TEST(Parts, CurvesThatDisagreeWithTurnsAreNamed) {
  std::vector<RecordedRun> circles;
  for (int i = 1; i <= 3; ++i) {
    for (const bool cw : {true, false}) {
      const auto round = testing::arc_move(0.8, (cw ? -4 : 4) * M_PI, nominal_odometry().wheelbase_m);
      circles.push_back(testing::tracked_run((cw ? "cw-" : "ccw-") + std::to_string(i), cw ? "cw" : "ccw",
                                             TrueRobot::with(1, 1.014), nominal_odometry(), {round}, noisy(),
                                             unsigned(10 * i + cw)));
    }
  }
  const Recording curves = testing::recording_of("circle", 0, nominal_odometry(), circles);
  const auto warnings = [&](double e_b) {
    return compare(task_of({tracked_squares(TrueRobot::with(1, e_b), nominal_odometry(), 3, noisy()), curves}), all())
        .parts.warnings;
  };
  EXPECT_TRUE(
      warns(warnings(1.004), {"parts disagree", "E_b of turns, straight to straight (train0)", "curves (train1)"}));
  EXPECT_FALSE(warns(warnings(1.014), {"parts disagree", "E_b"}));
}

}  // namespace
}  // namespace umbsim::calibration

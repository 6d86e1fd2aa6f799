// Every method on robots with exact kinematics: what it must find, what it must not claim.
#include "calibration/methods/methods.h"

#include <gtest/gtest.h>

#include "calibration/methods/paths/travel.h"
#include "calibration/methods/squares/own_bias.h"
#include "core/pose2.h"
#include "tests/calibration/tracked_drive.h"

namespace umbsim::calibration {
namespace {

using testing::arc_move;
using testing::end_points;
using testing::nominal_odometry;
using testing::TestTracker;
using testing::tracked_circles;
using testing::tracked_run;
using testing::tracked_squares;
using testing::TrueRobot;

constexpr double kConverged = 1e-5;  // of ratios: iterations stop at 1e-9 or so of errors that are whitened

const Method& method(const std::string& name) {
  for (const Method& m : methods()) {
    if (name == m.name) return m;
  }
  throw std::logic_error(name);
}

TrueRobot robot(double e_d, double e_b, double scale) {
  TrueRobot r = TrueRobot::with(e_d, e_b);
  r.left_radius_m *= scale;
  r.right_radius_m *= scale;
  r.wheelbase_m *= scale;
  return r;
}

Fit fit(const std::string& name, const std::vector<Recording>& recordings) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < recordings.size(); ++i) names.push_back(std::to_string(i));
  return method(name).fit(training_runs(recordings, names), nominal_odometry());
}

void expect_robot(const Fit& f, const TrueRobot& truth, double tolerance) {
  const OdometryParameters o = scaled(nominal_odometry(), f.factors);
  const double scale = f.scale_observed ? 1 : (truth.left_radius_m + truth.right_radius_m) / 2 / 0.075;
  EXPECT_NEAR(o.left_radius_m * scale / truth.left_radius_m, 1, tolerance);
  EXPECT_NEAR(o.right_radius_m * scale / truth.right_radius_m, 1, tolerance);
  EXPECT_NEAR(o.wheelbase_m * scale / truth.wheelbase_m, 1, tolerance);
}

TEST(Methods, SquaresWithTracks) {
  const TrueRobot truth = robot(1.004, 1.015, 1.003);
  const std::vector<Recording> squares{tracked_squares(truth, nominal_odometry(), 1)};
  for (const char* name : {"iterated", "heading", "least-squares", "kelly", "likelihood"}) {
    SCOPED_TRACE(name);
    const Fit f = fit(name, squares);
    EXPECT_EQ(f.scale_observed, std::string(name) != "iterated" && std::string(name) != "heading");
    // A square that the errors leave open shows a little of the scale, which UMBmark takes as right.
    expect_robot(f, truth, std::string(name) == "iterated" ? 1e-4 : kConverged);
  }
}

// No closed square's end pose can see the mean radius: nobody may claim it.
TEST(Methods, NobodySeesTheMeanRadiusInEndPointsOfSquares) {
  const TrueRobot truth = robot(1.001, 1.005, 1.02);
  const std::vector<Recording> squares{end_points(tracked_squares(truth, nominal_odometry(), 2))};
  for (const char* name : {"endpoint", "iterated", "heading", "least-squares", "kelly", "likelihood"}) {
    SCOPED_TRACE(name);
    const Fit f = fit_with(method(name), training_runs(squares, {"s"}), nominal_odometry());
    EXPECT_FALSE(f.scale_observed);
    EXPECT_FALSE(figures(f, nominal_odometry()).mean_radius_m.has_interval());
    // Geometric or arithmetic mean: they differ by an eighth of the square of the ratio's logarithm.
    EXPECT_NEAR(f.factors[0] + f.factors[1], 0, 1e-6);
  }
}

TEST(Methods, CirclesOfBothDirections) {
  const TrueRobot truth = robot(0.997, 1.02, 0.995);
  const std::vector<Recording> circles{tracked_circles(truth, nominal_odometry())};
  for (const char* name : {"circles", "likelihood", "kelly"}) {
    SCOPED_TRACE(name);
    const Fit f = fit(name, circles);
    EXPECT_TRUE(f.scale_observed);
    // On a steady circle nothing but its prior (0.2 %) tells a clock's rate from the mean radius.
    expect_robot(f, truth, std::string(name) == "likelihood" ? 2e-3 : kConverged);
  }
  const Fit ends = fit("circles", {end_points(circles[0])});
  EXPECT_FALSE(ends.scale_observed);
  expect_robot(ends, truth, 2e-5);  // its mean is the arithmetic one
}

// The circle test needs neither headings nor clock.
TEST(Methods, CirclesDoNotMindATurnedAndLateTracker) {
  const TrueRobot truth = robot(0.997, 1.02, 0.995);
  TestTracker tracker;
  tracker.heading_rad = 0.05;
  tracker.clock_offset_s = 0.1;
  expect_robot(fit("circles", {tracked_circles(truth, nominal_odometry(), 0.8, tracker)}), truth, kConverged);
}

// What the tracker does is found beside the robot.
TEST(Methods, LikelihoodFindsTheTracker) {
  const TrueRobot truth = robot(1.002, 0.99, 1.001);
  TestTracker tracker;
  tracker.heading_rad = radians(-0.4);
  tracker.marker_x_m = 0.03;
  tracker.marker_y_m = -0.01;
  tracker.clock_offset_s = 0.08;
  tracker.clock_rate = 0.002;
  const Fit f = fit("likelihood", {tracked_squares(truth, nominal_odometry(), 1, tracker)});
  expect_robot(f, truth, 1e-4);
  ASSERT_EQ(f.trackers.size(), 1u);
  EXPECT_NEAR(f.trackers[0].heading_offset_rad, tracker.heading_rad, 1e-4);
  EXPECT_NEAR(f.trackers[0].marker_x_m, tracker.marker_x_m, 1e-4);
  EXPECT_NEAR(f.trackers[0].marker_y_m, tracker.marker_y_m, 1e-4);
  EXPECT_NEAR(f.trackers[0].clock_offset_s, tracker.clock_offset_s, 1e-3);
  EXPECT_NEAR(f.trackers[0].clock_rate, tracker.clock_rate, 1e-4);
}

// The same tracker misleads methods that take it for exact: they say so in `takes_for_exact`.
TEST(Methods, ATurnedTrackerMisleadsTheEndpointForm) {
  const TrueRobot truth = robot(1, 1, 1);
  TestTracker tracker;
  tracker.heading_rad = radians(-0.4);
  tracker.marker_x_m = 0.03;
  const std::vector<Recording> squares{tracked_squares(truth, nominal_odometry(), 1, tracker)};
  EXPECT_LT(std::abs(fit("likelihood", squares).factors[2]), 1e-4);
  EXPECT_GT(std::abs(fit("least-squares", squares).factors[2]) + std::abs(fit("kelly", squares).factors[2]), 1e-3);
}

TEST(Methods, OneDirectionIsRefusedBySquaresAndCircles) {
  Recording squares = tracked_squares(robot(1, 1, 1), nominal_odometry(), 1);
  squares.runs.pop_back();
  for (const char* name : {"endpoint", "iterated", "heading", "circles"})
    EXPECT_THROW(fit(name, {squares}), NotApplicable) << name;
  Recording circles = tracked_circles(robot(1, 1, 1), nominal_odometry());
  circles.runs.pop_back();
  EXPECT_THROW(fit("circles", {circles}), NotApplicable);
}

TEST(Methods, StraightLinesDoNotTellTheWheelbase) {
  const OdometryParameters o = nominal_odometry();
  const Recording lines =
      testing::recording_of("free", 0, o, {tracked_run("a", "free", robot(1.002, 1, 1), o, {{3, 3}})});
  for (const char* name : {"least-squares", "kelly", "likelihood"})
    EXPECT_THROW(fit(name, {lines}), NotApplicable) << name;
}

// Several recordings of one robot are one set of data: squares tell wheelbase and ratio, a straight line the scale.
TEST(Methods, RecordingsAreFittedTogether) {
  const OdometryParameters o = nominal_odometry();
  const TrueRobot truth = robot(1.003, 1.01, 1.01);
  const Recording squares = end_points(tracked_squares(truth, o, 2));
  const Recording line =
      end_points(testing::recording_of("free", 0, o, {tracked_run("a", "free", truth, o, {{3, 3}})}));
  for (const char* name : {"kelly", "likelihood"}) {
    SCOPED_TRACE(name);
    const Fit f = fit(name, {squares, line});
    EXPECT_TRUE(f.scale_observed);
    expect_robot(f, truth, kConverged);
  }
}

// Recordings that disagree keep the mean radius, so that the passes come to rest.
TEST(Methods, IteratedComesToRestOnRecordingsThatDiffer) {
  const std::vector<Recording> both{tracked_squares(robot(1.004, 1.01, 1), nominal_odometry(), 1),
                                    tracked_squares(robot(0.998, 1.02, 1), nominal_odometry(), 1)};
  const Fit f = fit("iterated", both);
  EXPECT_NEAR(f.factors[0] + f.factors[1], 0, 1e-9);
  EXPECT_NEAR(figures(f, nominal_odometry()).e_d.value, 1.001, 1e-4);
}

// Kelly's second part: the wheels' random errors come back.
TEST(Methods, KellyFindsTheWheelsNoise) {
  TestTracker tracker;
  tracker.wheel_noise = 0.001;
  tracker.position_sd_m = 0.0003;
  tracker.heading_sd_rad = 0.0003;
  Recording squares = tracked_squares(robot(1, 1, 1), nominal_odometry(), 10, tracker);
  squares.truth_position_sd_m = squares.truth_heading_sd_rad = 0.0003;
  const Fit f = fit("kelly", {squares});
  ASSERT_TRUE(f.noise);
  for (const Estimate& k : {f.noise->left_m_per_sqrt_m, f.noise->right_m_per_sqrt_m}) {
    EXPECT_LT(k.low, 0.001);
    EXPECT_GT(k.high, 0.001);
    EXPECT_LT(k.high - k.low, 0.0007);
  }
}

// Weights follow the noise and the noise the weights: the fit must not swing about its answer, also where what is left
// is no noise (a marker that is not above the axle's middle turns with the robot), nor keep its start in mind.
TEST(Methods, KellyComesToRest) {
  for (const double ahead_m : {0.01, 0.03, 0.1}) {
    TestTracker tracker;
    tracker.wheel_noise = 0.001;
    tracker.marker_x_m = ahead_m;
    tracker.position_sd_m = tracker.heading_sd_rad = 0.001;
    const std::vector<Recording> squares{tracked_squares(robot(1.002, 1.01, 1), nominal_odometry(), 5, tracker)};
    const Runs runs = training_runs(squares, {"s"});
    OdometryParameters elsewhere = nominal_odometry();
    for (double* length_m : {&elsewhere.wheelbase_m, &elsewhere.left_radius_m, &elsewhere.right_radius_m})
      *length_m *= 1.02;  // all alike: the runs are cut at the same places
    const Fit here = method("kelly").fit(runs, nominal_odometry()), there = method("kelly").fit(runs, elsewhere);
    EXPECT_TRUE(here.warnings.empty() && there.warnings.empty()) << ahead_m;
    const OdometryParameters a = scaled(nominal_odometry(), here.factors), b = scaled(elsewhere, there.factors);
    EXPECT_NEAR(a.wheelbase_m / b.wheelbase_m, 1, 1e-7) << ahead_m;
    EXPECT_NEAR(a.left_radius_m / b.left_radius_m, 1, 1e-7) << ahead_m;
    EXPECT_NEAR(here.noise->left_m_per_sqrt_m.value / there.noise->left_m_per_sqrt_m.value, 1, 1e-4) << ahead_m;
  }
}

// The interval of a mean over runs is the textbook's: t s / sqrt(n) of each direction, added in squares.
TEST(Intervals, JackknifeIsTheTextbooksOnMeans) {
  TestTracker tracker;
  tracker.wheel_noise = 0.0005;
  const Recording squares = tracked_squares(robot(1, 1, 1), nominal_odometry(), 5, tracker);
  const Fit f = fit_with(method("heading"), training_runs({squares}, {"s"}), nominal_odometry());
  double variance = 0;
  for (const char* direction : {"cw", "ccw"}) {
    const Cluster c = cluster(return_errors(squares, nominal_odometry(), direction, false));
    variance += c.sd_heading_rad * c.sd_heading_rad / 5;
  }
  ASSERT_EQ(f.covariance.size(), 2u);
  // log E_b = -log(1 - 2 alpha / pi), alpha the difference of the means over 8.
  const Spread s = spread(f.covariance, kEb);
  EXPECT_NEAR(std::sqrt(s.variance), 2 / M_PI * std::sqrt(variance) / 8, 1e-7);
  EXPECT_GT(s.degrees_of_freedom, 3.9);
  EXPECT_LE(s.degrees_of_freedom, 8.001);
}

// Least squares over all runs together moves by a tenth, not by a fifth, when one of ten runs is left out. The interval
// must not shrink for it: over many robots its variance is the answers' own.
TEST(Intervals, JackknifeIsRightForLeastSquaresOverAllRuns) {
  TestTracker tracker;
  tracker.wheel_noise = 0.0005;
  constexpr int kRobots = 150;
  double estimated = 0, true_variance = 0;
  for (int i = 0; i < kRobots; ++i) {
    std::vector<RecordedRun> runs;
    for (int k = 0; k < 6; ++k) {
      runs.push_back(testing::tracked_run(std::to_string(k), k % 2 ? "cw" : "ccw", robot(1, 1, 1), nominal_odometry(),
                                          testing::square_moves(k % 2, 1, 0.34), tracker, unsigned(6 * i + k + 1)));
    }
    const Recording squares = testing::recording_of("square", 1, nominal_odometry(), runs);
    const Fit f = fit_with(method("least-squares"), training_runs({squares}, {"s"}), nominal_odometry());
    estimated += spread(f.covariance, kEd).variance / kRobots;
    true_variance += std::pow(kEd.dot(f.factors), 2) / kRobots;
  }
  // A variance from 150 values errs by 12 %; leaving runs out without weighing the others says 0.64.
  EXPECT_NEAR(estimated / true_variance, 1, 0.25);
}

// The endpoint form's own bias by exact kinematics, as published for 4 m squares of a 340 mm wheelbase.
TEST(OwnBias, IsThatOfThePublishedFigures) {
  struct Case {
    double e_d, e_b, said_e_d, said_e_b;
  };
  for (const Case& c : {Case{1.00084, 0.98874, 1.00089, 0.98846}, Case{1.005, 1.02, 1.00444, 1.01548},
                        Case{1.01, 1.05, 1.00698, 1.02754}}) {
    const TrueRobot truth = TrueRobot::with(c.e_d, c.e_b);
    const LogFactors factors(std::log(truth.left_radius_m / 0.075), std::log(truth.right_radius_m / 0.075),
                             std::log(c.e_b));
    const std::vector<SquareCourse> course{{4, 0, 1, 1}};
    const LogFactors answer = endpoint_answer(course, nominal_odometry(), factors);
    EXPECT_NEAR(std::exp(kEd.dot(answer)), c.said_e_d, 6e-6);
    EXPECT_NEAR(std::exp(answer[2]), c.said_e_b, 6e-6);
    const auto bias = own_bias(course, nominal_odometry(), answer);
    ASSERT_TRUE(bias);
    // But for the mean radius: the formulas keep the arithmetic mean, which is off the logarithms' by (ln E_d)^2 / 8,
    // at most 1.2e-5 of the radius. Sides and turns scale with it, and so does a bias that is at most 0.022.
    constexpr double kMeanRadius = 4 * 1.2e-5 * 0.022;
    EXPECT_NEAR(kEd.dot(*bias), kEd.dot(answer - factors), kMeanRadius);
    EXPECT_NEAR(kEb.dot(*bias), kEb.dot(answer - factors), kMeanRadius);
  }
}

// On half-metre squares 1.0098 is said of 1.0100. The interval must hold the truth, without any noise.
TEST(OwnBias, WidensTheInterval) {
  const TrueRobot truth = TrueRobot::with(1, 1.01);
  const Fit f =
      fit_with(method("endpoint"), training_runs({tracked_squares(truth, nominal_odometry(), 3, {}, 0.5)}, {"s"}),
               nominal_odometry());
  const FitFigures g = figures(f, nominal_odometry());
  EXPECT_LT(g.e_b.value, 1.01 - 1e-4);
  EXPECT_LE(g.e_b.low, g.e_b.value);
  EXPECT_GT(g.e_b.high, 1.01 - 1e-6);
}

// Turns in place beside circles tell scrub from the wheelbase; the ticks are those of a robot that scrubs.
TEST(Scrub, IsFoundFromTurnsAndArcs) {
  constexpr double kScrub = 0.002;
  // A robot of exact kinematics; its counters see more of the wheel that falls behind, and less of the other.
  const auto run = [&](const std::string& id, const testing::Moves& moves, unsigned seed) {
    TestTracker tracker;
    tracker.position_sd_m = 0.0003;
    tracker.heading_sd_rad = 0.0005;
    tracker.wheel_noise = 0.0001;
    RecordedRun driven = tracked_run(id, "free", {}, nominal_odometry(), moves, tracker, seed);
    double left = 0, right = 0;
    const std::vector<EncoderSample> floor = driven.encoders;
    for (std::size_t k = 1; k < floor.size(); ++k) {
      const double l = double(floor[k].left_ticks - floor[k - 1].left_ticks);
      const double r = double(floor[k].right_ticks - floor[k - 1].right_ticks);
      const double sense = std::abs(r - l) < 1e-3 * std::abs(l + r) ? 0 : r > l ? 1 : -1;
      left += l / (1 + (l < 0 ? -1 : 1) * sense * kScrub);
      right += r / (1 - (r < 0 ? -1 : 1) * sense * kScrub);
      driven.encoders[k].left_ticks = std::llround(left);
      driven.encoders[k].right_ticks = std::llround(right);
    }
    return driven;
  };
  std::vector<RecordedRun> runs;
  for (int i = 0; i < 4; ++i) {
    testing::Moves moves;
    for (const double sense : {1.0, -1.0}) {
      const double turn_m = sense * M_PI * 0.34 / 2;
      moves.insert(moves.end(), {{1, 1}, {-turn_m, turn_m}, {1, 1}, arc_move(0.8, sense * 2 * M_PI, 0.34)});
    }
    runs.push_back(run("free-" + std::to_string(i + 1), moves, unsigned(i + 1)));
  }
  const Fit f = fit("scrub", {testing::recording_of("free", 0, nominal_odometry(), runs)});
  ASSERT_TRUE(f.scrub);
  EXPECT_LT(f.scrub->low, kScrub);
  EXPECT_GT(f.scrub->high, kScrub);
  EXPECT_NEAR(f.scrub->value, kScrub, 0.0004);
  EXPECT_NEAR(kEb.dot(f.factors), 0, 0.001);
}

TEST(PathIntegral, AnswersToParametersAsFiniteDifferencesSay) {
  const OdometryParameters o = nominal_odometry();
  const RecordedRun run = tracked_run("a", "free", robot(1, 1, 1), o,
                                      {{1, 1}, arc_move(0.5, 2, 0.34), {-0.2, 0.2}, arc_move(0.7, -1, 0.34)});
  const std::vector<double> times{3.017, run.encoders.back().time_s};
  const auto travelled = [&](const LogFactors& f) {
    return between(travel(run, scaled(o, f), times)[0], travel(run, scaled(o, f), times)[1]);
  };
  const Travel at = travelled(LogFactors::Zero());
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 3; ++i) {
    const LogFactors step = kStep * LogFactors::Unit(i);
    const Pose2 plus = travelled(step).pose, minus = travelled(-step).pose;
    EXPECT_NEAR(at.by_factor(0, i), (plus.x_m - minus.x_m) / (2 * kStep), 1e-7);
    EXPECT_NEAR(at.by_factor(1, i), (plus.y_m - minus.y_m) / (2 * kStep), 1e-7);
    EXPECT_NEAR(at.by_factor(2, i), (plus.theta_rad - minus.theta_rad) / (2 * kStep), 1e-7);
  }
}

// A straight line of length s: along s / 4, heading s / b^2, across s^3 / (3 b^2), for k = 1 of one wheel.
TEST(PathIntegral, NoiseOfAStraightLineIsTheClosedForm) {
  const OdometryParameters o = nominal_odometry();
  const RecordedRun run = tracked_run("a", "free", robot(1, 1, 1), o, {{2, 2}});
  const Travel at = travel(run, o, {run.encoders.back().time_s})[0];
  const double b2 = 0.34 * 0.34;
  constexpr double kSteps = 2e-4;  // the sum over 160 steps in place of the integral: 1 / (4 n^2) and less
  EXPECT_NEAR(at.left_noise(0, 0), 2.0 / 4, 1e-9);
  EXPECT_NEAR(at.left_noise(2, 2), 2 / b2, 1e-6);
  EXPECT_NEAR(at.left_noise(1, 1) / (8 / (3 * b2)), 1, kSteps);
  EXPECT_NEAR(at.right_noise(0, 2), -at.left_noise(0, 2), 1e-9);
}

}  // namespace
}  // namespace umbsim::calibration

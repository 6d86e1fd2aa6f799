// The course's timing and shape by closed form, and the driver in pure kinematics.
#include "umbmark/course.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/umbmark/exact_kinematics.h"
#include "umbmark/control_loop.h"

namespace umbsim {
namespace {

using testing::PlanePose;

constexpr double kCourseRoundOff = 1e-9;

Course arc_course() {
  Course course;
  course.turn = "arc";
  course.turn_radius_m = 0.5;
  return course;
}

TEST(Plan, DurationsAreThoseOfTrapezia) {
  const Course c;
  const Plan plan(c, Direction::ccw);
  ASSERT_EQ(plan.segments().size(), 8u);
  const double leg_s = 4 / 0.2 + 0.2 / 0.25;  // L / v + v / a
  const double turn_s = (M_PI / 2) / 0.7 + 0.7 / 1.5;
  EXPECT_NEAR(plan.segments()[0].duration_s, leg_s, kCourseRoundOff);
  EXPECT_NEAR(plan.segments()[1].duration_s, turn_s, kCourseRoundOff);
  EXPECT_NEAR(plan.duration_s(), 4 * (leg_s + turn_s) + 8 * c.dwell_s, kCourseRoundOff);
  std::cout << "4 m square: " << plan.duration_s() << " s\n";
}

TEST(Plan, ShortWaysAreTriangles) {
  Course c;
  c.side_m = 0.1;  // 0.2 m/s needs 0.16 m to speed up and slow down
  EXPECT_NEAR(Plan(c, Direction::cw).segments()[0].duration_s, 2 * std::sqrt(0.1 / 0.25), kCourseRoundOff);
}

TEST(Plan, ATightCircleIsNoFasterThanItsTurn) {
  Course c;
  c.shape = "circle";
  c.radius_m = 0.15;  // 0.2 m/s would be 1.33 rad/s
  const Segment circle = Plan(c, Direction::ccw).segments()[0];
  EXPECT_NEAR(circle.speed, 0.7 * 0.15, kCourseRoundOff);
  EXPECT_NEAR(circle.duration_s, 2 * M_PI / 0.7 + 0.7 * 0.15 / 0.25, kCourseRoundOff);
}

TEST(Plan, ArcTurnsAreQuarterCircles) {
  const Plan plan(arc_course(), Direction::ccw);
  EXPECT_NEAR(plan.segments()[0].length_m, 3, kCourseRoundOff);
  EXPECT_NEAR(plan.segments()[1].length_m, 0.5 * M_PI / 2, kCourseRoundOff);
  const Segment& turn = plan.segments()[1];
  for (double t = 0; t <= turn.duration_s; t += 0.1) {
    const Pose2 p = plan.at(turn.start_s + t).X_SB;
    EXPECT_NEAR(std::hypot(p.x_m - 3, p.y_m - 0.5), 0.5, kCourseRoundOff) << "about (3, 0.5)";
  }
  EXPECT_NEAR(plan.at(turn.start_s + turn.duration_s).X_SB.x_m, 3.5, kCourseRoundOff);
  EXPECT_NEAR(plan.at(turn.start_s + turn.duration_s).X_SB.y_m, 0.5, kCourseRoundOff);
}

TEST(Plan, CornersAndEndOfTheSquare) {
  for (const Direction direction : {Direction::cw, Direction::ccw}) {
    const double sense = direction == Direction::ccw ? 1 : -1;
    const Plan plan(Course{}, direction);
    const double corner_x[] = {4, 4, 0, 0}, corner_y[] = {0, 4, 4, 0};
    for (int leg = 0; leg < 4; ++leg) {
      const Segment& turn = plan.segments()[2 * leg + 1];
      const Pose2 p = plan.at(turn.start_s + turn.duration_s / 2).X_SB;
      EXPECT_NEAR(p.x_m, corner_x[leg], kCourseRoundOff);
      EXPECT_NEAR(p.y_m, sense * corner_y[leg], kCourseRoundOff);
      EXPECT_NEAR(p.theta_rad, sense * M_PI / 2 * (leg + 0.5), kCourseRoundOff);
    }
    const Pose2 end = plan.at(plan.duration_s() + 10).X_SB;
    EXPECT_NEAR(std::hypot(end.x_m, end.y_m), 0, kCourseRoundOff);
    EXPECT_NEAR(end.theta_rad, sense * 2 * M_PI, kCourseRoundOff);
  }
}

TEST(Plan, ClosesForArcsAndSeveralLaps) {
  Course c = arc_course();
  c.laps = 3;
  const Plan plan(c, Direction::cw);
  EXPECT_EQ(plan.segments().size(), 24u);
  const Pose2 end = plan.at(plan.duration_s()).X_SB;
  EXPECT_NEAR(std::hypot(end.x_m, end.y_m), 0, kCourseRoundOff);
  EXPECT_NEAR(end.theta_rad, -6 * M_PI, kCourseRoundOff);
}

// No jump in place, and none in speed: over 5 ms neither changes by more than speed and acceleration allow.
TEST(Plan, ReferenceIsContinuousInPlaceAndSpeed) {
  constexpr double kStep_s = 0.005, kSlack = 1e-6;
  for (const Course& c : {Course{}, arc_course()}) {
    const double w_max = c.turn == "arc" ? 0.2 / 0.5 : 0.7;
    const double w_accel = c.turn == "arc" ? 0.25 / 0.5 : 1.5;
    const Plan plan(c, Direction::ccw);
    Pose2 last = plan.at(0).X_SB;
    double last_v = 0, last_w = 0;
    int hint = 0;
    for (double t = kStep_s; t < plan.duration_s(); t += kStep_s) {
      const Reference now = plan.at(t, hint);
      hint = now.segment;
      const double v = std::hypot(now.X_SB.x_m - last.x_m, now.X_SB.y_m - last.y_m) / kStep_s;
      const double w = std::abs(now.X_SB.theta_rad - last.theta_rad) / kStep_s;
      ASSERT_LE(v, 0.2 + kSlack) << t;
      ASSERT_LE(w, w_max + kSlack) << t;
      ASSERT_LE(std::abs(v - last_v), 0.25 * kStep_s + kSlack) << t;
      ASSERT_LE(std::abs(w - last_w), w_accel * kStep_s + kSlack) << t;
      last = now.X_SB;
      last_v = v;
      last_w = w;
    }
  }
}

TEST(Plan, HintDoesNotChangeTheAnswer) {
  const Plan plan(Course{}, Direction::cw);
  for (double t = 0; t < plan.duration_s(); t += 0.37) {
    for (const int hint : {-3, 0, 4, 7, 100}) {
      EXPECT_EQ(plan.at(t, hint).segment, plan.at(t).segment);
      EXPECT_EQ(plan.at(t, hint).X_SB.x_m, plan.at(t).X_SB.x_m);
    }
  }
}

TEST(Plan, CwIsTheMirrorImageOfCcw) {
  const Plan cw(Course{}, Direction::cw), ccw(Course{}, Direction::ccw);
  ASSERT_EQ(cw.duration_s(), ccw.duration_s());
  for (double t = 0; t < cw.duration_s(); t += 0.11) {
    const Pose2 a = cw.at(t).X_SB, b = ccw.at(t).X_SB;
    EXPECT_EQ(a.x_m, b.x_m);
    EXPECT_EQ(a.y_m, -b.y_m);
    EXPECT_EQ(a.theta_rad, -b.theta_rad);
  }
}

// The largest distance from the reference later than `from_s` in a course that begins at `start`.
double tracking_error(const Course& c, const PlanePose& start, double from_s, PlanePose& robot) {
  const Plan plan(c, Direction::ccw);
  const DriveGeometry geometry{0.075, 0.0752, 0.341};
  constexpr double kPeriod_s = 0.02;
  robot = start;
  double worst_m = 0;
  int segment = 0;
  for (double t = 0; t < plan.duration_s(); t += kPeriod_s) {
    const Reference now = plan.at(t, segment);
    segment = now.segment;
    if (t > from_s) worst_m = std::max(worst_m, std::abs(robot.p - std::complex(now.X_SB.x_m, now.X_SB.y_m)));
    const Pose2 X_SB{robot.p.real(), robot.p.imag(), robot.heading};
    const WheelSpeeds w = drive(plan, t, kPeriod_s, X_SB, geometry, segment);
    robot.roll(w.left_radps * 0.075 * kPeriod_s, w.right_radps * 0.0752 * kPeriod_s, 0.341);
  }
  return worst_m;
}

// Where each control period lies within one segment with constant acceleration the feed-forward is exact; periods
// that straddle a start from rest are exact as well, since only one of forward motion and turn is non-zero.
TEST(Driver, StaysOnTheReference) {
  PlanePose robot;
  EXPECT_LT(tracking_error(Course{}, {}, 0, robot), kCourseRoundOff);
  EXPECT_NEAR(std::abs(robot.p), 0, kCourseRoundOff);
  EXPECT_NEAR(robot.heading, 2 * M_PI, kCourseRoundOff);
}

// Errors along the path and of the heading fade out within a second. Errors across it fade only while driving, the
// slower the slower the drive: turns in place carry them round the corner.
TEST(Driver, ConvergesFromAnOffset) {
  PlanePose robot;
  const double along_m = tracking_error(Course{}, {{0.03, 0}, 0}, 5, robot);
  EXPECT_LT(along_m, 1e-6);  // e^-20 of the offset at four per second
  const double after_one_m = tracking_error(Course{}, {{0, 0.05}, 0.1}, 20, robot);
  const double after_four_m = tracking_error(Course{}, {{0, 0.05}, 0.1}, 93, robot);
  std::cout << "at the start 30 mm along the path: " << 1e6 * along_m
            << " um after 5 s; 50 mm across and 5.7 degrees: " << 1e3 * after_one_m << " mm after the first leg, "
            << 1e3 * after_four_m << " mm after the fourth\n";
  EXPECT_LT(after_one_m, 0.5 * 0.05);
  EXPECT_LT(after_four_m, 0.05 * 0.05);
  EXPECT_NEAR(robot.heading, 2 * M_PI, 0.001);
}

// The law itself, of a robot whose wheels have a radius of one metre and stand two apart: half their sum is the speed,
// half their difference the turn. The speed follows the cosine of the heading error, by its series and beyond.
TEST(Driver, CorrectsByTheLawOfKanayama) {
  constexpr double kSpeed = 0.8, kPeriod_s = 0.02, kAlong_m = 0.03, kAcross_m = -0.05;
  constexpr double kRoundOff = 1e-15;
  for (const double heading_error_rad : {-0.5, -0.09999, 0.0, 0.05, 0.09999, 0.3}) {
    const double c = std::cos(heading_error_rad), s = std::sin(heading_error_rad);
    // The robot looks along x, so that the reference's place in its frame is that of the world.
    const Pose2 X_SR{kAlong_m, kAcross_m, heading_error_rad};
    const Pose2 X_next{kAlong_m + kSpeed * kPeriod_s * c, kAcross_m + kSpeed * kPeriod_s * s, heading_error_rad};
    const WheelSpeeds w = follow(X_SR, X_next, kPeriod_s, {}, {1, 1, 2});
    const double speed = (w.left_radps + w.right_radps) / 2, turn = (w.right_radps - w.left_radps) / 2;
    EXPECT_NEAR(speed, kSpeed * c + kDriver.along * kAlong_m, 4 * kRoundOff) << heading_error_rad;
    EXPECT_NEAR(turn, kDriver.heading * heading_error_rad + across_gain(kSpeed) * kAcross_m, 4 * kRoundOff);
  }
  const WheelSpeeds unequal = follow({}, {kSpeed * kPeriod_s, 0, 0}, kPeriod_s, {}, {0.5, 0.25, 2});
  EXPECT_NEAR(unequal.left_radps, kSpeed / 0.5, 8 * kRoundOff);
  EXPECT_NEAR(unequal.right_radps, kSpeed / 0.25, 8 * kRoundOff);
}

TEST(Driver, StandsStillAtTheEnd) {
  const Plan plan(Course{}, Direction::cw);
  const Pose2 end = plan.at(plan.duration_s()).X_SB;
  const WheelSpeeds w = drive(plan, plan.duration_s() + 1, 0.02, end, {0.075, 0.075, 0.34}, 7);
  EXPECT_NEAR(w.left_radps, 0, kCourseRoundOff);
  EXPECT_NEAR(w.right_radps, 0, kCourseRoundOff);
}

Course circle_course(const char* shape, double radius_m) {
  Course c;
  c.shape = shape;
  c.radius_m = radius_m;
  return c;
}

Course path_course(std::vector<Waypoint> waypoints, const char* turn = "in_place", double turn_radius_m = 0.3) {
  Course c;
  c.shape = "path";
  c.waypoints = std::move(waypoints);
  c.turn = turn;
  c.turn_radius_m = turn_radius_m;
  return c;
}

TEST(Shapes, ACircleLiesOnTheSideOfItsDirection) {
  for (const Direction direction : {Direction::cw, Direction::ccw}) {
    const double sense = direction == Direction::ccw ? 1 : -1;
    const Plan plan(circle_course("circle", 0.75), direction);
    for (double t = 0; t < plan.duration_s(); t += 0.5) {
      const Pose2 p = plan.at(t).X_SB;
      EXPECT_NEAR(std::hypot(p.x_m, p.y_m - sense * 0.75), 0.75, kCourseRoundOff);
    }
    const Pose2 end = plan.at(plan.duration_s()).X_SB;
    EXPECT_NEAR(std::hypot(end.x_m, end.y_m), 0, kCourseRoundOff);
    EXPECT_NEAR(end.theta_rad, sense * 2 * M_PI, kCourseRoundOff);
  }
}

TEST(Shapes, AnEightComesBackWithTheHeadingOfItsStart) {
  const Plan plan(circle_course("figure_eight", 0.75), Direction::ccw);
  ASSERT_EQ(plan.segments().size(), 2u);
  const Segment& second = plan.segments()[1];
  const Pose2 left = plan.at(plan.segments()[0].duration_s / 2).X_SB;
  const Pose2 right = plan.at(second.start_s + second.duration_s / 2).X_SB;
  EXPECT_NEAR(left.y_m, 1.5, kCourseRoundOff);
  EXPECT_NEAR(right.y_m, -1.5, kCourseRoundOff);
  const Pose2 end = plan.at(plan.duration_s()).X_SB;
  EXPECT_NEAR(std::hypot(end.x_m, end.y_m), 0, kCourseRoundOff);
  EXPECT_NEAR(end.theta_rad, 0, kCourseRoundOff);
}

TEST(Shapes, APathPassesItsWaypointsAndIsMirroredForCw) {
  Course c = path_course({{2, 0}, {2, 1}, {-1, 1}, {0, 0}});
  c.laps = 2;
  for (const Direction direction : {Direction::cw, Direction::ccw}) {
    const double sense = direction == Direction::ccw ? 1 : -1;
    const Plan plan(c, direction);
    for (int leg = 1; leg <= 8; ++leg) {
      const Segment& s = plan.segments()[plan.leg_segment(leg).value()];
      const Pose2 p = plan.at(s.start_s + s.duration_s).X_SB;
      const Waypoint& to = c.waypoints[std::size_t(leg - 1) % 4];
      EXPECT_NEAR(p.x_m, to.x_m, kCourseRoundOff) << leg;
      EXPECT_NEAR(p.y_m, sense * to.y_m, kCourseRoundOff) << leg;
    }
    EXPECT_FALSE(plan.leg_segment(9));
  }
}

TEST(Shapes, APathThatGoesStraightBackTurnsToTheLeft) {
  // Along, against and across the axes: the bearings' difference is +pi or -pi by round-off alone.
  for (const Waypoint& there : {Waypoint{1, 0}, Waypoint{-1, 0}, Waypoint{0, 1}, Waypoint{0.3, -0.7}}) {
    for (const Direction direction : {Direction::ccw, Direction::cw}) {
      const std::vector<Segment> all = shapes_of(path_course({there, {0, 0}}), direction);
      ASSERT_GE(all.size(), 3u);
      EXPECT_NEAR(all[all.size() - 2].angle_rad, direction == Direction::ccw ? M_PI : -M_PI, kCourseRoundOff);
    }
  }
}

// Corners are cut: an arc of radius r takes r tan(turn / 2) of the legs at either side.
TEST(Shapes, ArcsTouchBothLegsOfAPath) {
  const Plan plan(path_course({{2, 0}, {2, 2}}, "arc"), Direction::ccw);
  ASSERT_EQ(plan.segments().size(), 3u);
  EXPECT_NEAR(plan.segments()[0].length_m, 1.7, kCourseRoundOff);
  EXPECT_NEAR(plan.segments()[1].length_m, 0.3 * M_PI / 2, kCourseRoundOff);
  EXPECT_NEAR(plan.segments()[2].length_m, 1.7, kCourseRoundOff);
  const Pose2 end = plan.at(plan.duration_s()).X_SB;
  EXPECT_NEAR(end.x_m, 2, kCourseRoundOff);
  EXPECT_NEAR(end.y_m, 2, kCourseRoundOff);
}

TEST(Shapes, WhatCannotBeDrivenIsNamed) {
  EXPECT_EQ(problem_of(path_course({})).key, "waypoints_m");
  EXPECT_EQ(problem_of(path_course({{1, 0}, {1, 0.001}})).key, "waypoints_m");
  EXPECT_EQ(problem_of(path_course({{0, 0}})).key, "waypoints_m") << "the start itself";
  EXPECT_EQ(problem_of(path_course({{1, 0}, {1, 0.2}, {0, 0.2}}, "arc")).key, "turn_radius_m");
  EXPECT_EQ(problem_of(path_course({{1, 0}, {0, 0}}, "arc")).key, "turn_radius_m") << "straight back";
  EXPECT_EQ(problem_of(path_course({{1, 0}, {1, 1}}, "arc")).key, "");
  Course again = path_course({{1, 0}, {1, 0.001}});
  again.waypoints.pop_back();
  again.laps = 2;  // the second lap begins where it ends
  EXPECT_EQ(problem_of(again).key, "waypoints_m");
}

// A robot whose wheelbase is E_b times what it believes drives the believed circle of radius R: its own is E_b R, swept
// by 2 pi / E_b. It ends 2 E_b R sin(pi / E_b) from where it thinks it is, at the start.
TEST(Shapes, ACircleWithAWrongWheelbaseMissesByTheClosedForm) {
  constexpr double kRadius_m = 1, kEb = 1.02, kWheelbase_m = 0.34;
  const Plan plan(circle_course("circle", kRadius_m), Direction::ccw);
  const DriveGeometry believed{0.075, 0.075, kWheelbase_m};
  PlanePose thought, robot;
  const double period_s = 0.02;
  for (int k = 0; k * period_s < plan.duration_s(); ++k) {
    const Pose2 X_SB{thought.p.real(), thought.p.imag(), thought.heading};
    const WheelSpeeds w = drive(plan, k * period_s, period_s, X_SB, believed, 0);
    const double left_m = w.left_radps * period_s * 0.075, right_m = w.right_radps * period_s * 0.075;
    thought.roll(left_m, right_m, kWheelbase_m);
    robot.roll(left_m, right_m, kEb * kWheelbase_m);
  }
  EXPECT_NEAR(std::abs(thought.p), 0, 1e-6) << "its own odometry closes the circle";
  EXPECT_NEAR(std::abs(robot.p), 2 * kEb * kRadius_m * std::abs(std::sin(M_PI / kEb)), 1e-5);
  EXPECT_NEAR(robot.heading, 2 * M_PI / kEb, 1e-6);
}

}  // namespace
}  // namespace umbsim

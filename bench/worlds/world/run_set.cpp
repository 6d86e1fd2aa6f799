#include "bench/worlds/world/run_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "experiment/drive/commanded_course.h"
#include "gap/trial/draw/trial_plan.h"

namespace umbsim::worlds {
namespace {

constexpr double kPayloadShare = 0.375;  // of the base's mass, as in gap plan
constexpr double kTurnRadius = 0.15;     // of rolling turns, in sides of the square
constexpr int kRuns = 4;                 // of sets that are not squares

Course draw_limits(const WorldRobot& robot, RandomStream& random) {
  const RobotModel& m = robot.model;
  const double size = std::sqrt(m.wheels[0].radius_m / kLabmateRadius_m);
  Course c;
  c.linear_speed_mps = rounded(random.uniform(0.2, 0.4) * size, 0.01);
  c.angular_speed_radps = rounded(random.uniform(0.5, 0.9), 0.01);
  c.linear_acceleration_mps2 = rounded(random.uniform(0.2, 0.4), 0.01);
  c.angular_acceleration_radps2 = rounded(random.uniform(1, 2), 0.1);
  c.side_m = rounded(std::clamp(random.uniform(5, 9) * m.wheelbase_m(), 1.0, 3.5), 0.1);
  return c;
}

RecordedRun run(const std::string& id, const std::string& direction) {
  RecordedRun r;
  r.id = id;
  r.direction = direction;
  return r;
}

std::vector<RecordedRun> squares(const std::string& set, const Course& c, const WorldRobot& robot,
                                 double rolling_radius_m) {
  std::vector<RecordedRun> runs;
  if (set == "one_way") {
    for (int k = 1; k <= kRuns; ++k) runs.push_back(run(fmt::format("cw-{}", k), "cw"));
    return runs;
  }
  if (set != "recommended") {
    for (int k = 1; k <= (set == "plain_5" ? 5 : 2); ++k) {
      for (const char* direction : {"cw", "ccw"}) runs.push_back(run(fmt::format("{}-{}", direction, k), direction));
    }
    return runs;
  }
  for (const PlannedRun& planned : recommended_runs()) {
    RecordedRun r = run(planned.id, planned.direction);
    if (planned.start_heading_rad != 0) r.start_heading_rad = planned.start_heading_rad;
    if (planned.speed_factor != 1) r.linear_speed_mps = planned.speed_factor * c.linear_speed_mps;
    if (planned.payload_kg > 0) r.payload_kg = rounded(kPayloadShare * robot.model.base.mass_kg, 0.01);
    if (planned.turn_radius_m > 0) {
      r.turn = "arc";
      r.turn_radius_m = rolling_radius_m;
    }
    runs.push_back(r);
  }
  return runs;
}

Segment leg(int number, double length_m) {
  return {.kind = Segment::Kind::leg, .leg = number, .length_m = length_m, .X_SB_start = {}};
}
Segment turn(int number, double length_m, double angle_rad) {
  return {.kind = Segment::Kind::turn, .leg = number, .length_m = length_m, .angle_rad = angle_rad, .X_SB_start = {}};
}

// A human's or explorer's way: legs, arcs and turns on the spot, back towards the start when it has gone far.
std::vector<Segment> wander(double side_m, RandomStream& random) {
  std::vector<Segment> way;
  Pose2 X_SB;
  for (int number = 1; number <= 6; ++number) {
    const double home = std::atan2(-X_SB.y_m, -X_SB.x_m) - X_SB.theta_rad;
    const bool far = std::hypot(X_SB.x_m, X_SB.y_m) > 0.6 * side_m;
    const double angle = wrap_angle(far ? home + random.uniform(-0.4, 0.4) : random.uniform(-2.4, 2.4));
    if (number > 1 || far) way.push_back(turn(std::max(1, number - 1), 0, angle));
    if (number > 1 || far) X_SB = X_SB * Pose2{0, 0, angle};
    const double length = random.uniform(0.5, 1) * side_m;
    const double bend = random.uniform() < 0.5 ? 0 : random.uniform(-1.5, 1.5);
    way.push_back(bend == 0 ? leg(number, length) : turn(number, length, bend));
    X_SB = X_SB * arc(length, bend);
  }
  return way;
}

std::vector<Segment> free_shape(const std::string& set, double side_m, int number, RandomStream& random) {
  const double sign = number % 2 == 0 ? -1 : 1;
  const double radius_m = set == "circles" ? side_m / 2 : side_m / 3;
  const double round_m = 2 * M_PI * radius_m;
  if (set == "circles") return {turn(1, round_m, sign * 2 * M_PI)};
  if (set == "eights") return {turn(1, round_m, sign * 2 * M_PI), turn(2, round_m, -sign * 2 * M_PI)};
  return wander(side_m, random);
}

void plan_free(PlannedRuns& planned, const Course& c, RandomStream& random) {
  const bool circles = planned.set == "circles";
  planned.recording.path.shape = circles ? "circle" : "free";
  if (circles) {
    planned.recording.path.turn = "arc";
    planned.recording.path.turn_radius_m = c.side_m / 2;
  }
  for (int k = 0; k < kRuns; ++k) {
    const std::string direction = !circles ? "free" : (k % 2 == 0 ? "cw" : "ccw");
    planned.recording.runs.push_back(run(fmt::format("{}-{}", direction, circles ? k / 2 + 1 : k + 1), direction));
    planned.ways.push_back({c, free_shape(planned.set, c.side_m, k, random)});
  }
}

PlannedRuns without_runs(const std::string& set, const WorldRobot& robot, const Course& c, double rate_hz) {
  PlannedRuns planned;
  planned.set = set;
  Recording& r = planned.recording;
  r.title = "recording";
  r.robot = {"robot.urdf", robot.model.wheels[0].radius_m, robot.model.wheelbase_m(), robot.ticks_per_revolution};
  r.path.side_m = c.side_m;
  r.path.linear_speed_mps = c.linear_speed_mps;
  r.path.angular_speed_radps = c.angular_speed_radps;
  r.path.linear_acceleration_mps2 = c.linear_acceleration_mps2;
  r.path.angular_acceleration_radps2 = c.angular_acceleration_radps2;
  r.encoder_rate_hz = rate_hz;
  return planned;
}

}  // namespace

PlannedRuns plan_squares(const std::string& set, const WorldRobot& robot, const Course& course, double rolling_radius_m,
                         double rate_hz) {
  PlannedRuns planned = without_runs(set, robot, course, rate_hz);
  Recording& r = planned.recording;
  r.runs = squares(set, course, robot, rolling_radius_m);
  for (const RecordedRun& each : r.runs) {
    const Course limits = commanded_course(r.path, each, {});
    const Direction direction = each.direction == "cw" ? Direction::cw : Direction::ccw;
    planned.ways.push_back({limits, Plan(limits, direction).segments()});
  }
  return planned;
}

PlannedRuns plan_runs(const std::string& set, const WorldRobot& robot, double rate_hz, RandomStream& random) {
  const Course c = draw_limits(robot, random);
  if (std::find(std::begin(kSquareSets), std::end(kSquareSets), set) != std::end(kSquareSets))
    return plan_squares(set, robot, c, rounded(kTurnRadius * c.side_m, 0.01), rate_hz);
  PlannedRuns planned = without_runs(set, robot, c, rate_hz);
  plan_free(planned, c, random);
  return planned;
}

Way commanded_way(const PlannedRuns& planned, std::size_t number, const CommandedMotion& motion) {
  Way way = planned.ways[number];
  way.limits = commanded(way.limits, motion);
  return way;
}

double duration_s(const Way& way) { return Plan(way.limits, way.segments).duration_s(); }

}  // namespace umbsim::worlds

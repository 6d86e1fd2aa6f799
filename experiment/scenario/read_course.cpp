#include "experiment/scenario/read_course.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "recording/read_waypoints.h"

namespace umbsim {
namespace {

const Bounds kLength{0, 1000, true};
const Bounds kPlace = Bounds::between(-1000, 1000);

// A length that the shape does not have is a mistake, not a detail.
void only_of(YamlMap& map, const char* key, const std::string& shape, const std::vector<std::string>& shapes) {
  const auto value = map.find(key);
  if (!value || std::find(shapes.begin(), shapes.end(), shape) != shapes.end()) return;
  value->fail(fmt::format("only of shape {}; course.shape is {}", fmt::join(shapes, " or "), shape));
}

}  // namespace

Course read_course(const YamlValue& value) {
  YamlMap map(value);
  Course c;
  const Bounds positive = Bounds::positive();
  c.shape = map.choice("shape", c.shape, {"square", "circle", "figure_eight", "path"});
  c.side_m = map.number("side_m", c.side_m, kLength);
  c.radius_m = map.number("radius_m", c.radius_m, kLength);
  if (const auto list = map.find("waypoints_m")) c.waypoints = read_waypoints(*list, kPlace);
  only_of(map, "radius_m", c.shape, {"circle", "figure_eight"});
  only_of(map, "waypoints_m", c.shape, {"path"});
  c.turn = map.choice("turn", c.turn, {"in_place", "arc"});
  c.turn_radius_m = map.number("turn_radius_m", c.turn_radius_m, positive);
  c.linear_speed_mps = map.number("linear_speed_mps", c.linear_speed_mps, {0, 10, true});
  c.angular_speed_radps = map.number("angular_speed_radps", c.angular_speed_radps, {0, 20, true});
  c.linear_acceleration_mps2 = map.number("linear_acceleration_mps2", c.linear_acceleration_mps2, positive);
  c.angular_acceleration_radps2 = map.number("angular_acceleration_radps2", c.angular_acceleration_radps2, positive);
  c.dwell_s = map.number("dwell_s", c.dwell_s, Bounds::between(0, 60));
  c.laps = int(map.integer("laps", c.laps, 1, 1000));
  map.finish();
  const CourseProblem problem = problem_of(c);
  if (problem.key.empty()) return c;
  if (map.has(problem.key)) map.at(problem.key).fail(problem.what);
  value.fail(problem.key + ": " + problem.what);
}

std::string course_block(const Course& c) {
  std::string shape;
  if (c.shape == "circle" || c.shape == "figure_eight") shape = fmt::format("  radius_m: {}\n", c.radius_m);
  if (c.shape == "path") {
    std::vector<std::string> places;
    for (const Waypoint& w : c.waypoints) places.push_back(fmt::format("[{}, {}]", w.x_m, w.y_m));
    shape = fmt::format("  waypoints_m: [{}]\n", fmt::join(places, ", "));
  }
  return fmt::format(
      "course:\n  shape: {}\n  side_m: {}\n{}  turn: {}\n  turn_radius_m: {}\n  linear_speed_mps: {}\n"
      "  angular_speed_radps: {}\n  linear_acceleration_mps2: {}\n  angular_acceleration_radps2: {}\n"
      "  dwell_s: {}\n  laps: {}\n",
      c.shape, c.side_m, shape, c.turn, c.turn_radius_m, c.linear_speed_mps, c.angular_speed_radps,
      c.linear_acceleration_mps2, c.angular_acceleration_radps2, c.dwell_s, c.laps);
}

std::string course_in_words(const Course& c) {
  if (c.shape == "circle") return fmt::format("a circle of {} m radius", c.radius_m);
  if (c.shape == "figure_eight") return fmt::format("a figure eight of {} m radius", c.radius_m);
  if (c.shape == "path") return fmt::format("a path over {} waypoints", c.waypoints.size());
  return fmt::format("a {} m square", c.side_m);
}

}  // namespace umbsim

#include <fmt/format.h>

#include <cmath>

#include "umbmark/course.h"

namespace umbsim {
namespace {

constexpr double kLeastLeg_m = 0.01;    // nearer waypoints are one place
constexpr double kStraightOn_rad = 1e-9;  // a smaller turn is none

double sense(Direction direction) { return direction == Direction::ccw ? 1 : -1; }

void add_leg(std::vector<Segment>& shapes, int leg, double length_m, double angle_rad = 0) {
  shapes.push_back({.kind = Segment::Kind::leg, .leg = leg, .length_m = length_m, .angle_rad = angle_rad,
                    .X_SB_start = {}});
}

void add_turn(std::vector<Segment>& shapes, int leg, double radius_m, double angle_rad) {
  if (std::abs(angle_rad) < kStraightOn_rad) return;
  shapes.push_back({.kind = Segment::Kind::turn, .leg = leg, .length_m = radius_m * std::abs(angle_rad),
                    .angle_rad = angle_rad, .X_SB_start = {}});
}

std::vector<Segment> square(const Course& course, Direction direction) {
  const double radius_m = course.turn == "arc" ? course.turn_radius_m : 0;
  std::vector<Segment> shapes;
  for (int leg = 1; leg <= 4 * course.laps; ++leg) {
    add_leg(shapes, leg, course.side_m - 2 * radius_m);
    add_turn(shapes, leg, radius_m, sense(direction) * M_PI / 2);
  }
  return shapes;
}

// One circle a lap, or two of opposite senses.
std::vector<Segment> circles(const Course& course, Direction direction) {
  const bool eight = course.shape == "figure_eight";
  std::vector<Segment> shapes;
  for (int leg = 1; leg <= legs_per_lap(course) * course.laps; ++leg) {
    const double back = eight && leg % 2 == 0 ? -1 : 1;
    add_leg(shapes, leg, 2 * M_PI * course.radius_m, back * sense(direction) * 2 * M_PI);
  }
  return shapes;
}

// A straight of a path before its corners are cut: the turn that leads into it, and its length.
struct Straight {
  double turn_rad = 0;  ///< ccw positive, of the path as it is given
  double length_m = 0;
  std::size_t to = 0;   ///< the waypoint at its end
};

std::vector<Straight> straights(const Course& course) {
  std::vector<Straight> all;
  Waypoint at;
  double heading_rad = 0;
  for (int lap = 0; lap < course.laps; ++lap) {
    for (std::size_t i = 0; i < course.waypoints.size(); ++i) {
      const Waypoint& to = course.waypoints[i];
      const double dx = to.x_m - at.x_m, dy = to.y_m - at.y_m, bearing_rad = std::atan2(dy, dx);
      // Straight back counts as a turn to the left.
      double turn_rad = std::remainder(bearing_rad - heading_rad, 2 * M_PI);
      if (turn_rad <= -M_PI + kStraightOn_rad) turn_rad += 2 * M_PI;
      all.push_back({turn_rad, std::hypot(dx, dy), i});
      heading_rad = bearing_rad;
      at = to;
    }
  }
  return all;
}

// What an arc takes of the legs at either side of a corner. The first turn is made standing.
double cut_m(const Course& course, const std::vector<Straight>& all, std::size_t corner) {
  if (course.turn != "arc" || corner == 0 || corner >= all.size()) return 0;
  return course.turn_radius_m * std::tan(std::abs(all[corner].turn_rad) / 2);
}

double leg_m(const Course& course, const std::vector<Straight>& all, std::size_t i) {
  return all[i].length_m - cut_m(course, all, i) - cut_m(course, all, i + 1);
}

std::vector<Segment> path(const Course& course, Direction direction) {
  const std::vector<Straight> all = straights(course);
  std::vector<Segment> shapes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double radius_m = course.turn == "arc" && i > 0 ? course.turn_radius_m : 0;
    add_turn(shapes, int(i), radius_m, sense(direction) * all[i].turn_rad);
    add_leg(shapes, int(i) + 1, leg_m(course, all, i));
  }
  return shapes;
}

CourseProblem path_problem(Course course) {
  if (course.waypoints.empty()) return {"waypoints_m", "a path needs waypoints: [[x, y], ...] from the start at [0, 0]"};
  course.laps = std::min(course.laps, 2);  // the second begins where the first ends, later ones are like it
  const std::vector<Straight> all = straights(course);
  const auto from = [&](std::size_t i) {
    return i == 0 ? std::string("the start") : fmt::format("waypoint {}", all[i - 1].to + 1);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].length_m < kLeastLeg_m) {
      return {"waypoints_m", fmt::format("waypoint {} is {:g} m from {}: must be >= {:g} m", all[i].to + 1,
                                         all[i].length_m, from(i), kLeastLeg_m)};
    }
    if (leg_m(course, all, i) >= kLeastLeg_m) continue;
    return {"turn_radius_m", fmt::format("{:g} m does not fit between {} and waypoint {}, {:g} m apart: arcs would take "
                                         "{:.3g} m of it",
                                         course.turn_radius_m, from(i), all[i].to + 1, all[i].length_m,
                                         all[i].length_m - leg_m(course, all, i))};
  }
  return {};
}

}  // namespace

int legs_per_lap(const Course& course) {
  if (course.shape == "circle") return 1;
  if (course.shape == "figure_eight") return 2;
  return course.shape == "path" ? int(course.waypoints.size()) : 4;
}

CourseProblem problem_of(const Course& course) {
  if (course.shape == "path") return path_problem(course);
  if (course.shape == "square" && course.turn == "arc" && course.turn_radius_m >= course.side_m / 2) {
    return {"turn_radius_m", fmt::format("{} does not fit into a square of side_m = {} (must be < side_m / 2)",
                                         course.turn_radius_m, course.side_m)};
  }
  return {};
}

std::vector<Segment> shapes_of(const Course& course, Direction direction) {
  if (course.shape == "square") return square(course, direction);
  return course.shape == "path" ? path(course, direction) : circles(course, direction);
}

}  // namespace umbsim

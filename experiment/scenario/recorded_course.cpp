#include "experiment/scenario/recorded_course.h"

namespace umbsim {
namespace {

void set_shape(Course& course, const RecordedPath& path) {
  if (path.shape == "square" && path.side_m > 0) {
    course.shape = path.shape;
    course.side_m = path.side_m;
  }
  if ((path.shape == "circle" || path.shape == "figure_eight") && path.radius_m) {
    course.shape = path.shape;
    course.radius_m = *path.radius_m;
  }
  if (path.shape == "path" && !path.waypoints.empty()) {
    course.shape = path.shape;
    course.waypoints = path.waypoints;
  }
}

}  // namespace

void set_course(Course& course, const RecordedPath& path) {
  set_shape(course, path);
  course.turn = path.turn;
  course.turn_radius_m = path.turn_radius_m.value_or(course.turn_radius_m);
  course.linear_speed_mps = path.linear_speed_mps.value_or(course.linear_speed_mps);
  course.angular_speed_radps = path.angular_speed_radps.value_or(course.angular_speed_radps);
  course.linear_acceleration_mps2 = path.linear_acceleration_mps2.value_or(course.linear_acceleration_mps2);
  course.angular_acceleration_radps2 = path.angular_acceleration_radps2.value_or(course.angular_acceleration_radps2);
}

RecordedPath recorded_path(const Course& course) {
  RecordedPath path;
  path.shape = course.shape;
  if (course.shape == "square") path.side_m = course.side_m;
  if (course.shape == "circle" || course.shape == "figure_eight") path.radius_m = course.radius_m;
  path.waypoints = course.waypoints;
  path.turn = course.turn;
  if (course.turn == "arc") path.turn_radius_m = course.turn_radius_m;
  path.linear_speed_mps = course.linear_speed_mps;
  path.angular_speed_radps = course.angular_speed_radps;
  path.linear_acceleration_mps2 = course.linear_acceleration_mps2;
  path.angular_acceleration_radps2 = course.angular_acceleration_radps2;
  return path;
}

}  // namespace umbsim

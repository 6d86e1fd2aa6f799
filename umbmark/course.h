#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/pose2.h"
#include "recording/recording.h"

namespace umbsim {

enum class Direction { cw, ccw };
inline const char* name(Direction direction) { return direction == Direction::cw ? "cw" : "ccw"; }

/// A course and how it is driven. By default the square of Borenstein & Feng (1995): four straight legs, four turns.
struct Course {
  /// square; circle, figure_eight: of `radius_m`, ccw begins with a left turn; path: over `waypoints`, mirrored for cw
  std::string shape = "square";
  double side_m = 4;                ///< square only, > 0
  double radius_m = 1;              ///< circle and figure_eight only, > 0
  std::vector<Waypoint> waypoints;  ///< path only, in the frame of the start
  std::string turn = "in_place";    ///< in_place: about the robot's centre; arc: rolling, on `turn_radius_m`
  double turn_radius_m = 0.4;       ///< arc only, must fit into the legs
  double linear_speed_mps = 0.2;
  double angular_speed_radps = 0.7;
  double linear_acceleration_mps2 = 0.25;
  double angular_acceleration_radps2 = 1.5;
  double dwell_s = 0.2;  ///< standstill after every leg and turn
  int laps = 1;
};

/// One leg or turn from standstill to standstill.
struct Segment {
  enum class Kind { leg, turn };
  Kind kind = Kind::leg;
  int leg = 1;            ///< 1..legs_per_lap * laps; a turn belongs to the leg before it, 0: before the first
  double length_m = 0;    ///< along the path; 0 when turning in place
  double angle_rad = 0;   ///< ccw positive
  double duration_s = 0;  ///< motion, without the dwell
  double ramp_s = 0;      ///< of speeding up, and of slowing down
  double speed = 0;       ///< on the plateau, m/s; rad/s when turning in place
  double start_s = 0;
  Pose2 X_SB_start;  ///< in the frame of the course's start
};

/// Reference of the course at one moment, in the frame of the start.
struct Reference {
  Pose2 X_SB;
  int segment = 0;
};

/// Legs of one lap: the sides of a square, the circle or circles, the straights of a path.
int legs_per_lap(const Course& course);

/// What makes the course impossible, in words; empty if it can be driven. `key`: of the scenario's course, at fault.
struct CourseProblem {
  std::string key, what;
};
CourseProblem problem_of(const Course& course);

/// Shapes of all legs and turns, laps one after the other. A square with arc turns has legs of side - 2 radius, begins
/// at the start of the first of them, and turns on quarter circles. A path turns in place towards its first waypoint;
/// its next lap drives from the last waypoint to the first.
std::vector<Segment> shapes_of(const Course& course, Direction direction);

/// The legs and turns with trapezoidal speed profiles.
class Plan {
 public:
  Plan(const Course& course, Direction direction);
  /// Any way of legs and turns: of each shape `kind`, `leg`, `length_m` and `angle_rad` count, of the course the
  /// speeds, accelerations and the dwell.
  Plan(const Course& course, const std::vector<Segment>& shapes);

  const std::vector<Segment>& segments() const { return segments_; }
  double duration_s() const { return duration_s_; }  ///< with dwells
  /// Index of a leg's segment; none if the course has no such leg.
  std::optional<std::size_t> leg_segment(int leg) const;
  /// `hint`: the segment of the last call, so that the search is short.
  int segment_at(double time_s, int hint = 0) const;
  Reference at(double time_s, int segment_hint = 0) const;

 private:
  std::vector<Segment> segments_;
  double duration_s_ = 0;
};

/// Follows a plan on the robot's own odometry, as an experimenter's robot does: it never sees the truth.
struct WheelSpeeds {
  double left_radps = 0;
  double right_radps = 0;
};

/// What the driver believes of the robot, to turn speeds into wheel speeds: the odometry's parameters.
struct DriveGeometry {
  double left_radius_m = 0;
  double right_radius_m = 0;
  double wheelbase_m = 0;
};

/// Wheel speeds over a period in which the reference goes from `X_SR_now` to `X_SR_next`: the reference's own motion,
/// and a correction of the pose error (after Kanayama et al. 1990) that fades out within a second.
WheelSpeeds follow(const Pose2& X_SR_now, const Pose2& X_SR_next, double period_s, const Pose2& X_SB,
                   const DriveGeometry& geometry);

/// Speeds over the control period that begins at `time_s`: the reference's own motion, and a correction of the pose
/// error (after Kanayama et al. 1990) that fades out within a second. All poses in the frame of the start.
WheelSpeeds drive(const Plan& plan, double time_s, double period_s, const Pose2& X_SB, const DriveGeometry& geometry,
                  int segment_hint);

}  // namespace umbsim

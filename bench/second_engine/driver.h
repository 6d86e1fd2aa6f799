#pragma once

#include "core/pose2.h"
#include "umbmark/course.h"

namespace umbsim::second_engine {

/// A driver of another make than umbmark's: it has no clock. Speeds follow from what is left of a leg or turn by its
/// own odometry: up with the acceleration, along at the top speed, down with the square root of what is left. Legs are
/// steered back to the ideal square.
class Driver {
 public:
  Driver(const Course& course, Direction direction, const DriveGeometry& believed, double period_s);

  bool done() const { return segment_ == 8; }
  /// Counts from 1; a turn belongs to the leg before it.
  int leg() const { return segment_ / 2 + 1; }
  /// Whether the last command was the first of a leg.
  bool leg_begins() const { return begins_ && segment_ % 2 == 0; }
  /// Wheel speeds for the next period, with the odometry's pose in the frame of the start.
  WheelSpeeds command(const Pose2& X_SB);

 private:
  double left_of_segment(const Pose2& X_SB) const;
  double speed(double left, double top, double acceleration, double braking);
  WheelSpeeds wheels(double v_mps, double w_radps) const;
  void next();

  Course course_;
  double sign_;
  DriveGeometry believed_;
  double period_s_;
  Pose2 start_;  // of the segment, on the ideal square
  int segment_ = 0;
  double speed_ = 0;
  int waited_ = 0;
  bool moving_ = true;
  bool begins_ = false;
};

}  // namespace umbsim::second_engine

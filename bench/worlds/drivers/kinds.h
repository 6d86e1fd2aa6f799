#pragma once

#include "bench/worlds/drivers/driver.h"

namespace umbsim::worlds {

std::unique_ptr<Driver> make_own(const Way& way, const DriveGeometry& believed, double period_s);
std::unique_ptr<Driver> make_s_curve(const Way& way, const DriveGeometry& believed, double period_s);

/// Forward and turning speed.
struct Twist {
  double v_mps = 0;
  double w_radps = 0;
};

/// Drivers without a clock: speeds follow from what is left of a segment. This is what they have in common: which
/// segment, whether it is over, and the pause after it.
class SegmentDriver : public Driver {
 public:
  SegmentDriver(const DriverChoice& choice, const Way& way, const DriveGeometry& believed);
  WheelSpeeds command(double time_s, const Seen& seen) override;
  bool done() const override { return segment_ == int(way_.segments.size()); }
  int segment() const override { return std::min(segment_, int(way_.segments.size()) - 1); }

 protected:
  /// What is left: metres, or radians where the segment turns in place.
  virtual Twist steer(const Segment& s, double left, const Pose2& X_SB) = 0;
  virtual const Pose2& look(double, const Seen& seen) { return seen.X_SB_odometry; }
  virtual double arrived(const Segment& s) const;
  double left_of(const Segment& s, const Pose2& X_SB) const;
  /// Up with the acceleration, along at the top, down with the square root of what is left.
  double ramped(double left, double top, double acceleration, double braking);
  double top_speed(const Segment& s) const;
  /// Where the segment has come to, with `left` to go.
  Pose2 reference(const Segment& s, double left) const;
  /// Of the pose against the segment's line: heading, and metres to the left.
  Pose2 error(const Segment& s, double left, const Pose2& X_SB) const;
  /// Speeds on legs, arcs and turns in place with the choice's gains.
  Twist proportional(const Segment& s, double left, const Pose2& X_SB);

  DriverChoice choice_;
  Way way_;
  double period_s_;

 private:
  DriveGeometry believed_;
  int segment_ = 0;
  double speed_ = 0;
  int waited_ = 0;
  bool moving_ = true;
};

inline bool in_place(const Segment& s) { return s.length_m == 0; }

std::unique_ptr<Driver> make_heading(const DriverChoice& choice, const Way& way, const DriveGeometry& believed);
std::unique_ptr<Driver> make_pursuit(const DriverChoice& choice, const Way& way, const DriveGeometry& believed);
std::unique_ptr<Driver> make_jumps(const DriverChoice& choice, const Way& way, const DriveGeometry& believed);
std::unique_ptr<Driver> make_joystick(const DriverChoice& choice, const Way& way, const DriveGeometry& believed,
                                      RandomStream random);

}  // namespace umbsim::worlds

#pragma once

#include <cstdint>

#include "core/pose2.h"

namespace umbsim {

/// What the odometry believes of the robot. Both radii differ only after a calibration.
struct OdometryParameters {
  double left_radius_m = 0;
  double right_radius_m = 0;
  double wheelbase_m = 0;
  double ticks_per_revolution = 0;

  double left_metres_per_tick() const { return 2 * M_PI * left_radius_m / ticks_per_revolution; }
  double right_metres_per_tick() const { return 2 * M_PI * right_radius_m / ticks_per_revolution; }
};

/// Integrates cumulative encoder ticks to a pose. Between two updates the path is taken as a circular arc, which is
/// exact for constant wheel speeds (the chord form; STYLE of docs/conventions.md).
class DeadReckoning {
 public:
  DeadReckoning(const OdometryParameters& parameters, const Pose2& X_OB_start, std::int64_t left_ticks = 0,
                std::int64_t right_ticks = 0)
      : parameters_(parameters), X_OB_(X_OB_start), left_ticks_(left_ticks), right_ticks_(right_ticks) {}

  void update(std::int64_t left_ticks, std::int64_t right_ticks) {
    const double left_m = double(left_ticks - left_ticks_) * parameters_.left_metres_per_tick();
    const double right_m = double(right_ticks - right_ticks_) * parameters_.right_metres_per_tick();
    left_ticks_ = left_ticks;
    right_ticks_ = right_ticks;
    X_OB_ = X_OB_ * arc((left_m + right_m) / 2, (right_m - left_m) / parameters_.wheelbase_m);
  }

  /// Goes on from here: an absolute measurement knows better.
  void correct(const Pose2& X_OB) { X_OB_ = X_OB; }

  const Pose2& pose() const { return X_OB_; }

 private:
  OdometryParameters parameters_;
  Pose2 X_OB_;
  std::int64_t left_ticks_;
  std::int64_t right_ticks_;
};

}  // namespace umbsim

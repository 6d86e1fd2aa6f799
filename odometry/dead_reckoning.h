#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/pose2.h"

namespace umbsim {

/// What the odometry believes of the robot. Both radii differ only after a calibration.
struct OdometryParameters {
  double left_radius_m = 0;
  double right_radius_m = 0;
  double wheelbase_m = 0;
  double ticks_per_revolution = 0;
  double scrub = 0;  ///< share of the wheels' ways that creep takes from turning, see `over_floor`

  double left_metres_per_tick() const { return 2 * M_PI * left_radius_m / ticks_per_revolution; }
  double right_metres_per_tick() const { return 2 * M_PI * right_radius_m / ticks_per_revolution; }
};

/// Ways of both wheels.
struct RolledWays {
  double left_m = 0;
  double right_m = 0;
};

/// What the wheels' counted ways come to over the floor. Contacts of some width and casters resist turning by a moment;
/// the tyres, which carry it, creep by the share `scrub` of all that they roll: in a left turn the right wheel falls
/// behind and the left one runs ahead. So a turn in place is `scrub` small, an arc of radius R by scrub 2R/b. Where the
/// robot hardly turns, the moment is in proportion to the bend of the way.
inline RolledWays over_floor(const OdometryParameters& p, RolledWays counted) {
  constexpr double kHardly = 0.06;  // the wheels' difference over their mean way: arcs of some 16 wheelbases
  const double way_m = (std::abs(counted.left_m) + std::abs(counted.right_m)) / 2;
  if (p.scrub == 0 || way_m == 0) return counted;
  const double bend = (counted.right_m - counted.left_m) / way_m;
  const double creep = p.scrub * bend / std::sqrt(bend * bend + kHardly * kHardly);
  return {counted.left_m + creep * std::abs(counted.left_m), counted.right_m - creep * std::abs(counted.right_m)};
}

/// Integrates cumulative encoder ticks to a pose. Between two updates the path is taken as a circular arc, which is
/// exact for constant wheel speeds (the chord form; STYLE of docs/conventions.md).
class DeadReckoning {
 public:
  DeadReckoning(const OdometryParameters& parameters, const Pose2& X_OB_start, std::int64_t left_ticks = 0,
                std::int64_t right_ticks = 0)
      : parameters_(parameters), X_OB_(X_OB_start), left_ticks_(left_ticks), right_ticks_(right_ticks) {}

  void update(std::int64_t left_ticks, std::int64_t right_ticks) {
    const auto [left_m, right_m] =
        over_floor(parameters_, {double(left_ticks - left_ticks_) * parameters_.left_metres_per_tick(),
                                 double(right_ticks - right_ticks_) * parameters_.right_metres_per_tick()});
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

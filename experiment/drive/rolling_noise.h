#pragma once

#include <array>

#include "core/random.h"
#include "effects/rig.h"
#include "sim/world.h"
#include "umbmark/course.h"

namespace umbsim {

/// A rough floor or tyre: the rolling radius of each wheel differs from one grain of the path to the next, so that the
/// path of a wheel after a distance s has the variance k^2 s. This is white noise along the path, the error that
/// PathNoise (odometry/uncertainty.h) assumes, made by the wheels in the world.
class RollingNoise {
 public:
  /// `k_m_per_sqrt_m` = 0: nothing ever happens; negative: the mirror image of the positive one.
  RollingNoise(double k_m_per_sqrt_m, const Rig& rig);

  /// Rolling radii over the wheels' own for a control period, left and right. Asked before every period, with the angles
  /// to which the wheels have turned so far and the speeds commanded for it.
  const std::array<double, 2>& next(const std::array<double, 2>& wheel_rad, const WheelSpeeds& command,
                                    double period_s);
  /// The same, of a world's wheels.
  void roughen(World& world, const WheelSpeeds& command, double period_s);

 private:
  struct Grain {
    RandomStream random;
    double radius_m;         // of the wheel
    double angle_rad = 0;    // of the wheel when last seen
    double length_m = 0;     // of the grain that it is on
    double rolled_m = 0;     // of that length
    double granted_1pm = 0;  // variance of the relative radius there, over k^2
    double owed_m = 0;       // variance of the path so far that is still due, over k^2
  };
  void next_grain(Grain& grain, double planned_m) const;

  double k_m_per_sqrt_m_;
  std::array<Grain, 2> grains_;
  std::array<double, 2> factors_{1, 1};
};

}  // namespace umbsim

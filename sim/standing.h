#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/error.h"
#include "sim/model/robot_model.h"

namespace umbsim {

/// How an upright robot moves on the floor, robot frame. Accelerations of the axle's middle.
struct FloorMotion {
  double forward_mps2 = 0;
  double left_mps2 = 0;  ///< on an arc: speed times turning speed
  double turning_radps2 = 0;
  double turning_speed2_radps2 = 0;  ///< square of the turning speed
};

/// A robot upright on its supports: what it weighs, and where it stands. Frame: the axle's middle, x forward, z up.
struct Standing {
  Inertial body;                          ///< all of it, wheels too
  std::array<Wheel, 2> wheels;            ///< for their spin
  std::vector<Eigen::Vector3d> contacts;  ///< of all supports with the floor
  Eigen::Vector3d gravity_mps2 = Eigen::Vector3d::Zero();

  /// How many times `more`, on top of `always`, it can be moved with all supports carrying load, by the balance of
  /// moments about each edge of the polygon in which it stands. 0: `always` alone tips it; infinite: no multiple does.
  double largest_share(const FloorMotion& more, const FloorMotion& always = {}) const;
};

/// How a robot came off its supports. Times since World::place.
struct Fall {
  double stood_s = 0;  ///< the last moment at which its supports held it
  double noticed_s = 0;
  double tilt_rad = 0;     ///< of the base, when it was noticed
  double heading_rad = 0;  ///< at the last moment that it stood
  std::string way;         ///< forwards, backwards, to the left, to the right
  std::string lifted;      ///< the supports that were off the floor when it was noticed
};

/// A robot that no longer stands on its wheels and casters.
class TippedOver : public RunError {
 public:
  TippedOver(const std::string& robot, const Fall& how);
  Fall fall;
};

/// A base that leans by more than this does not come back.
constexpr double kTippedOver_rad = 0.5235987755982988;  // 30 degrees

/// A robot that stands on one edge of its polygon of supports for longer than this is tipping over. A support that the
/// highest cable (0.05 m) throws up is down again after 2 sqrt(2 h / g) = 0.2 s.
constexpr double kMoment_s = 0.3;

}  // namespace umbsim

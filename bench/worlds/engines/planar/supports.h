#pragma once

#include <Eigen/Core>
#include <vector>

namespace umbsim::worlds::planar {

/// What presses the robot onto its supports: weight, and the torques about the floor under the axle's middle of
/// gravity, inertia and pulls, base frame.
struct Pressing {
  double weight_n = 0;
  double ahead_nm = 0;  ///< sum of x * load that balances it
  double left_nm = 0;   ///< sum of y * load
};

/// A stiff base on springs of equal stiffness: three supports are the statics, more share elastically. A support never
/// pulls.
class Supports {
 public:
  Supports() = default;
  /// Places in the base frame; `sink_m`: of each spring under an equal share of the weight.
  Supports(std::vector<Eigen::Vector2d> places_m, double weight_n, double sink_m);

  /// `raised_m`: floor under each support above level. False if no pressing of the supports balances: the robot tips.
  bool balance(const Pressing& pressing, const std::vector<double>& raised_m);
  void move(std::size_t i, const Eigen::Vector2d& place_m) { places_m_[i] = place_m; }

  const std::vector<double>& loads_n() const { return loads_n_; }
  /// How the base leans because of what raises its supports, nose down. (How much its springs give does not count: a
  /// base without inertia in pitch would swing on them.)
  double pitch_rad() const { return lean_[1]; }
  double roll_rad() const { return -lean_[2]; }

 private:
  bool solve(const Eigen::Vector3d& wanted, const std::vector<double>& raised_m, Eigen::Vector3d& sink);

  std::vector<Eigen::Vector2d> places_m_;
  std::vector<bool> carries_;
  std::vector<double> loads_n_;
  double stiffness_npm_ = 0;
  Eigen::Vector3d lean_ = Eigen::Vector3d::Zero();  // sink at the axle's middle, per metre ahead, per metre left
  bool leans_ = false;
};

}  // namespace umbsim::worlds::planar

#pragma once

#include <Eigen/Core>

#include "bench/worlds/engines/planar/plane.h"
#include "bench/worlds/engines/planar/tyre.h"
#include "sim/model/robot_model.h"

namespace umbsim::worlds::planar {

/// Forces of a support on the base, base frame.
struct Hold {
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
  double yaw_nm = 0;
};

/// A ball that drags with its friction, or a free wheel that swivels behind its upright axis with a dry bearing.
class CasterPart {
 public:
  CasterPart(const Caster& caster, const TyreLaw& law);

  /// `velocity_mps`: of the base under the axle's middle, base frame.
  Hold step(const Eigen::Vector2d& velocity_mps, double yaw_radps, double floor_friction, double load_n, double step_s);

  Eigen::Vector2d contact_m() const;
  double radius_m() const { return caster_.radius_m; }
  double mass_kg() const { return caster_.swivels ? caster_.fork.mass_kg + caster_.wheel_mass_kg : 0; }
  Eigen::Vector2d mass_place_m() const { return pivot_m_; }
  /// Of the fastest oscillation of its own under that load.
  double stiffest_radps(double load_n) const;

 private:
  Hold swivel(const Eigen::Vector2d& velocity_mps, double yaw_radps, double friction, double load_n, double step_s);
  double bearing_nm(double swivel_radps, double step_s);

  Caster caster_;
  TyreLaw law_;
  Tread tread_;
  Eigen::Vector2d pivot_m_, trail_m_;  // at swivel angle 0
  double fork_kgm2_ = 0;
  double bearing_stiffness_ = 0, bearing_damping_ = 0;
  double bearing_twist_rad_ = 0;
  double swivel_rad_ = 0;
  double fork_radps_ = 0;  // over the floor
};

}  // namespace umbsim::worlds::planar

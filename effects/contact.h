#pragma once

#include "effects/rig.h"

namespace umbsim {

/// The rolling radius shrinks with load.
struct TyreCompliance {
  double metres_per_newton = 0;
};
void apply(const TyreCompliance& effect, Rig& rig);

/// Contacts of finite width resist turning on the spot.
struct ContactPatch {
  double width_m = 0;
};
void apply(const ContactPatch& effect, Rig& rig);

/// Slip in proportion to traction before sliding: slip = creep * F / N of the way that a wheel rolls, and a speed per
/// force at any speed, also of a wheel that stands (the contacts of ODE and Gazebo: slip1, slip2).
struct TyreCreep {
  double along = 0;
  double across = 0;
  double slip_along_mps_per_n = 0;
  double slip_across_mps_per_n = 0;
};
void apply(const TyreCreep& effect, Rig& rig);

/// The first caster is a wheel that swivels behind a trail, instead of a ball.
struct CasterSwivel {
  double trail_m = 0;            ///< 0: as in the URDF
  double friction_nm = 0;        ///< of the swivel bearing
  double initial_angle_rad = 0;  ///< 0: trailing
  double bearing_creep = 0.05;   ///< share of the wheel's rolling rate; where it swivels slower, friction fades
};
void apply(const CasterSwivel& effect, Rig& rig);

/// Fixed casters drag on the floor, perhaps beside the middle.
struct CasterDrag {
  double coefficient = 0;  ///< drag over load
  double left_m = 0;       ///< shifts the casters sideways
};
void apply(const CasterDrag& effect, Rig& rig);

}  // namespace umbsim

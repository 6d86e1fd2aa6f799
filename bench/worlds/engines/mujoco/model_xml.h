#pragma once

#include <string>

#include "core/pose2.h"
#include "effects/rig.h"

namespace umbsim::worlds::mujoco {

struct MujocoOptions {
  double step_s = 0.002;
  std::string integrator = "implicit";  ///< Euler | implicit
  std::string cone = "elliptic";        ///< pyramidal | elliptic
  std::string wheel = "ellipsoid";      ///< sphere | ellipsoid | cylinder | capsule
  int condim = 3;                       ///< of the wheels' contacts: 4 with torsional, 6 with rolling friction
  double torsion_m = 0.001;
  double rolling_m = 0.00005;
  double impratio = 10;          ///< stiffness of friction over that of the normal
  double impedance = 0.95;       ///< solimp's first number; the second is half way from it to 1
  double contact_time_s = 0.01;  ///< solref's time constant; at least two steps
  double contact_damping_ratio = 1;
  double servo_time_s = 0.02;      ///< of the velocity servos against the robot's inertia,
  double tuned_kg = 0;             ///< which is of this mass, whatever is on board; 0: of the rig's
  double armature_over_wheel = 3;  ///< reflected inertia of motor and gear over the wheel's
  double joint_damping = 0.01;     ///< of the wheels' joints over the servo's gain
};

/// The rig as a MuJoCo model. Wheels 0 and 1: bodies "wheel<i>" with geoms "tyre<i>"; joints "motor<i>" carry motor and
/// encoder, behind a play also "play<i>". Where the floor is uneven, support k (wheels, then casters) has a plane
/// "floor<k>" of its own on a mocap body, to be laid tangent to the floor under it.
std::string model_xml(const Rig& rig, const MujocoOptions& options, const Pose2& X_WB);

/// What MuJoCo takes as a contact's friction: along and across, torsional, rolling.
struct TyreFriction {
  double sliding = 0;
  double torsion_m = 0;
  double rolling_m = 0;
};
TyreFriction tyre_friction(const Wheel& wheel, const MujocoOptions& options, double friction);

}  // namespace umbsim::worlds::mujoco

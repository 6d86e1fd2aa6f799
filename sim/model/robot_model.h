#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace umbsim {

/// Mass properties of a rigid body in the frame named beside the member.
struct Inertial {
  double mass_kg = 0;
  Eigen::Vector3d com_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_kgm2 = Eigen::Matrix3d::Zero();  ///< about the centre of mass
};

/// A spring that carries a wheel or caster, up and down along z of the base. At its place in the URDF it pushes the
/// wheel down with `preload_n`; from there it goes `up_m` into the robot and `down_m` out of it, between rigid stops.
struct Suspension {
  double stiffness_npm = 0;  ///< 0: none, the axle is part of the base
  double damping_nspm = 0;
  double preload_n = 0;
  double up_m = 0;
  double down_m = 0;
  double rest_load_n =
      0;  ///< that the support carries on a flat floor; 0: not known, found by letting the robot settle

  bool sprung() const { return stiffness_npm > 0; }
  bool operator==(const Suspension&) const = default;
};

/// A prismatic upright joint between base and wheel, as the URDF gives it. Up is into the robot.
struct Slide {
  std::string joint;  ///< empty: there is none
  double up_m = 0;
  double down_m = 0;
  double stiffness_npm = 0;  ///< 0: not given
  double preload_n = 0;      ///< at joint position zero; only with a stiffness

  bool operator==(const Slide&) const = default;
};

/// A driven wheel. Frame: the robot's base frame (origin in the middle between both wheel centres, x forward,
/// y left, z up).
struct Wheel {
  std::string joint;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< of rotation; turning about +y rolls forward
  double radius_m = 0;
  double width_m = 0;           ///< of the collision cylinder; 0 for a sphere
  double eccentricity_m = 0;    ///< of the rim's centre from the axle
  double eccentricity_rad = 0;  ///< where it points at wheel angle 0: 0 forward, growing as the wheel rolls forward
  double mass_kg = 0;
  double spin_inertia_kgm2 = 0;        ///< about the axis
  double transverse_inertia_kgm2 = 0;  ///< about a diameter
  double effort_limit_nm = 0;          ///< from the URDF's <limit>; 0 if it gives none
  // How the tyre meets the floor; all zero: a hard thin disc.
  double compliance_mpn = 0;         ///< loss of rolling radius per newton of load
  double creep_along = 0;            ///< slip per traction ratio (F/N) before sliding, rolling direction
  double creep_across = 0;           ///< the same sideways
  double slip_along_mps_per_n = 0;   ///< speed per force before sliding, at any speed, also standing
  double slip_across_mps_per_n = 0;  ///< the same sideways
  double patch_width_m = 0;          ///< of the contact, for its friction against turning on the spot
  double along_joint_m = 0;          ///< of the middle plane from the joint's origin, along the URDF's axis
  Slide slide;
  Suspension suspension;

  /// Whether it slips before it slides.
  bool gives_way() const {
    return creep_along != 0 || creep_across != 0 || slip_along_mps_per_n != 0 || slip_across_mps_per_n != 0;
  }
};

/// A support that is not driven: a fixed ball, or a wheel that swivels about an upright axis.
struct Caster {
  std::string link;
  Eigen::Vector3d centre_m =
      Eigen::Vector3d::Zero();  ///< of the ball or of the caster wheel, base frame, swivel angle 0
  double radius_m = 0;
  double friction = 0;  ///< of a fixed ball against the floor (a swivelling wheel has the floor's)
  bool swivels = false;
  // Swivelling casters only.
  Eigen::Vector3d swivel_point_m = Eigen::Vector3d::Zero();  ///< a point on the swivel axis, base frame
  Inertial fork;  ///< the swivelling part without its wheel; base frame at swivel angle 0
  double wheel_mass_kg = 0;
  double wheel_spin_inertia_kgm2 = 0;
  double wheel_transverse_inertia_kgm2 = 0;
  double swivel_friction_nm = 0;  ///< dry friction of the swivel bearing
  double bearing_creep = 0.05;    ///< share of the wheel's rolling rate; where it swivels slower, friction fades
  double initial_angle_rad = 0;   ///< of the swivel at the start of a run
  Slide slide;
  Suspension suspension;
};

/// A differential-drive robot as plain data: what the URDF says, reduced to the bodies that matter.
/// Everything fixed to the base (and passive links that do not touch the floor) is lumped into `base`.
struct RobotModel {
  std::string name;
  std::string urdf;             ///< file name without folders
  Inertial base;                ///< base frame
  std::array<Wheel, 2> wheels;  ///< left, right
  bool outside_shapes = false;  ///< the wheels' shapes are not in the URDF's collisions (sim/urdf/completed.h)
  std::vector<Caster> casters;

  double wheelbase_m() const { return (wheels[0].centre_m - wheels[1].centre_m).norm(); }
  double total_mass_kg() const;
};

/// Names of the drive joints where the URDF alone does not tell. Empty: find them.
struct DriveJoints {
  std::string left;
  std::string right;
};

/// The drive wheels where the URDF's collision shapes do not tell. 0: take it from the URDF.
struct WheelSize {
  double radius_m = 0;
  double width_m = 0;
};

/// What a reader of a URDF wants to be told of it.
struct Remark {
  enum class Kind {
    understood,  ///< found by geometry, against what names or habits suggest
    assumed,     ///< the file does not say it; something that hardly matters to a drive on the floor
    ignored,     ///< does not matter
  };
  Kind kind = Kind::understood;
  std::string text;
};

/// Reads a differential-drive URDF. Drive joints are those named, or the two continuous joints whose axes are
/// collinear (left is the one on the side of +y). A wheel is its collision cylinder or sphere, else of `size`, else
/// what bounds its mesh file, else its visual cylinder or sphere. Throws InputError naming file, link and joint: not a
/// URDF, a base or drive wheel without mass or with an impossible inertia, no wheel shape, two candidates for a wheel,
/// more than two drive wheels (skid steer), no third support. Flaws of light links that do not drive are completed, and
/// said in `remarks`.
RobotModel load_robot(const std::string& urdf_file, const DriveJoints& joints = {}, const WheelSize& size = {},
                      std::vector<Remark>* remarks = nullptr);

}  // namespace umbsim

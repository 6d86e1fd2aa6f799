#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <vector>

#include "sim/model/robot_model.h"

namespace umbsim {

/// Degrees of freedom that a robot may have: six of the base, two wheels, and two for each of four casters.
constexpr int kMaxDofs = 16;
using DofVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxDofs, 1>;
using DofMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMaxDofs, kMaxDofs>;

/// How the robot answers while both motors hold the wheels at their set-points. With e the two wheel columns of M^-1
/// and inertia = (e^T M^-1 e)^-1:
struct HeldMotors {
  DofMatrix inverse_mass;            ///< M^-1 - M^-1 e inertia e^T M^-1; the wheels' rows and columns are zero
  Eigen::Matrix<double, 8, 2> gain;  ///< M^-1 e inertia: change of u per change of wheel speed
  Eigen::Matrix2d inertia;           ///< impulse per change of wheel speed
};

/// One moving part beside the base: a drive wheel, a caster's fork, or a caster's wheel.
struct Joint {
  int parent = -1;          ///< index of the joint that carries this one; -1: the base
  Eigen::Vector3d pivot_m;  ///< base frame at zero joint angles
  Eigen::Vector3d axis;     ///< base frame at zero joint angles
};

/// Mass, its first moment and its inertia about a point that its owner names.
struct MassAbout {
  double mass_kg = 0;
  Eigen::Vector3d moment_kgm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_kgm2 = Eigen::Matrix3d::Zero();
};

/// A swivelling caster, fork and wheel, about a point of its swivel axis. Base frame.
struct SwivelLeg {
  int fork = 0;  ///< joints
  int wheel = 0;
  Eigen::Vector3d pivot_m;  ///< from the base's centre of mass
  MassAbout drawn;          ///< at swivel angle 0
  double spin_kgm2 = 0;     ///< of its wheel about the axle
  // As it is swung now.
  double cosine = 1, sine = 0;
  MassAbout now;
  Eigen::Vector3d axle = Eigen::Vector3d::UnitY();
};

/// The robot while both motors hold their set-points: unknown is what changes of the base's velocity (angular, then
/// linear, of its centre of mass) and, for each leg, of the rates of fork and wheel. Moments are about the base's
/// centre of mass, base frame.
struct HeldBody {
  MassAbout all;                   ///< with every joint locked
  Eigen::Vector3d turning_kgm2ps;  ///< change of momentum in the step without contacts, less what the wheels take of it
  Eigen::Vector3d pushing_kgmps;   ///< to get to their set speeds
  struct Leg {
    Eigen::Vector3d turning, pushing;  ///< momentum per rate of the fork
    Eigen::Vector3d spinning;          ///< angular momentum per rate of the wheel
    double fork_kgm2, wheel_kgm2;
    double fork_kgm2ps, wheel_kgm2ps;  ///< change of momentum along each joint in the step without contacts
  } leg[6];
  int legs = 0;
  int wheel_leg[2] = {-1, -1};  ///< of drive wheels that their motors do not hold: legs without a fork
};

/// The robot as a Bullet btMultiBody, seen in base-frame coordinates.
/// A velocity vector u is (base angular velocity, velocity of the base's centre of mass, joint speeds), the first two
/// resolved in the base frame.
class MultiBody {
 public:
  explicit MultiBody(const RobotModel& robot);

  /// World frame.
  void set_gravity(const Eigen::Vector3d& gravity_mps2);

  int dofs() const { return 6 + int(joints_.size()); }
  const std::vector<Joint>& joints() const { return joints_; }

  /// Joints 0 and 1 are the left and right drive wheel; caster i's fork and wheel follow for swivelling casters.
  int caster_wheel_joint(int caster) const { return caster_wheel_joint_[caster]; }

  void set_pose(const Eigen::Quaterniond& q_WB, const Eigen::Vector3d& p_WB);
  const Eigen::Quaterniond& orientation() const { return q_WB_; }
  const Eigen::Matrix3d& rotation() const { return R_WB_; }
  const Eigen::Vector3d& position() const { return p_WB_; }
  double joint_angle(int joint) const { return angle_rad_[joint]; }
  void set_joint_angle(int joint, double angle_rad) {
    angle_rad_[joint] = angle_rad;
    swing_legs();
  }
  const DofVector& velocity() const { return u_; }
  void set_velocity(const DofVector& u) { u_ = u; }
  void change_velocity(const Eigen::Vector3d& turning_radps, const Eigen::Vector3d& moving_mps,
                       const std::array<double, 2>& wheel_radps) {
    u_.head<3>() += turning_radps;
    u_.segment<3>(3) += moving_mps;
    u_[6] = wheel_radps[0];
    u_[7] = wheel_radps[1];
  }

  /// Velocity after `step_s` under gravity and gyroscopic forces, without contacts and motors: Bullet's
  /// articulated-body algorithm. Where no caster swivels, the same from Bullet's inverse mass matrix and the gyroscopic
  /// terms of bodies of revolution in closed form (equal to round-off, and seven times faster).
  DofVector free_velocity(double step_s);
  DofVector free_velocity_articulated(double step_s);

  /// How momentum changes in `step_s` under gravity and gyroscopic forces while the motors hold `target_radps`, and the
  /// masses that carry it (sim/dynamics/held_body.cpp): the equations of motion of the same tree in closed form, for
  /// sim/rolling.cpp. `free`: wheels that are not held.
  HeldBody held(double step_s, const std::array<double, 2>& target_radps, const std::array<bool, 2>& free) const;
  /// The same of base and held drive wheels alone.
  struct Momentum {
    Eigen::Vector3d turning_kgm2ps, pushing_kgmps;
  };
  Momentum held_momentum(double step_s, const std::array<double, 2>& target_radps,
                         const std::array<bool, 2>& free = {}) const;
  /// Base and drive wheels with every joint locked.
  const MassAbout& locked() const { return locked_; }
  const std::vector<SwivelLeg>& legs() const { return legs_; }
  const Eigen::Vector3d& centre_of_mass() const { return com_B_; }  ///< of the base

  /// M^-1, (dofs, dofs), for the same coordinates. Constant, hence computed once, where no caster swivels: the
  /// drive wheels are bodies of revolution.
  const DofMatrix& inverse_mass();
  /// nullptr where casters swivel.
  const HeldMotors* held_motors() const { return constant_mass_ ? &held_ : nullptr; }

  /// Moves pose and joints for `step_s` with the current velocity, constant in the base frame (the exponential map of
  /// SE(3): arcs come out as arcs). Afterwards the velocity is the same vector in the world, seen from the turned base.
  void integrate(double step_s);

  /// How a material point of the part behind `joint` (-1: the base) moves, base frame: what the Jacobian's rows for all
  /// directions have in common.
  struct Lever {
    Eigen::Vector3d arm_m;  ///< from the base's centre of mass
    int joints = 0;
    int joint[2];               ///< that move the point
    Eigen::Vector3d turn_m[2];  ///< velocity of the point per joint speed
  };
  /// `shift_m`: how far the suspension carries the part, point and axle together, from where its joint is in the model.
  Lever lever(int joint, const Eigen::Vector3d& point_m,
              const Eigen::Vector3d& shift_m = Eigen::Vector3d::Zero()) const;
  void jacobian(const Lever& lever, const Eigen::Vector3d& direction, DofVector& row) const;

  /// Row of the contact Jacobian: velocity along `direction` of the material point `point_m` of the part behind
  /// `joint` (-1: the base). All in the base frame.
  void jacobian(int joint, const Eigen::Vector3d& point_m, const Eigen::Vector3d& direction, DofVector& row) const {
    jacobian(lever(joint, point_m), direction, row);
  }

  /// Current pivot and axis of a joint in the base frame.
  Joint current(int joint) const { return joints_[joint].parent < 0 ? joints_[joint] : swung(joints_[joint]); }
  double energy();

 private:
  struct Part;
  Joint swung(Joint joint) const;
  void add_up_masses();
  void swing_legs();
  void add_leg(const SwivelLeg& leg, double step_s, HeldBody& held) const;
  int add_part(const Part& part, int parent, const Joint& hinge);
  void build_wheels(const RobotModel& robot);
  void build_casters(const RobotModel& robot);
  void compute_inverse_mass();
  void compute_held_motors();
  void to_bullet_state();
  Eigen::Matrix<double, 6, 1> gyroscopic_and_weight() const;

  std::vector<Joint> joints_;
  std::vector<int> caster_wheel_joint_;
  RobotModel robot_;
  std::vector<double> link_mass_;
  std::vector<Eigen::Matrix3d> part_R_BL_;
  std::vector<Eigen::Vector3d> part_com_m_;
  std::unique_ptr<btMultiBody> body_;
  Eigen::Matrix3d R_BK_;  ///< principal axes K of the base, Bullet's base frame
  Eigen::Vector3d com_B_;
  MassAbout locked_;  ///< base and drive wheels, about the base's centre of mass
  std::vector<SwivelLeg> legs_;
  Eigen::Vector3d gravity_mps2_ = Eigen::Vector3d::Zero();
  bool constant_mass_ = true;
  DofMatrix inverse_mass_;
  HeldMotors held_;

  Eigen::Quaterniond q_WB_ = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d R_WB_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_WB_ = Eigen::Vector3d::Zero();
  double angle_rad_[kMaxDofs]{};
  DofVector u_;

  btAlignedObjectArray<btScalar> scratch_r_;
  btAlignedObjectArray<btVector3> scratch_v_;
  btAlignedObjectArray<btMatrix3x3> scratch_m_;
};

}  // namespace umbsim

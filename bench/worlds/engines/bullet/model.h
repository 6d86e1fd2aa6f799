#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/Featherstone/btMultiBodyMLCPConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <btBulletDynamicsCommon.h>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <vector>

#include "bench/worlds/engines/bullet/options.h"
#include "effects/rig.h"

namespace umbsim::worlds::bullet {

/// A wheel's contact as Bullet takes it: coefficients of sliding, and of turning and rolling in metres.
struct Grip {
  double sliding = 0;
  double spinning_m = 0;
  double rolling_m = 0;
};
Grip grip(const Wheel& wheel, const BulletOptions& options, double friction);

/// A rig as Bullet's objects, in a world of its own. The multibody's frame is the one of the base's principal axes, in
/// its centre of mass, as Bullet wants it. Links: wheels 0 and 1, then balls, forks and caster wheels.
class Model {
 public:
  Model(const Rig& rig, const BulletOptions& options);
  ~Model();
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// Sets the axle's middle down here, at rest.
  void place(const Eigen::Isometry3d& X_WR);
  Eigen::Isometry3d pose() const;  ///< of the axle's middle
  void set_motor(int wheel, double radps, double impulse_nms);
  void set_swivel_friction(double step_s);
  /// Shapes of the wheels anew, for tyres under load.
  void set_radius(int wheel, double radius_m);
  void set_grip(int wheel, const Grip& grip);
  double load_n(int wheel, double step_s) const;

  btMultiBodyDynamicsWorld& world() { return world_; }
  btMultiBody& body() { return *body_; }
  const btMultiBody& body() const { return *body_; }
  Eigen::Vector3d wheel_at(int wheel) const;

 private:
  struct Swivel {
    std::unique_ptr<btMultiBodyJointMotor> bearing;
    double friction_nm = 0;
  };

  btMultiBodyConstraintSolver* solver();
  void add_static(std::unique_ptr<btCollisionShape> shape, const btTransform& pose);
  void add_floor();
  void add_robot();
  void add_wheel(int link);
  void add_ball(int link, const Caster& caster);
  void add_swivel(int link, const Caster& caster);
  std::unique_ptr<btCollisionShape> wheel_shape(int wheel, double radius_m);
  btMultiBodyLinkCollider& add_collider(int link, std::unique_ptr<btCollisionShape> shape, double friction);
  btVector3 in_body(const Eigen::Vector3d& base) const;
  void update();

  Rig rig_;
  BulletOptions options_;
  Eigen::Matrix3d R_BP_ = Eigen::Matrix3d::Identity();  // principal axes in the base frame
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver sequential_;
  btDantzigSolver dantzig_;
  btMultiBodyMLCPConstraintSolver direct_{&dantzig_};
  btMultiBodyDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> static_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::unique_ptr<btMultiBody> body_;
  std::array<std::unique_ptr<btMultiBodyJointMotor>, 2> motors_;
  std::vector<Swivel> swivels_;
};

}  // namespace umbsim::worlds::bullet

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/Featherstone/btMultiBodyMLCPConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <vector>

#include "bench/speed/engine.h"

namespace umbsim::bench {
namespace {

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

class StockBullet : public Engine {
 public:
  StockBullet(const Setup& setup, const StockBulletOptions& options)
      : setup_(setup), options_(options), dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, solver(), &configuration_) {
    world_.setGravity({0, 0, -9.81});
    world_.getSolverInfo().m_numIterations = options.iterations;
    if (options.solver == "direct") world_.getSolverInfo().m_globalCfm = 1e-7;  // else its matrix is singular
    add_floor();
    add_robot();
  }

  ~StockBullet() override {
    for (auto& motor : motors_) world_.removeMultiBodyConstraint(motor.get());
    world_.removeMultiBody(body_.get());
    for (auto& object : static_) world_.removeRigidBody(object.get());
    for (auto& collider : colliders_) world_.removeCollisionObject(collider.get());
  }

  void place() override {
    command(0, 0);
    for (int i = 0; i < 500; ++i) step();
    for (int i = 0; i < 2; ++i) zero_[i] = body_->getJointPos(i);
    steps_ = 0;
  }

  void command(double left_radps, double right_radps) override {
    target_[0] = left_radps;
    target_[1] = right_radps;
  }

  void advance(double duration_s) override {
    const int n = int(std::lround(duration_s / setup_.step_s));
    for (int k = 1; k <= n; ++k) {
      for (int i = 0; i < 2; ++i) {
        motors_[i]->setVelocityTarget(last_[i] + (target_[i] - last_[i]) * k / n);
      }
      step();
    }
    last_[0] = target_[0];
    last_[1] = target_[1];
  }

  Pose2 pose() const override {
    const btTransform t = body_->getBaseWorldTransform();
    const btVector3 axle = t * to_bullet(-setup_.robot.base.com_m);
    const btVector3 ahead = t.getBasis().getColumn(0);
    const double heading = std::atan2(ahead.y(), ahead.x());
    heading_ += wrap_angle(heading - heading_);
    return {axle.x(), axle.y(), heading_};
  }
  double wheel_angle(int wheel) const override { return body_->getJointPos(wheel) - zero_[wheel]; }
  std::int64_t steps() const override { return steps_; }

 private:
  btMultiBodyConstraintSolver* solver() {
    if (options_.solver == "direct") return &direct_;
    return &sequential_;
  }

  void step() {
    world_.stepSimulation(setup_.step_s, 0);
    ++steps_;
    pose();
  }

  void add_static(std::unique_ptr<btCollisionShape> shape, const btTransform& pose) {
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape.get());
    info.m_startWorldTransform = pose;
    info.m_friction = setup_.floor.friction;
    static_.push_back(std::make_unique<btRigidBody>(info));
    shapes_.push_back(std::move(shape));
    world_.addRigidBody(static_.back().get(), btBroadphaseProxy::StaticFilter, btBroadphaseProxy::DefaultFilter);
  }

  void add_floor() {
    add_static(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0), btTransform::getIdentity());
    for (const Cable& c : setup_.floor.cables) {
      const btQuaternion turn(btVector3(0, 0, 1), c.direction_rad - M_PI / 2);  // cylinder along y
      add_static(std::make_unique<btCylinderShape>(btVector3(c.height_m / 2, c.length_m / 2, c.height_m / 2)),
                 btTransform(turn, {c.x_m, c.y_m, c.height_m / 2}));
    }
  }

  void add_collider(int link, std::unique_ptr<btCollisionShape> shape, double friction) {
    auto collider = std::make_unique<btMultiBodyLinkCollider>(body_.get(), link);
    collider->setCollisionShape(shape.get());
    collider->setFriction(friction);
    world_.addCollisionObject(collider.get(), btBroadphaseProxy::DefaultFilter,
                              btBroadphaseProxy::StaticFilter);
    if (link < 0) body_->setBaseCollider(collider.get());
    else body_->getLink(link).m_collider = collider.get();
    colliders_.push_back(std::move(collider));
    shapes_.push_back(std::move(shape));
  }

  std::unique_ptr<btCollisionShape> wheel_shape(const Wheel& w) const {
    if (options_.wheel == "sphere") return std::make_unique<btSphereShape>(w.radius_m);
    return std::make_unique<btCylinderShape>(btVector3(w.radius_m, w.width_m / 2, w.radius_m));
  }

  void add_robot() {
    const RobotModel& r = setup_.robot;
    body_ = std::make_unique<btMultiBody>(2, r.base.mass_kg, to_bullet(r.base.inertia_kgm2.diagonal()), false, false);
    for (int i = 0; i < 2; ++i) {
      const Wheel& w = r.wheels[i];
      body_->setupRevolute(i, w.mass_kg, {w.transverse_inertia_kgm2, w.spin_inertia_kgm2, w.transverse_inertia_kgm2},
                           -1, btQuaternion::getIdentity(), {0, 1, 0}, to_bullet(w.centre_m - r.base.com_m), {0, 0, 0},
                           true);
    }
    body_->finalizeMultiDof();
    body_->setLinearDamping(0);
    body_->setAngularDamping(0);
    body_->setBaseWorldTransform(
        btTransform(btQuaternion::getIdentity(), to_bullet(r.base.com_m) + btVector3(0, 0, r.wheels[0].radius_m)));
    world_.addMultiBody(body_.get());
    for (int i = 0; i < 2; ++i) {
      add_collider(i, wheel_shape(r.wheels[i]), 1);
    }
    auto ball = std::make_unique<btSphereShape>(r.casters[0].radius_m);
    auto placed = std::make_unique<btCompoundShape>();
    placed->addChildShape(btTransform(btQuaternion::getIdentity(), to_bullet(r.casters[0].centre_m - r.base.com_m)),
                          ball.get());
    shapes_.push_back(std::move(ball));
    add_collider(-1, std::move(placed), 0);
    for (int i = 0; i < 2; ++i) {
      motors_.push_back(std::make_unique<btMultiBodyJointMotor>(body_.get(), i, 0, setup_.torque_limit_nm));
      motors_.back()->setMaxAppliedImpulse(setup_.torque_limit_nm * setup_.step_s);
      world_.addMultiBodyConstraint(motors_.back().get());
    }
    btAlignedObjectArray<btQuaternion> q;
    btAlignedObjectArray<btVector3> o;
    body_->forwardKinematics(q, o);
    body_->updateCollisionObjectWorldTransforms(q, o);
  }

  Setup setup_;
  StockBulletOptions options_;
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
  std::vector<std::unique_ptr<btMultiBodyJointMotor>> motors_;
  double target_[2] = {0, 0};
  double last_[2] = {0, 0};
  double zero_[2] = {0, 0};
  mutable double heading_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_stock_bullet(const Setup& setup, const StockBulletOptions& options) {
  return std::make_unique<StockBullet>(setup, options);
}

}  // namespace umbsim::bench

#include "bench/worlds/engines/bullet/model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace umbsim::worlds::bullet {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr double kThinnest_m = 0.002;  // of a wheel that has no patch
constexpr double kBallShare = 0.001;   // of the base's mass: no link is without
constexpr double kRegular = 1e-7;      // the direct solver's matrix is singular without

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

btQuaternion to_bullet(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}

Eigen::Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// A line of width w and uniform pressure resists turning on the spot like two points w / 2 apart.
double half_width_m(const Wheel& w) { return std::max(w.patch_width_m / 2, kThinnest_m) / 2; }

bool has_edges(const BulletOptions& o) { return o.wheel != "sphere"; }

double margin_m(const Wheel& w) { return std::min(0.001, half_width_m(w) / 2); }

// About y, with its edges on a circle of this radius. Bullet's margin lies outside a hull.
std::unique_ptr<btCollisionShape> prism(double rim_m, double half_m, double margin_m, int sides) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(margin_m);
  const double radius_m = rim_m - margin_m;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * M_PI * k / sides;
    for (const double y_m : {-half_m, half_m}) {
      hull->addPoint({radius_m * std::cos(angle), y_m, radius_m * std::sin(angle)}, false);
    }
  }
  hull->recalcLocalAabb();
  return hull;
}

// The rim's centre in the frame of the wheel: effects say where it points at wheel angle 0.
btVector3 rim_centre(const Wheel& w) {
  return w.eccentricity_m * btVector3(std::cos(w.eccentricity_rad), 0, -std::sin(w.eccentricity_rad));
}

}  // namespace

Grip grip(const Wheel& wheel, const BulletOptions& o, double friction) {
  const double patch_m = has_edges(o) ? 0 : wheel.patch_width_m / 4;
  return {friction, friction * (o.torsion_m + patch_m), friction * o.rolling_m};
}

Model::Model(const Rig& rig, const BulletOptions& options)
    : rig_(rig),
      options_(options),
      dispatcher_(&configuration_),
      world_(&dispatcher_, &broadphase_, solver(), &configuration_) {
  const double down = std::sin(rig.floor.slope_rad) * kGravity_mps2;
  world_.setGravity({down * std::cos(rig.floor.downhill_rad), down * std::sin(rig.floor.downhill_rad),
                     -std::cos(rig.floor.slope_rad) * kGravity_mps2});
  world_.getSolverInfo().m_numIterations = options.iterations;
  world_.getSolverInfo().m_erp = world_.getSolverInfo().m_erp2 = options.erp;
  if (options.solver == "dantzig") world_.getSolverInfo().m_globalCfm = kRegular;
  add_floor();
  add_robot();
}

Model::~Model() {
  for (auto& motor : motors_)
    if (motor) world_.removeMultiBodyConstraint(motor.get());
  for (Swivel& s : swivels_) world_.removeMultiBodyConstraint(s.bearing.get());
  world_.removeMultiBody(body_.get());
  for (auto& object : static_) world_.removeRigidBody(object.get());
  for (auto& collider : colliders_) world_.removeCollisionObject(collider.get());
}

btMultiBodyConstraintSolver* Model::solver() {
  if (options_.solver == "dantzig") return &direct_;
  return &sequential_;
}

btVector3 Model::in_body(const Eigen::Vector3d& base) const {
  return to_bullet(Eigen::Vector3d(R_BP_.transpose() * (base - rig_.robot.base.com_m)));
}

void Model::add_static(std::unique_ptr<btCollisionShape> shape, const btTransform& pose) {
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape.get());
  info.m_startWorldTransform = pose;
  info.m_friction = 1;  // the product of both counts: supports have the floor's
  static_.push_back(std::make_unique<btRigidBody>(info));
  shapes_.push_back(std::move(shape));
  world_.addRigidBody(static_.back().get(), btBroadphaseProxy::StaticFilter, btBroadphaseProxy::DefaultFilter);
}

void Model::add_floor() {
  add_static(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0), btTransform::getIdentity());
  for (const Cable& c : rig_.floor.cables) {
    const btQuaternion turn(btVector3(0, 0, 1), c.direction_rad - M_PI / 2);  // cylinder along y
    add_static(std::make_unique<btCylinderShape>(btVector3(c.height_m / 2, c.length_m / 2, c.height_m / 2)),
               btTransform(turn, {c.x_m, c.y_m, c.height_m / 2}));
  }
}

btMultiBodyLinkCollider& Model::add_collider(int link, std::unique_ptr<btCollisionShape> shape, double friction) {
  auto collider = std::make_unique<btMultiBodyLinkCollider>(body_.get(), link);
  collider->setCollisionShape(shape.get());
  collider->setFriction(friction);
  world_.addCollisionObject(collider.get(), btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::StaticFilter);
  body_->getLink(link).m_collider = collider.get();
  shapes_.push_back(std::move(shape));
  colliders_.push_back(std::move(collider));
  return *colliders_.back();
}

std::unique_ptr<btCollisionShape> Model::wheel_shape(int wheel, double radius_m) {
  const Wheel& w = rig_.robot.wheels[std::size_t(wheel)];
  std::unique_ptr<btCollisionShape> tyre;
  if (options_.wheel == "sphere") {
    tyre = std::make_unique<btSphereShape>(radius_m);
  } else if (options_.wheel == "convex") {
    tyre = prism(radius_m, half_width_m(w) - margin_m(w), margin_m(w), options_.sides);
  } else {
    tyre = std::make_unique<btCylinderShape>(btVector3(radius_m, half_width_m(w), radius_m));
    tyre->setMargin(margin_m(w));
  }
  if (w.eccentricity_m == 0) return tyre;
  auto placed = std::make_unique<btCompoundShape>();
  placed->addChildShape(btTransform(btQuaternion::getIdentity(), rim_centre(w)), tyre.get());
  shapes_.push_back(std::move(tyre));
  return placed;
}

void Model::add_robot() {
  const RobotModel& r = rig_.robot;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(r.base.inertia_kgm2);
  R_BP_ = principal.eigenvectors();
  if (R_BP_.determinant() < 0) R_BP_.col(0) *= -1;
  int links = 2;
  double balls = 0;
  for (const Caster& c : r.casters) {
    links += c.swivels ? 2 : 1;
    balls += c.swivels ? 0 : 1;
  }
  body_ = std::make_unique<btMultiBody>(links, r.base.mass_kg * (1 - kBallShare * balls),
                                        to_bullet(Eigen::Vector3d(principal.eigenvalues())), false, false);
  for (int i = 0; i < 2; ++i) {
    const Wheel& w = r.wheels[std::size_t(i)];
    const Eigen::AngleAxisd toe(std::atan2(-w.axis.x(), w.axis.y()), Eigen::Vector3d::UnitZ());
    const Eigen::Matrix3d R_WP = toe.toRotationMatrix().transpose() * R_BP_;  // from the body's axes to the wheel's
    body_->setupRevolute(i, w.mass_kg, {w.transverse_inertia_kgm2, w.spin_inertia_kgm2, w.transverse_inertia_kgm2}, -1,
                         to_bullet(R_WP), {0, 1, 0}, in_body(w.centre_m), {0, 0, 0}, true);
  }
  int link = 2;
  for (const Caster& c : r.casters) {
    if (!c.swivels) {
      const double kg = kBallShare * r.base.mass_kg, kgm2 = 0.4 * kg * c.radius_m * c.radius_m;
      body_->setupFixed(link++, kg, {kgm2, kgm2, kgm2}, -1, to_bullet(R_BP_), in_body(c.centre_m), {0, 0, 0});
      continue;
    }
    const Eigen::Vector3d fork = c.fork.inertia_kgm2.diagonal();
    body_->setupRevolute(link, c.fork.mass_kg, to_bullet(fork), -1, to_bullet(R_BP_), {0, 0, 1},
                         in_body(c.swivel_point_m), to_bullet(Eigen::Vector3d(c.fork.com_m - c.swivel_point_m)), true);
    body_->setupRevolute(link + 1, c.wheel_mass_kg,
                         {c.wheel_transverse_inertia_kgm2, c.wheel_spin_inertia_kgm2, c.wheel_transverse_inertia_kgm2},
                         link, btQuaternion::getIdentity(), {0, 1, 0},
                         to_bullet(Eigen::Vector3d(c.centre_m - c.fork.com_m)), {0, 0, 0}, true);
    link += 2;
  }
  body_->finalizeMultiDof();
  body_->setLinearDamping(options_.body_damping);
  body_->setAngularDamping(options_.body_damping);
  world_.addMultiBody(body_.get());
  for (int i = 0; i < 2; ++i) add_wheel(i);
  link = 2;
  for (const Caster& c : r.casters) {
    if (c.swivels)
      add_swivel(link, c);
    else
      add_ball(link, c);
    link += c.swivels ? 2 : 1;
  }
}

void Model::add_wheel(int i) {
  add_collider(i, wheel_shape(i, rig_.robot.wheels[std::size_t(i)].radius_m), 0);
  set_grip(i, grip(rig_.robot.wheels[std::size_t(i)], options_, rig_.floor.friction));
  if (rig_.drivetrain.motor[std::size_t(i)].torque_limit_nm <= 0) return;  // it runs free
  motors_[std::size_t(i)] = std::make_unique<btMultiBodyJointMotor>(body_.get(), i, 0, 0);
  world_.addMultiBodyConstraint(motors_[std::size_t(i)].get());
}

void Model::add_ball(int link, const Caster& c) {
  add_collider(link, std::make_unique<btSphereShape>(c.radius_m), c.friction);
}

void Model::add_swivel(int link, const Caster& c) {
  body_->setJointPos(link, c.initial_angle_rad);
  swivels_.push_back({std::make_unique<btMultiBodyJointMotor>(body_.get(), link, 0, 0), c.swivel_friction_nm});
  world_.addMultiBodyConstraint(swivels_.back().bearing.get());
  add_collider(link + 1, std::make_unique<btSphereShape>(c.radius_m), rig_.floor.friction);
}

void Model::place(const Eigen::Isometry3d& X_WR) {
  const Eigen::Matrix3d R_WP = X_WR.linear() * R_BP_;
  body_->setBaseWorldTransform(btTransform(to_bullet(R_WP), to_bullet(Eigen::Vector3d(X_WR * rig_.robot.base.com_m))));
  update();
}

Eigen::Isometry3d Model::pose() const {
  const btTransform t = body_->getBaseWorldTransform();
  const btQuaternion q = t.getRotation();
  Eigen::Isometry3d X_WR(Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()) * Eigen::Quaterniond(R_BP_).conjugate());
  X_WR.translation() = from_bullet(t.getOrigin()) - X_WR.linear() * rig_.robot.base.com_m;
  return X_WR;
}

void Model::update() {
  btAlignedObjectArray<btQuaternion> q;
  btAlignedObjectArray<btVector3> o;
  body_->forwardKinematics(q, o);
  body_->updateCollisionObjectWorldTransforms(q, o);
}

void Model::set_motor(int wheel, double radps, double impulse_nms) {
  btMultiBodyJointMotor* motor = motors_[std::size_t(wheel)].get();
  if (!motor) return;
  motor->setVelocityTarget(radps, options_.velocity_gain);
  motor->setMaxAppliedImpulse(impulse_nms);
}

void Model::set_swivel_friction(double step_s) {
  for (Swivel& s : swivels_) s.bearing->setMaxAppliedImpulse(s.friction_nm * step_s);
}

void Model::set_radius(int wheel, double radius_m) {
  auto shape = wheel_shape(wheel, radius_m);
  btCollisionObject* collider = body_->getLink(wheel).m_collider;
  world_.getBroadphase()->getOverlappingPairCache()->cleanProxyFromPairs(collider->getBroadphaseHandle(), &dispatcher_);
  collider->setCollisionShape(shape.get());
  shapes_.push_back(std::move(shape));
}

void Model::set_grip(int wheel, const Grip& g) {
  btCollisionObject* collider = body_->getLink(wheel).m_collider;
  collider->setFriction(g.sliding);
  collider->setSpinningFriction(g.spinning_m);
  collider->setRollingFriction(g.rolling_m);
}

double Model::load_n(int wheel, double step_s) const {
  const btCollisionObject* collider = body_->getLink(wheel).m_collider;
  double impulse = 0;
  const btDispatcher* dispatcher = world_.getDispatcher();
  for (int m = 0; m < dispatcher->getNumManifolds(); ++m) {
    const btPersistentManifold* manifold = const_cast<btDispatcher*>(dispatcher)->getManifoldByIndexInternal(m);
    if (manifold->getBody0() != collider && manifold->getBody1() != collider) continue;
    for (int c = 0; c < manifold->getNumContacts(); ++c) impulse += manifold->getContactPoint(c).getAppliedImpulse();
  }
  return impulse / step_s;
}

Eigen::Vector3d Model::wheel_at(int wheel) const {
  return from_bullet(body_->getLink(wheel).m_collider->getWorldTransform().getOrigin());
}

}  // namespace umbsim::worlds::bullet

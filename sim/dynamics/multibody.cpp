#include "sim/dynamics/multibody.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion to_bullet(const Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// sin(x/2)/x, cos(x/2), (1-cos x)/x^2 and (x - sin x)/x^3 of x = |turn|, from x^2.
struct TurnSeries {
  double half_sine, half_cosine, a, b;

  explicit TurnSeries(double x2) {
    if (x2 < 0.01) {  // the next terms are below 1e-16
      half_sine = 0.5 * (1 - x2 / 24 * (1 - x2 / 80 * (1 - x2 / 168)));
      half_cosine = 1 - x2 / 8 * (1 - x2 / 48 * (1 - x2 / 120 * (1 - x2 / 224)));
      a = 0.5 * (1 - x2 / 12 * (1 - x2 / 30 * (1 - x2 / 56)));
      b = 1.0 / 6 * (1 - x2 / 20 * (1 - x2 / 42 * (1 - x2 / 72)));
      return;
    }
    const double x = std::sqrt(x2);
    half_sine = std::sin(x / 2) / x;
    half_cosine = std::cos(x / 2);
    a = (1 - std::cos(x)) / x2;
    b = (x - std::sin(x)) / (x2 * x);
  }
};

// A right-handed frame whose y axis is `axis`.
Matrix3d frame_about(const Vector3d& axis) {
  Matrix3d R;
  R.col(1) = axis;
  R.col(2) = axis.cross(axis.unitOrthogonal()).normalized();
  R.col(0) = R.col(1).cross(R.col(2));
  return R;
}

Matrix3d principal_axes(const Matrix3d& inertia) {
  const Matrix3d off = inertia - Matrix3d(inertia.diagonal().asDiagonal());
  if (off.cwiseAbs().maxCoeff() < 1e-12 * inertia.trace()) return Matrix3d::Identity();
  Matrix3d R = Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia).eigenvectors();
  if (R.determinant() < 0) R.col(0) *= -1;
  return R;
}

}  // namespace

// A body on its way into Bullet: its principal frame L and centre of mass, seen from the base frame.
struct MultiBody::Part {
  int link = -1;
  double mass_kg = 0;
  Vector3d com_m = Vector3d::Zero();
  Matrix3d R_BL = Matrix3d::Identity();
  Vector3d moments_kgm2 = Vector3d::Zero();

  static Part of(const Inertial& inertial) {
    const Matrix3d R = principal_axes(inertial.inertia_kgm2);
    return {-1, inertial.mass_kg, inertial.com_m, R, (R.transpose() * inertial.inertia_kgm2 * R).diagonal()};
  }
  static Part wheel(double mass_kg, const Vector3d& centre_m, const Vector3d& axis, double spin_kgm2,
                    double transverse_kgm2) {
    return {-1, mass_kg, centre_m, frame_about(axis), {transverse_kgm2, spin_kgm2, transverse_kgm2}};
  }
};

MultiBody::MultiBody(const RobotModel& robot) : robot_(robot) {
  int links = 2;
  for (const Caster& caster : robot.casters) links += caster.swivels ? 2 : 0;
  constant_mass_ = links == 2;

  const Part base = Part::of(robot.base);
  R_BK_ = base.R_BL;
  com_B_ = base.com_m;
  body_ = std::make_unique<btMultiBody>(links, base.mass_kg, to_bullet(base.moments_kgm2), false, false);
  build_wheels(robot);
  build_casters(robot);
  body_->finalizeMultiDof();
  body_->setLinearDamping(0);
  body_->setAngularDamping(0);
  body_->setUseGyroTerm(true);
  body_->setMaxCoordinateVelocity(1e6);
  inverse_mass_.resize(dofs(), dofs());
  u_ = DofVector::Zero(dofs());
  set_pose(Quaterniond::Identity(), Vector3d::Zero());
  add_up_masses();
  if (!constant_mass_) return;
  compute_inverse_mass();
  compute_held_motors();
}

void MultiBody::set_gravity(const Vector3d& gravity_mps2) {
  gravity_mps2_ = gravity_mps2;
  body_->clearForcesAndTorques();
  body_->addBaseForce(to_bullet(gravity_mps2 * robot_.base.mass_kg));
  for (std::size_t i = 0; i < joints_.size(); ++i) body_->addLinkForce(int(i), to_bullet(gravity_mps2 * link_mass_[i]));
}

void MultiBody::build_wheels(const RobotModel& robot) {
  for (const Wheel& w : robot.wheels) {
    add_part(Part::wheel(w.mass_kg, w.centre_m, w.axis, w.spin_inertia_kgm2, w.transverse_inertia_kgm2), -1,
             {-1, w.centre_m, w.axis});
  }
}

void MultiBody::build_casters(const RobotModel& robot) {
  for (const Caster& c : robot.casters) {
    if (!c.swivels) {
      caster_wheel_joint_.push_back(-1);
      continue;
    }
    const int fork = add_part(Part::of(c.fork), -1, {-1, c.swivel_point_m, Vector3d::UnitZ()});
    const int wheel = add_part(Part::wheel(c.wheel_mass_kg, c.centre_m, Vector3d::UnitY(), c.wheel_spin_inertia_kgm2,
                                           c.wheel_transverse_inertia_kgm2),
                               fork, {fork, c.centre_m, Vector3d::UnitY()});
    caster_wheel_joint_.push_back(wheel);
  }
}

int MultiBody::add_part(const Part& part, int parent, const Joint& hinge) {
  const int link = int(joints_.size());
  const Matrix3d R_BP = parent < 0 ? R_BK_ : part_R_BL_[parent];
  const Vector3d parent_com_m = parent < 0 ? com_B_ : part_com_m_[parent];
  const Matrix3d R_LB = part.R_BL.transpose();
  body_->setupRevolute(link, part.mass_kg, to_bullet(part.moments_kgm2), parent,
                       to_bullet(Quaterniond(Matrix3d(R_LB * R_BP))), to_bullet(R_LB * hinge.axis),
                       to_bullet(R_BP.transpose() * (hinge.pivot_m - parent_com_m)),
                       to_bullet(R_LB * (part.com_m - hinge.pivot_m)), true);
  joints_.push_back(hinge);
  link_mass_.push_back(part.mass_kg);
  part_R_BL_.push_back(part.R_BL);
  part_com_m_.push_back(part.com_m);
  return link;
}

void MultiBody::set_pose(const Quaterniond& q_WB, const Vector3d& p_WB) {
  q_WB_ = q_WB.normalized();
  R_WB_ = q_WB_.toRotationMatrix();
  p_WB_ = p_WB;
}

void MultiBody::to_bullet_state() {
  body_->setBasePos(to_bullet(p_WB_ + R_WB_ * com_B_));
  body_->setWorldToBaseRot(to_bullet((q_WB_ * Quaterniond(R_BK_)).conjugate()));
  body_->setBaseOmega(to_bullet(R_WB_ * u_.head<3>()));
  body_->setBaseVel(to_bullet(R_WB_ * u_.segment<3>(3)));
  for (int j = 0; j < int(joints_.size()); ++j) {
    body_->setJointPos(j, angle_rad_[j]);
    body_->setJointVel(j, u_[6 + j]);
  }
}

DofVector MultiBody::free_velocity(double step_s) {
  if (!constant_mass_) return free_velocity_articulated(step_s);
  const Eigen::Matrix<double, 6, 1> impulse = step_s * gyroscopic_and_weight();
  const Eigen::Map<const Eigen::Matrix<double, 8, 8>> M_inverse(inverse_mass_.data());  // symmetric
  DofVector u(8);
  u.head<8>() = u_.head<8>() + M_inverse.leftCols<6>().lazyProduct(impulse);
  return u;
}

DofVector MultiBody::free_velocity_articulated(double step_s) {
  to_bullet_state();
  body_->computeAccelerationsArticulatedBodyAlgorithmMultiDof(step_s, scratch_r_, scratch_v_, scratch_m_, false, false,
                                                              false);
  DofVector u(dofs());
  u.head<3>() = R_WB_.transpose() * to_eigen(body_->getBaseOmega());
  u.segment<3>(3) = R_WB_.transpose() * to_eigen(body_->getBaseVel());
  for (int j = 0; j < int(joints_.size()); ++j) u[6 + j] = body_->getJointVel(j);
  return u;
}

// Generalised forces at the base's centre of mass, base frame: weight, and the inertia forces of a turning base with
// spinning wheels, -w x (I w) and -m w x (w x r). A body of revolution feels none about its own axis.
Eigen::Matrix<double, 6, 1> MultiBody::gyroscopic_and_weight() const {
  const Vector3d w = u_.head<3>();
  const Vector3d gravity = R_WB_.transpose() * gravity_mps2_;
  Vector3d torque = -w.cross(robot_.base.inertia_kgm2 * w);
  Vector3d force = robot_.base.mass_kg * gravity;
  for (int i = 0; i < 2; ++i) {
    const Wheel& wheel = robot_.wheels[i];
    const Vector3d r = wheel.centre_m - com_B_;
    const Vector3d pull = wheel.mass_kg * (gravity - w.cross(w.cross(r)));
    const double spin = wheel.spin_inertia_kgm2 * u_[6 + i] +
                        (wheel.spin_inertia_kgm2 - wheel.transverse_inertia_kgm2) * wheel.axis.dot(w);
    force += pull;
    torque += r.cross(pull) - w.cross(wheel.axis) * spin;
  }
  Eigen::Matrix<double, 6, 1> f;
  f << torque, force;
  return f;
}

const DofMatrix& MultiBody::inverse_mass() {
  if (!constant_mass_) compute_inverse_mass();
  return inverse_mass_;
}

// Column by column from Bullet's unit responses, which need its articulated-body pass at this configuration.
void MultiBody::compute_inverse_mass() {
  if (constant_mass_) free_velocity_articulated(0);
  double force[kMaxDofs], response[kMaxDofs];
  for (int column = 0; column < dofs(); ++column) {
    std::fill(force, force + dofs(), 0.0);
    if (column < 6) {
      const Vector3d axis = R_WB_.col(column % 3);
      std::copy(axis.data(), axis.data() + 3, force + 3 * (column / 3));
    } else {
      force[column] = 1;
    }
    body_->calcAccelerationDeltasMultiDof(force, response, scratch_r_, scratch_v_);
    inverse_mass_.col(column).head<3>() = R_WB_.transpose() * Eigen::Map<Vector3d>(response);
    inverse_mass_.col(column).segment<3>(3) = R_WB_.transpose() * Eigen::Map<Vector3d>(response + 3);
    for (int j = 6; j < dofs(); ++j) inverse_mass_(j, column) = response[j];
  }
  inverse_mass_ = (0.5 * (inverse_mass_ + inverse_mass_.transpose())).eval();
}

void MultiBody::compute_held_motors() {
  const Eigen::Matrix<double, 8, 2> e = inverse_mass_.rightCols<2>();
  held_.inertia = Eigen::Matrix2d(e.bottomRows<2>()).inverse();
  held_.gain = e * held_.inertia;
  held_.gain.bottomRows<2>().setIdentity();
  held_.inverse_mass = inverse_mass_ - held_.gain * e.transpose();
  held_.inverse_mass.rightCols<2>().setZero();
  held_.inverse_mass.bottomRows<2>().setZero();
}

void MultiBody::integrate(double step_s) {
  const Vector3d turn = u_.head<3>() * step_s;
  const TurnSeries series(turn.squaredNorm());
  const Vector3d v = u_.segment<3>(3) - u_.head<3>().cross(com_B_);  // of the base frame's origin
  const Vector3d w_v = turn.cross(v);
  p_WB_ += R_WB_ * (v + series.a * w_v + series.b * turn.cross(w_v)) * step_s;
  const Vector3d half = series.half_sine * turn;
  const Quaterniond q_turn(series.half_cosine, half.x(), half.y(), half.z());
  set_pose(q_WB_ * q_turn, p_WB_);
  u_.segment<3>(3) = q_turn.conjugate() * Vector3d(u_.segment<3>(3));
  for (int j = 0; j < int(joints_.size()); ++j) angle_rad_[j] += step_s * u_[6 + j];
  if (!legs_.empty()) swing_legs();
}

// A caster's wheel, carried round by its fork.
Joint MultiBody::swung(Joint j) const {
  const SwivelLeg& leg = legs_[std::size_t(j.parent - 2) / 2];
  const auto swing = [&](const Vector3d& v) {
    return Vector3d(leg.cosine * v.x() - leg.sine * v.y(), leg.sine * v.x() + leg.cosine * v.y(), v.z());
  };
  const Vector3d& pivot_m = joints_[j.parent].pivot_m;
  j.pivot_m = pivot_m + swing(j.pivot_m - pivot_m);
  j.axis = leg.axle;
  return j;
}

MultiBody::Lever MultiBody::lever(int joint, const Vector3d& point_m, const Vector3d& shift_m) const {
  Lever l;
  l.arm_m = point_m - com_B_;
  for (int j = joint; j >= 0; j = joints_[j].parent) {
    const auto add = [&](const Joint& at) { l.turn_m[l.joints] = at.axis.cross(point_m - at.pivot_m - shift_m); };
    joints_[j].parent < 0 ? add(joints_[j]) : add(current(j));
    l.joint[l.joints++] = j;
  }
  if (l.joints == 1) l.turn_m[1].setZero();
  return l;
}

void MultiBody::jacobian(const Lever& lever, const Vector3d& direction, DofVector& row) const {
  row.resize(dofs());
  row.head<3>() = lever.arm_m.cross(direction);
  row.segment<3>(3) = direction;
  for (int j = 6; j < dofs(); ++j) row[j] = 0;
  for (int i = 0; i < lever.joints; ++i) row[6 + lever.joint[i]] = lever.turn_m[i].dot(direction);
}

double MultiBody::energy() {
  to_bullet_state();
  btAlignedObjectArray<btVector3> omega, velocity;
  omega.resize(body_->getNumLinks() + 1);
  velocity.resize(body_->getNumLinks() + 1);
  body_->compTreeLinkVelocities(&omega[0], &velocity[0]);
  double kinetic = body_->getBaseMass() * velocity[0].length2() + omega[0].dot(body_->getBaseInertia() * omega[0]);
  double potential = -body_->getBaseMass() * gravity_mps2_.dot(to_eigen(body_->getBasePos()));
  for (int i = 0; i < body_->getNumLinks(); ++i) {
    const btMultibodyLink& link = body_->getLink(i);
    kinetic += link.m_mass * velocity[i + 1].length2() + omega[i + 1].dot(link.m_inertiaLocal * omega[i + 1]);
    potential -= link.m_mass * gravity_mps2_.dot(to_eigen(body_->localPosToWorld(i, btVector3(0, 0, 0))));
  }
  return kinetic / 2 + potential;
}

}  // namespace umbsim

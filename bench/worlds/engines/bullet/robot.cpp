#include "bench/worlds/engines/bullet/robot.h"

#include <algorithm>
#include <cmath>

#include "bench/worlds/engines/bullet/model.h"
#include "core/error.h"

namespace umbsim::worlds::bullet {
namespace {

constexpr double kSettle_s = 0.5;

}  // namespace

BulletRobot::BulletRobot(const Rig& rig, const BulletOptions& options, const Pose2& X_WB)
    : rig_(rig),
      options_(options),
      set_points_{SetPoint(rig.drivetrain.motor[0]), SetPoint(rig.drivetrain.motor[1])},
      drift_{rig.floor.drift_x, rig.floor.drift_y},
      heading_rad_(X_WB.theta_rad) {
  if (!rig.floor.ripples.empty()) throw InputError("Bullet: uneven floors are not expressed");
  for (const Motor& motor : rig.drivetrain.motor) {
    if (motor.backlash_rad > 0) throw InputError("Bullet: play between motor and wheel is not expressed");
  }
  model_ = std::make_unique<Model>(rig, options);
  settle(X_WB);
}

BulletRobot::~BulletRobot() = default;

// At rest under its weight, which also says how far soft tyres give; then back to the start.
void BulletRobot::settle(const Pose2& X_WB) {
  const auto place = [&](double height_m) {
    Eigen::Isometry3d X_WR(Eigen::AngleAxisd(X_WB.theta_rad, Eigen::Vector3d::UnitZ()));
    X_WR.translation() = Eigen::Vector3d(X_WB.x_m, X_WB.y_m, height_m);
    model_->place(X_WR);
  };
  for (std::size_t i = 0; i < 2; ++i) radius_m_[i] = rig_.robot.wheels[i].radius_m;
  place(std::max(radius_m_[0], radius_m_[1]));
  advance({0, 0}, kSettle_s);
  for (int i = 0; i < 2; ++i) {
    const double soft_mpn = rig_.robot.wheels[std::size_t(i)].compliance_mpn;
    if (soft_mpn > 0) model_->set_radius(i, radius_m_[std::size_t(i)] -= soft_mpn * load_n(i));
  }
  advance({0, 0}, kSettle_s);
  if (load_n(0) <= 0 || load_n(1) <= 0 || tilt_rad() > 0.3) throw RunError("Bullet: the robot does not stand");
  const Eigen::Isometry3d settled = model_->pose();
  turn(X_WB.theta_rad - heading_rad_, X_WB.x_m - settled.translation().x(), X_WB.y_m - settled.translation().y());
  heading_rad_ = X_WB.theta_rad;
  for (int i = 0; i < 2; ++i) zero_rad_[std::size_t(i)] = last_rad_[std::size_t(i)] = model_->body().getJointPos(i);
  steps_ = 0;
}

void BulletRobot::advance(const std::array<double, 2>& command_radps, double duration_s) {
  const int n = std::max(1, int(std::ceil(duration_s / options_.step_s - 1e-6)));
  const double step_s = duration_s / n;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < 2; ++i) {
      const std::size_t w = std::size_t(i);
      model_->set_motor(i, set_points_[w].step(command_radps[w], double(k + 1) / n, step_s),
                        rig_.drivetrain.motor[w].torque_limit_nm * step_s);
    }
    step(step_s);
  }
  for (std::size_t i = 0; i < 2; ++i) set_points_[i].arrive(command_radps[i]);
  steps_ += n;
  if (!model_->pose().matrix().allFinite()) throw RunError("Bullet: the state became non-finite");
}

void BulletRobot::step(double step_s) {
  grip();
  pull();
  model_->set_swivel_friction(step_s);
  model_->world().stepSimulation(step_s, 0);
  last_step_s_ = step_s;
  carry();
  note_heading();
}

void BulletRobot::note_heading() {
  const Eigen::Matrix3d R = model_->pose().linear();
  heading_rad_ += wrap_angle(std::atan2(R(1, 0), R(0, 0)) - heading_rad_);
}

void BulletRobot::grip() {
  if (rig_.floor.patches.empty()) return;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d at = model_->wheel_at(i);
    const double friction = friction_at(rig_.floor, at.x(), at.y());
    model_->set_grip(i, bullet::grip(rig_.robot.wheels[std::size_t(i)], options_, friction));
  }
}

// Forces act at the base's centre of mass, and are cleared after each step.
void BulletRobot::pull() {
  if (pull_.force_x_n == 0 && pull_.force_y_n == 0 && pull_.yaw_nm == 0) return;
  const Eigen::Isometry3d X_WR = model_->pose();
  const Eigen::Vector3d force(pull_.force_x_n, pull_.force_y_n, 0);
  const Eigen::Vector3d arm =
      X_WR.linear() * (Eigen::Vector3d(pull_.ahead_m, pull_.left_m, pull_.height_m) - rig_.robot.base.com_m);
  Eigen::Vector3d torque = arm.cross(force);
  torque.z() += pull_.yaw_nm;
  model_->body().addBaseForce({force.x(), force.y(), force.z()});
  model_->body().addBaseTorque({torque.x(), torque.y(), torque.z()});
}

// What a carpet that carries the robot as it rolls, and wheels that roll further than their shape says, add to the way.
void BulletRobot::carry() {
  double rolled_by_both_m = 0, further_m[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const double angle_rad = model_->body().getJointPos(int(i)), rolled_m = (angle_rad - last_rad_[i]) * radius_m_[i];
    last_rad_[i] = angle_rad;
    rolled_by_both_m += std::abs(rolled_m);
    further_m[i] = (rolling_factor_[i] - 1) * rolled_m;
  }
  const double c = std::cos(heading_rad_), s = std::sin(heading_rad_), b = rig_.robot.wheelbase_m();
  if (drift_[0] != 0 || drift_[1] != 0) {
    const double mean_m = rolled_by_both_m / 2;
    turn(0, drift_[0] * mean_m, drift_[1] * mean_m);
  }
  if (further_m[0] != 0 || further_m[1] != 0) {
    const double mean_m = (further_m[0] + further_m[1]) / 2;
    turn((further_m[1] - further_m[0]) / b, c * mean_m, s * mean_m);
  }
}

// The whole robot with its velocity about the upright through the axle's middle, and along the floor.
void BulletRobot::turn(double angle_rad, double x_m, double y_m) {
  Eigen::Isometry3d X_WR = model_->pose();
  const Eigen::AngleAxisd turn(angle_rad, Eigen::Vector3d::UnitZ());
  X_WR.linear() = turn * X_WR.linear();
  X_WR.translation() += Eigen::Vector3d(x_m, y_m, 0);
  model_->place(X_WR);
  const btMatrix3x3 R(btQuaternion(btVector3(0, 0, 1), angle_rad));
  btMultiBody& body = model_->body();
  body.setBaseVel(R * body.getBaseVel());
  body.setBaseOmega(R * body.getBaseOmega());
}

Pose2 BulletRobot::pose() const {
  const Eigen::Vector3d at = model_->pose().translation();
  return {at.x(), at.y(), heading_rad_};
}

double BulletRobot::wheel_angle(int wheel) const {
  return model_->body().getJointPos(wheel) - zero_rad_[std::size_t(wheel)];
}

double BulletRobot::tilt_rad() const { return std::acos(std::clamp(model_->pose().linear()(2, 2), -1.0, 1.0)); }

double BulletRobot::load_n(int wheel) const { return model_->load_n(wheel, last_step_s_); }

}  // namespace umbsim::worlds::bullet

#include "bench/worlds/engines/mujoco/robot.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

#include "core/error.h"

namespace umbsim::worlds::mujoco {
namespace {

constexpr double kSettle_s = 0.5;

std::mutex loading;  // mj_loadXML keeps its last model

mjModel* load(const std::string& xml) {
  const std::lock_guard lock(loading);
  mju_user_warning = [](const char*) {};  // no MUJOCO_LOG.TXT: an unstable setting shows in its state
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "robot.xml", int(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[files->nfile - 1]));
  char error[1000] = "";
  mjModel* model = mj_loadXML("robot.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw RunError(fmt::format("MuJoCo: {}", error));
  return model;
}

}  // namespace

MujocoRobot::MujocoRobot(const Rig& rig, const MujocoOptions& options, const Pose2& X_WB)
    : rig_(rig),
      options_(options),
      drift_{rig.floor.drift_x, rig.floor.drift_y},
      heading_rad_(X_WB.theta_rad),
      owned_model_(load(model_xml(rig, options, X_WB)), mj_deleteModel),
      owned_data_(mj_makeData(owned_model_.get()), mj_deleteData),
      model_(owned_model_.get()),
      data_(owned_data_.get()) {
  find_parts();
  settle(X_WB);
}

void MujocoRobot::find_parts() {
  base_ = mj_name2id(model_, mjOBJ_BODY, "base");
  for (int i = 0; i < 2; ++i) {
    WheelPart& w = wheels_[std::size_t(i)];
    const auto id = [&](mjtObj type, const char* what) {
      return mj_name2id(model_, type, fmt::format("{}{}", what, i).c_str());
    };
    w.geom = id(mjOBJ_GEOM, "tyre");
    w.motor = model_->jnt_qposadr[id(mjOBJ_JOINT, "motor")];
    const int play = id(mjOBJ_JOINT, "play");
    if (play >= 0) w.play = model_->jnt_qposadr[play];
    w.radius_m = rig_.robot.wheels[std::size_t(i)].radius_m;
    w.set_point = SetPoint(rig_.drivetrain.motor[std::size_t(i)]);
  }
  if (rig_.floor.ripples.empty()) return;
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    if (model_->geom_contype[geom] != 0) continue;
    int support = 0;
    while ((model_->geom_conaffinity[geom] >> (support + 1) & 1) == 0) ++support;
    const int body = mj_name2id(model_, mjOBJ_BODY, fmt::format("floor{}", support).c_str());
    supports_.push_back({geom, model_->body_mocapid[body]});
  }
}

// At rest under its weight, which also says how far soft tyres give; then back to the start.
void MujocoRobot::settle(const Pose2& X_WB) {
  mj_forward(model_, data_);
  advance({0, 0}, kSettle_s);
  for (int i = 0; i < 2; ++i) press_tyre(i);
  advance({0, 0}, kSettle_s);
  if (load_n(0) <= 0 || load_n(1) <= 0 || tilt_rad() > 0.3) throw RunError("MuJoCo: the robot does not stand");
  turn(X_WB.theta_rad - heading_rad_);
  data_->qpos[0] = X_WB.x_m;
  data_->qpos[1] = X_WB.y_m;
  heading_rad_ = X_WB.theta_rad;
  for (int i = 0; i < 2; ++i) {
    WheelPart& w = wheels_[std::size_t(i)];
    w.zero_shaft_rad = data_->qpos[w.motor];
    w.zero_wheel_rad = w.last_rad = turned(i);
  }
  mj_forward(model_, data_);
  steps_ = 0;
}

double MujocoRobot::turned(int wheel) const {
  const WheelPart& w = wheels_[std::size_t(wheel)];
  return data_->qpos[w.motor] + (w.play >= 0 ? data_->qpos[w.play] : 0);
}

double MujocoRobot::load_n(int wheel) const {
  double load_n = 0;
  for (int c = 0; c < data_->ncon; ++c) {
    const int geom = wheels_[std::size_t(wheel)].geom;
    if (data_->contact[c].geom1 != geom && data_->contact[c].geom2 != geom) continue;
    mjtNum force[6];
    mj_contactForce(model_, data_, c, force);
    load_n += force[0];
  }
  return load_n;
}

// A soft tyre's radius under the load that it carries at rest.
void MujocoRobot::press_tyre(int i) {
  const Wheel& wheel = rig_.robot.wheels[std::size_t(i)];
  if (wheel.compliance_mpn == 0) return;
  WheelPart& w = wheels_[std::size_t(i)];
  w.radius_m -= wheel.compliance_mpn * load_n(i);
  model_->geom_size[3 * w.geom] = w.radius_m;
  if (options_.wheel == "ellipsoid") model_->geom_size[3 * w.geom + 1] = w.radius_m;
}

void MujocoRobot::advance(const std::array<double, 2>& command_radps, double duration_s) {
  const int n = std::max(1, int(std::ceil(duration_s / options_.step_s - 1e-6)));
  model_->opt.timestep = duration_s / n;
  for (int k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      data_->ctrl[i] = wheels_[i].set_point.step(command_radps[i], double(k + 1) / n, model_->opt.timestep);
    }
    step();
  }
  for (std::size_t i = 0; i < 2; ++i) wheels_[i].set_point.arrive(command_radps[i]);
  steps_ += n;
  if (!std::isfinite(data_->qpos[0]) || data_->warning[mjWARN_BADQACC].number > 0 ||
      data_->warning[mjWARN_BADQPOS].number > 0) {
    throw RunError("MuJoCo: the state became non-finite");
  }
}

void MujocoRobot::step() {
  lay_floor();
  grip();
  pull();
  mj_step(model_, data_);
  carry();
  note_heading();
}

void MujocoRobot::note_heading() {
  const mjtNum* q = data_->qpos + 3;
  const double heading = std::atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
  heading_rad_ += wrap_angle(heading - heading_rad_);
}

// Under each support a plane tangent to the floor where the support touches it.
void MujocoRobot::lay_floor() {
  for (const auto& [geom, mocap] : supports_) {
    const mjtNum* c = data_->geom_xpos + 3 * geom;
    const double radius_m = model_->geom_size[3 * geom];
    FloorPoint at = floor_at(rig_.floor, c[0], c[1]);
    Eigen::Vector3d point(c[0], c[1], at.height_m), normal;
    for (int round = 0; round < 2; ++round) {
      normal = Eigen::Vector3d(-at.slope_x, -at.slope_y, 1).normalized();
      point = Eigen::Vector3d(c[0], c[1], c[2]) - radius_m * normal;
      at = floor_at(rig_.floor, point.x(), point.y());
    }
    point.z() = at.height_m;
    const Eigen::Quaterniond turned = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
    std::copy(point.data(), point.data() + 3, data_->mocap_pos + 3 * mocap);
    const double quaternion[] = {turned.w(), turned.x(), turned.y(), turned.z()};
    std::copy(quaternion, quaternion + 4, data_->mocap_quat + 4 * mocap);
  }
}

void MujocoRobot::grip() {
  if (rig_.floor.patches.empty()) return;
  for (std::size_t i = 0; i < 2; ++i) {
    const mjtNum* at = data_->geom_xpos + 3 * wheels_[i].geom;
    const TyreFriction f = tyre_friction(rig_.robot.wheels[i], options_, friction_at(rig_.floor, at[0], at[1]));
    mjtNum* friction = model_->geom_friction + 3 * wheels_[i].geom;
    friction[0] = f.sliding;
    friction[1] = f.torsion_m;
    friction[2] = f.rolling_m;
  }
}

// MuJoCo's outer forces act at the centre of mass.
void MujocoRobot::pull() {
  mjtNum* applied = data_->xfrc_applied + 6 * base_;
  mju_zero(applied, 6);
  if (pull_.force_x_n == 0 && pull_.force_y_n == 0 && pull_.yaw_nm == 0) return;
  const mjtNum force[] = {pull_.force_x_n, pull_.force_y_n, 0};
  const mjtNum local[] = {pull_.ahead_m, pull_.left_m, pull_.height_m};
  mjtNum arm[3], torque[3];
  mju_rotVecMat(arm, local, data_->xmat + 9 * base_);
  mju_addTo3(arm, data_->xpos + 3 * base_);
  mju_subFrom3(arm, data_->xipos + 3 * base_);
  mju_cross(torque, arm, force);
  torque[2] += pull_.yaw_nm;
  mju_copy3(applied, force);
  mju_copy3(applied + 3, torque);
}

// What a carpet that carries the robot as it rolls, and wheels that roll further than their shape says, add to the way.
void MujocoRobot::carry() {
  double rolled_by_both_m = 0, further_m[2];
  for (std::size_t i = 0; i < 2; ++i) {
    WheelPart& w = wheels_[i];
    const double angle_rad = turned(int(i)), rolled_m = (angle_rad - w.last_rad) * w.radius_m;
    w.last_rad = angle_rad;
    rolled_by_both_m += std::abs(rolled_m);
    further_m[i] = (w.rolling_factor - 1) * rolled_m;
  }
  const double c = std::cos(heading_rad_), s = std::sin(heading_rad_), b = rig_.robot.wheelbase_m();
  if (drift_[0] != 0 || drift_[1] != 0) {
    const double mean_m = rolled_by_both_m / 2;
    data_->qpos[0] += drift_[0] * mean_m;
    data_->qpos[1] += drift_[1] * mean_m;
  }
  if (further_m[0] != 0 || further_m[1] != 0) {
    const double mean_m = (further_m[0] + further_m[1]) / 2;
    data_->qpos[0] += c * mean_m;
    data_->qpos[1] += s * mean_m;
    turn((further_m[1] - further_m[0]) / b);
  }
}

// The whole robot with its velocity about the upright through the axle's middle.
void MujocoRobot::turn(double angle_rad) {
  const mjtNum turn[] = {std::cos(angle_rad / 2), 0, 0, std::sin(angle_rad / 2)};
  mjtNum turned[4], velocity[3];
  mju_mulQuat(turned, turn, data_->qpos + 3);
  mju_copy(data_->qpos + 3, turned, 4);
  mju_rotVecQuat(velocity, data_->qvel, turn);
  mju_copy3(data_->qvel, velocity);
}

Pose2 MujocoRobot::pose() const { return {data_->qpos[0], data_->qpos[1], heading_rad_}; }

double MujocoRobot::wheel_angle(int wheel) const { return turned(wheel) - wheels_[std::size_t(wheel)].zero_wheel_rad; }

double MujocoRobot::encoder_angle(int wheel) const {
  const WheelPart& w = wheels_[std::size_t(wheel)];
  return data_->qpos[w.motor] - w.zero_shaft_rad;
}

double MujocoRobot::tilt_rad() const {
  const mjtNum* q = data_->qpos + 3;
  return std::acos(std::clamp(1 - 2 * (q[1] * q[1] + q[2] * q[2]), -1.0, 1.0));
}

}  // namespace umbsim::worlds::mujoco

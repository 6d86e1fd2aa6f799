#include "bench/second_engine/robot.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "bench/second_engine/mjcf.h"
#include "core/error.h"

namespace umbsim::second_engine {
namespace {

constexpr double kSettle_s = 0.5;
constexpr double kLeastFriction = 1e-5;  // MuJoCo's own

std::mutex loading;  // mj_loadXML keeps its last model

mjModel* load(const std::string& xml) {
  const std::lock_guard lock(loading);
  mju_user_warning = [](const char*) {};  // no MUJOCO_LOG.TXT: an unstable setting shows in its state
  mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "robot.xml", int(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files.filedata[files.nfile - 1]));
  char error[1000] = "";
  mjModel* model = mj_loadXML("robot.xml", &files, error, sizeof error);
  mj_deleteVFS(&files);
  if (!model) throw RunError(fmt::format("MuJoCo: {}", error));
  return model;
}

struct Wheelwork {
  int geom = 0;
  int motor = 0;  // index in qpos
  int play = -1;  // index in qpos, -1: none
  double last_rad = 0;
  double radius_m = 0;
  double set_point_radps = 0;
  double wheel_angle(const mjData& d) const { return d.qpos[motor] + (play >= 0 ? d.qpos[play] : 0); }
};

}  // namespace

struct Robot::State {
  Rig rig;
  EngineOptions options;
  double heading_walk;
  RandomStream random;
  mjModel* model = nullptr;
  mjData* data = nullptr;
  int base = 0;
  std::array<Wheelwork, 2> wheels;
  std::vector<std::array<int, 2>> supports;  // geom and mocap body, on uneven floors
  std::array<double, 2> zero_rad{};
  std::vector<Push> pushes;  // of the leg, in time of the data
  double heading_rad = 0;

  State(const Rig& r, const EngineOptions& o, double start_heading_rad, double walk, RandomStream stream)
      : rig(r), options(o), heading_walk(walk), random(std::move(stream)), heading_rad(start_heading_rad) {
    model = load(model_xml(rig, options, start_heading_rad));
    data = mj_makeData(model);
    find_parts();
    settle(start_heading_rad);
  }
  ~State() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }

  void find_parts() {
    base = mj_name2id(model, mjOBJ_BODY, "base");
    for (int i = 0; i < 2; ++i) {
      Wheelwork& w = wheels[std::size_t(i)];
      const auto id = [&](mjtObj type, const char* what) {
        return mj_name2id(model, type, fmt::format("{}{}", what, i).c_str());
      };
      w.geom = id(mjOBJ_GEOM, "tyre");
      w.motor = model->jnt_qposadr[id(mjOBJ_JOINT, "motor")];
      const int play = id(mjOBJ_JOINT, "play");
      if (play >= 0) w.play = model->jnt_qposadr[play];
      w.radius_m = rig.robot.wheels[std::size_t(i)].radius_m;
    }
    if (rig.floor.ripples.empty()) return;
    for (int geom = 0; geom < model->ngeom; ++geom) {
      if (model->geom_contype[geom] != 0) continue;
      int support = 0;
      while ((model->geom_conaffinity[geom] >> (support + 1) & 1) == 0) ++support;
      const int body = mj_name2id(model, mjOBJ_BODY, fmt::format("floor{}", support).c_str());
      supports.push_back({geom, model->body_mocapid[body]});
    }
  }

  // At rest under its weight, which also says how far soft tyres give; then back to the start.
  void settle(double start_heading_rad) {
    mj_forward(model, data);
    for (double t = 0; t < kSettle_s; t += options.step_s) step();
    for (int i = 0; i < 2; ++i) press_tyre(i);
    for (double t = 0; t < kSettle_s; t += options.step_s) step();
    rotate(start_heading_rad - pose().theta_rad);
    const Pose2 at = pose();
    data->qpos[0] -= at.x_m;
    data->qpos[1] -= at.y_m;
    for (int i = 0; i < 2; ++i) {
      zero_rad[std::size_t(i)] = data->qpos[wheels[std::size_t(i)].motor];
      wheels[std::size_t(i)].last_rad = wheels[std::size_t(i)].wheel_angle(*data);
    }
    mj_forward(model, data);
  }

  // A soft tyre's radius under the load that it carries at rest.
  void press_tyre(int i) {
    const Wheel& wheel = rig.robot.wheels[std::size_t(i)];
    if (wheel.compliance_mpn == 0) return;
    Wheelwork& w = wheels[std::size_t(i)];
    double load_n = 0;
    for (int c = 0; c < data->ncon; ++c) {
      if (data->contact[c].geom1 != w.geom && data->contact[c].geom2 != w.geom) continue;
      mjtNum force[6];
      mj_contactForce(model, data, c, force);
      load_n += force[0];
    }
    w.radius_m -= wheel.compliance_mpn * load_n;
    model->geom_size[3 * w.geom] = w.radius_m;
    if (options.wheel == "ellipsoid") model->geom_size[3 * w.geom + 1] = w.radius_m;
    model->geom_rbound[w.geom] = std::max(model->geom_rbound[w.geom], w.radius_m);
  }

  void command(double left_radps, double right_radps) {
    const double speeds[] = {left_radps, right_radps};
    for (std::size_t i = 0; i < 2; ++i) {
      const Motor& m = rig.drivetrain.motor[i];
      double wanted = m.gain * speeds[i];
      if (std::abs(wanted) < m.deadband_radps) wanted = 0;
      const double follow = m.lag_s > 0 ? 1 - std::exp(-options.step_s / m.lag_s) : 1;
      wheels[i].set_point_radps += follow * (wanted - wheels[i].set_point_radps);
      data->ctrl[i] = wheels[i].set_point_radps;
    }
  }

  void step() {
    lay_floor();
    grip();
    push();
    mj_step(model, data);
    drift();
    const mjtNum* q = data->qpos + 3;
    const double heading = std::atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
    heading_rad += wrap_angle(heading - heading_rad);
  }

  // Under each support a plane tangent to the floor where the support touches it.
  void lay_floor() {
    for (const auto& [geom, mocap] : supports) {
      const mjtNum* c = data->geom_xpos + 3 * geom;
      const double radius_m = model->geom_size[3 * geom];
      FloorPoint at = floor_at(rig.floor, c[0], c[1]);
      Eigen::Vector3d point(c[0], c[1], at.height_m), normal;
      for (int round = 0; round < 3; ++round) {
        normal = Eigen::Vector3d(-at.slope_x, -at.slope_y, 1).normalized();
        point = Eigen::Vector3d(c[0], c[1], c[2]) - radius_m * normal;
        at = floor_at(rig.floor, point.x(), point.y());
      }
      point.z() = at.height_m;
      const Eigen::Quaterniond turned = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
      std::copy(point.data(), point.data() + 3, data->mocap_pos + 3 * mocap);
      const double quaternion[] = {turned.w(), turned.x(), turned.y(), turned.z()};
      std::copy(quaternion, quaternion + 4, data->mocap_quat + 4 * mocap);
    }
  }

  void grip() {
    if (rig.floor.patches.empty()) return;
    for (std::size_t i = 0; i < 2; ++i) {
      const mjtNum* at = data->geom_xpos + 3 * wheels[i].geom;
      const TyreFriction f = tyre_friction(rig.robot.wheels[i], friction_at(rig.floor, at[0], at[1]));
      model->geom_friction[3 * wheels[i].geom] = std::max(f.sliding, kLeastFriction);
      model->geom_friction[3 * wheels[i].geom + 1] = f.torsion_m;
    }
  }

  void push() {
    if (pushes.empty()) return;
    mju_zero(data->xfrc_applied + 6 * base, 6);
    for (const Push& p : pushes) {
      const double overlap_s =
          std::min(data->time + options.step_s, p.time_s + p.duration_s) - std::max(data->time, p.time_s);
      if (overlap_s <= 0) continue;
      apply_force(p, p.impulse_ns / p.duration_s * overlap_s / options.step_s);
    }
  }

  void apply_force(const Push& p, double newton) {
    const double direction_rad = heading_rad + p.direction_rad;
    const mjtNum force[] = {newton * std::cos(direction_rad), newton * std::sin(direction_rad), 0};
    const mjtNum local[] = {p.ahead_m, 0, p.height_m};
    mjtNum arm[3], torque[3];
    mju_rotVecMat(arm, local, data->xmat + 9 * base);
    mju_addTo3(arm, data->xpos + 3 * base);
    mju_subFrom3(arm, data->xipos + 3 * base);  // forces act at the centre of mass
    mju_cross(torque, arm, force);
    mju_addTo3(data->xfrc_applied + 6 * base, force);
    mju_addTo3(data->xfrc_applied + 6 * base + 3, torque);
  }

  // The carpet carries each wheel by its drift times the way that it rolls.
  void drift() {
    double rolled_m[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const double angle_rad = wheels[i].wheel_angle(*data);
      rolled_m[i] = std::abs(angle_rad - wheels[i].last_rad) * wheels[i].radius_m;
      wheels[i].last_rad = angle_rad;
    }
    if (rig.floor.drift_x == 0 && rig.floor.drift_y == 0) return;
    const double mean_m = (rolled_m[0] + rolled_m[1]) / 2;
    data->qpos[0] += rig.floor.drift_x * mean_m;
    data->qpos[1] += rig.floor.drift_y * mean_m;
    const double forward = rig.floor.drift_x * std::cos(heading_rad) + rig.floor.drift_y * std::sin(heading_rad);
    rotate(forward * (rolled_m[1] - rolled_m[0]) / rig.robot.wheelbase_m());
  }

  // Turns the whole robot with its velocity about the upright through the axle's middle.
  void rotate(double angle_rad) {
    const mjtNum turn[] = {std::cos(angle_rad / 2), 0, 0, std::sin(angle_rad / 2)};
    mjtNum turned[4], velocity[3];
    mju_mulQuat(turned, turn, data->qpos + 3);
    mju_copy(data->qpos + 3, turned, 4);
    mju_rotVecQuat(velocity, data->qvel, turn);
    mju_copy3(data->qvel, velocity);
    heading_rad += angle_rad;
  }

  void walk(double rolled_m) {
    const double step_rad = heading_walk * std::sqrt(rolled_m) * random.normal();
    if (heading_walk > 0) rotate(step_rad);
  }

  Pose2 pose() const { return {data->qpos[0], data->qpos[1], heading_rad}; }
};

Robot::Robot(const Rig& rig, const EngineOptions& options, double start_heading_rad, double heading_walk,
             RandomStream random)
    : state_(std::make_unique<State>(rig, options, start_heading_rad, heading_walk, std::move(random))) {}
Robot::~Robot() = default;
Robot::Robot(Robot&&) noexcept = default;

void Robot::begin_leg(int leg) {
  state_->pushes.clear();
  mju_zero(state_->data->xfrc_applied + 6 * state_->base, 6);
  for (const LegPush& p : state_->rig.pushes) {
    if (p.leg != leg) continue;
    state_->pushes.push_back(p.push);
    state_->pushes.back().time_s += state_->data->time;
  }
}

void Robot::advance(double left_radps, double right_radps, double period_s) {
  State& s = *state_;
  const int steps = int(std::lround(period_s / s.options.step_s));
  double before_rad[2];
  for (std::size_t i = 0; i < 2; ++i) before_rad[i] = s.wheels[i].last_rad;
  for (int k = 0; k < steps; ++k) {
    s.command(left_radps, right_radps);
    s.step();
  }
  double rolled_m = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    rolled_m += std::abs(s.wheels[i].last_rad - before_rad[i]) * s.wheels[i].radius_m / 2;
  }
  if (!std::isfinite(s.data->qpos[0]) || s.data->warning[mjWARN_BADQACC].number > 0) {
    throw RunError("MuJoCo: the state became non-finite");
  }
  s.walk(rolled_m);
}

Pose2 Robot::pose() const { return state_->pose(); }

double Robot::encoder_angle(int wheel) const {
  return state_->data->qpos[state_->wheels[std::size_t(wheel)].motor] - state_->zero_rad[std::size_t(wheel)];
}

}  // namespace umbsim::second_engine

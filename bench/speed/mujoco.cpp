#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "bench/speed/engine.h"

namespace umbsim::bench {
namespace {

std::string wheel_geom(const Wheel& w, const std::string& shape) {
  if (shape == "sphere") return fmt::format("type='sphere' size='{}'", w.radius_m);
  if (shape == "ellipsoid")
    return fmt::format("type='ellipsoid' size='{} {} {}'", w.radius_m, w.radius_m, w.width_m / 2);
  return fmt::format("type='cylinder' size='{} {}'", w.radius_m, w.width_m / 2);
}

// A cable is a capsule: round on top like the others' cylinder, and MuJoCo meets it with a sphere in closed form.
std::string cable_geom(const Cable& c) {
  return fmt::format("<geom class='floor' type='capsule' size='{} {}' pos='{} {} {}' euler='1.5707963267948966 0 {}'/>",
                     c.height_m / 2, c.length_m / 2, c.x_m, c.y_m, c.height_m / 2, c.direction_rad - M_PI / 2);
}

std::string wheel_body(const Wheel& w, int i, const MujocoOptions& o) {
  const double toe_rad = std::atan2(-w.axis.x(), w.axis.y());
  return fmt::format(
      "<body pos='{} {} {}' euler='0 0 {}'><joint name='w{}' type='hinge' axis='0 1 0' damping='{}'/>"
      "<inertial pos='0 0 0' mass='{}' diaginertia='{} {} {}'/>"
      "<geom {} euler='1.5707963267948966 0 0'/></body>",
      w.centre_m.x(), w.centre_m.y(), w.centre_m.z(), toe_rad, i, o.servo == "damping" ? o.servo_gain : 0.0, w.mass_kg,
      w.transverse_inertia_kgm2, w.spin_inertia_kgm2, w.transverse_inertia_kgm2, wheel_geom(w, o.wheel));
}

std::string motor(int i, double torque_limit_nm, const MujocoOptions& o) {
  if (o.servo == "damping") return fmt::format("<motor joint='w{}' gear='{}'/>", i, o.servo_gain);
  return fmt::format("<velocity joint='w{}' kv='{}' forcelimited='true' forcerange='{} {}'/>", i, o.servo_gain,
                     -torque_limit_nm, torque_limit_nm);
}

// Only pairs of floor and robot are looked at: the robot's parts cannot meet.
std::string model_xml(const Setup& s, const MujocoOptions& o) {
  const RobotModel& r = s.robot;
  const auto diagonal = r.base.inertia_kgm2.diagonal();
  std::string xml = fmt::format(
      "<mujoco><compiler angle='radian'/>"
      "<option timestep='{}' gravity='0 0 -9.81' integrator='{}' cone='{}' impratio='{}' noslip_iterations='{}'/>"
      "<default><geom solref='{} {}' solimp='{}' friction='{} 0 0' condim='3' contype='0' conaffinity='1'/>"
      "<default class='floor'><geom contype='1' conaffinity='0'/></default></default>"
      "<worldbody><geom class='floor' type='plane' size='0 0 1'/>",
      s.step_s, o.integrator, o.cone, o.impratio, o.noslip_iterations, o.contact_time_s, o.contact_damping_ratio,
      o.solimp, s.floor.friction);
  for (const Cable& c : s.floor.cables) xml += cable_geom(c);
  xml += fmt::format(
      "<body name='base' pos='0 0 {}'><freejoint/><inertial pos='{} {} {}' mass='{}' diaginertia='{} {} {}'/>",
      r.wheels[0].radius_m, r.base.com_m.x(), r.base.com_m.y(), r.base.com_m.z(), r.base.mass_kg, diagonal[0],
      diagonal[1], diagonal[2]);
  for (const Caster& c : r.casters) {
    xml += fmt::format("<geom type='sphere' size='{}' pos='{} {} {}' condim='1' priority='1' friction='0 0 0'/>",
                       c.radius_m, c.centre_m.x(), c.centre_m.y(), c.centre_m.z());
  }
  for (int i = 0; i < 2; ++i) xml += wheel_body(r.wheels[i], i, o);
  xml += "</body></worldbody><actuator>";
  for (int i = 0; i < 2; ++i) xml += motor(i, s.torque_limit_nm, o);
  return xml + "</actuator></mujoco>";
}

class Mujoco : public Engine {
 public:
  Mujoco(const Setup& setup, const MujocoOptions& options) : setup_(setup) {
    mju_user_warning = [](const char*) {};  // no MUJOCO_LOG.TXT: an unstable setting shows in its error
    const std::string xml = model_xml(setup, options);
    mjVFS files;
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "robot.xml", int(xml.size()));
    std::copy(xml.begin(), xml.end(), static_cast<char*>(files.filedata[files.nfile - 1]));
    char error[1000] = "";
    model_ = mj_loadXML("robot.xml", &files, error, sizeof error);
    mj_deleteVFS(&files);
    if (!model_) throw std::runtime_error(fmt::format("MuJoCo: {}", error));
    data_ = mj_makeData(model_);
  }
  ~Mujoco() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  void place() override {
    mj_resetData(model_, data_);
    command(0, 0);
    for (double t = 0; t < 0.5; t += setup_.step_s) step();
    for (int i = 0; i < 2; ++i) zero_[i] = data_->qpos[7 + i];
    start_ = Pose2{};
    heading_ = 0;
    start_ = pose();
    steps_ = 0;
  }
  void command(double left_radps, double right_radps) override {
    target_[0] = left_radps;
    target_[1] = right_radps;
  }
  void advance(double duration_s) override {
    const int n = int(std::lround(duration_s / setup_.step_s));
    for (int k = 1; k <= n; ++k) {
      for (int i = 0; i < 2; ++i) data_->ctrl[i] = last_[i] + (target_[i] - last_[i]) * k / n;
      step();
    }
    last_[0] = target_[0];
    last_[1] = target_[1];
  }
  Pose2 pose() const override {
    const mjtNum* q = data_->qpos + 3;
    const double heading = std::atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
    heading_ += wrap_angle(heading - heading_);
    return inverse(start_) * Pose2{data_->qpos[0], data_->qpos[1], heading_};
  }
  double wheel_angle(int wheel) const override { return data_->qpos[7 + wheel] - zero_[wheel]; }
  std::int64_t steps() const override { return steps_; }

 private:
  void step() {
    mj_step(model_, data_);
    ++steps_;
    pose();  // follows the heading over full turns
  }
  Setup setup_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  double target_[2] = {0, 0};
  double last_[2] = {0, 0};
  double zero_[2] = {0, 0};
  Pose2 start_;
  mutable double heading_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace

MujocoOptions mujoco_for_square(double step_s) {
  MujocoOptions o;
  o.wheel = "sphere";
  o.impratio = 1e4;
  o.contact_time_s = 2 * step_s;
  if (step_s >= 0.02) o.servo_gain = 5;  // 20 is unstable there
  return o;
}

MujocoOptions mujoco_for_cable() {
  MujocoOptions o;
  o.wheel = "cylinder";
  o.impratio = 1;
  o.contact_damping_ratio = 4;
  return o;
}

std::unique_ptr<Engine> make_mujoco(const Setup& setup, const MujocoOptions& options) {
  return std::make_unique<Mujoco>(setup, options);
}

}  // namespace umbsim::bench

#include "bench/worlds/engines/mujoco/model_xml.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace umbsim::worlds::mujoco {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr double kPlayDamping_share = 0.002;  // grease, over the servo's gain: a wheel in its play comes to rest
constexpr double kThinnest_m = 0.002;         // of a wheel that has no patch
constexpr double kLeastFriction = 1e-3;  // contacts of less give way like mud: their stiffness goes with its square

std::string text(const Eigen::Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string inertial(const Inertial& body, const Eigen::Vector3d& origin) {
  const Eigen::Matrix3d& I = body.inertia_kgm2;
  return fmt::format("<inertial pos='{}' mass='{}' fullinertia='{} {} {} {} {} {}'/>", text(body.com_m - origin),
                     body.mass_kg, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
}

// Bits of what a support can touch: 1 the common floor and cables, 2 << k its own plane.
int affinity(int support) { return 1 | 2 << support; }

bool has_edges(const MujocoOptions& o) { return o.wheel == "cylinder" || o.wheel == "capsule"; }

// A line of width w and uniform pressure resists turning on the spot like two points w / 2 apart.
std::string tyre_shape(const Wheel& w, const MujocoOptions& o) {
  const double half_m = std::max(w.patch_width_m / 2, kThinnest_m) / 2;
  if (has_edges(o)) return fmt::format("type='{}' size='{} {}'", o.wheel, w.radius_m, half_m);
  if (o.wheel == "ellipsoid") return fmt::format("type='ellipsoid' size='{0} {0} {1}'", w.radius_m, w.radius_m / 4);
  return fmt::format("type='sphere' size='{}'", w.radius_m);
}

// The rim's centre in the frame of the wheel: effects say where it points at wheel angle 0.
Eigen::Vector3d rim_centre(const Wheel& w) {
  return w.eccentricity_m * Eigen::Vector3d(std::cos(w.eccentricity_rad), 0, -std::sin(w.eccentricity_rad));
}

std::string tyre(const Wheel& w, int i, const Rig& rig, const MujocoOptions& o) {
  const TyreFriction f = tyre_friction(w, o, rig.floor.friction);
  const int condim = f.rolling_m > 0 ? 6 : f.torsion_m > 0 ? 4 : 3;
  return fmt::format(
      "<inertial pos='0 0 0' mass='{0}' diaginertia='{1} {2} {1}'/>"
      "<geom name='tyre{3}' {4} pos='{5}' euler='1.5707963267948966 0 0' friction='{6} {7} {8}' condim='{9}' "
      "priority='1'"
      " conaffinity='{10}'/>",
      w.mass_kg, w.transverse_inertia_kgm2, w.spin_inertia_kgm2, i, tyre_shape(w, o), text(rim_centre(w)), f.sliding,
      f.torsion_m, f.rolling_m, condim, affinity(i));
}

// What one motor moves: wheel, reflected inertia and half the robot.
double armature(const Wheel& w, const MujocoOptions& o) { return o.armature_over_wheel * w.spin_inertia_kgm2; }
double servo_gain(int i, const Rig& rig, const MujocoOptions& o) {
  const Wheel& w = rig.robot.wheels[std::size_t(i)];
  const double turning_kgm2 = w.spin_inertia_kgm2 + armature(w, o);
  const double kg = o.tuned_kg > 0 ? o.tuned_kg : rig.robot.total_mass_kg();
  const double gain = (turning_kgm2 + kg * w.radius_m * w.radius_m / 2) / o.servo_time_s;
  return o.integrator == "Euler" ? std::min(gain, turning_kgm2 / o.step_s) : gain;  // explicit there
}

// Behind a play the motor turns a rotor, in whose joint the wheel is free between two stops.
std::string wheel_body(int i, const Rig& rig, const MujocoOptions& o) {
  const Wheel& w = rig.robot.wheels[std::size_t(i)];
  const double toe_rad = std::atan2(-w.axis.x(), w.axis.y()), gain = servo_gain(i, rig, o);
  const double half_play_rad = rig.drivetrain.motor[std::size_t(i)].backlash_rad / 2;
  const std::string place = fmt::format("pos='{}' euler='0 0 {}'", text(w.centre_m), toe_rad);
  const std::string motor = fmt::format("<joint name='motor{}' type='hinge' axis='0 1 0' armature='{}' damping='{}'/>",
                                        i, armature(w, o), o.joint_damping * gain);
  if (half_play_rad == 0) {
    return fmt::format("<body name='wheel{}' {}>{}{}</body>", i, place, motor, tyre(w, i, rig, o));
  }
  return fmt::format(
      "<body {0}>{1}<inertial pos='0 0 0' mass='{2}' diaginertia='{3} {3} {3}'/>"
      "<body name='wheel{4}'><joint name='play{4}' type='hinge' axis='0 1 0' limited='true' range='{5} {6}'"
      " solreflimit='{7} 1' damping='{8}'/>{9}</body></body>",
      place, motor, 0.1 * w.mass_kg, 0.1 * w.spin_inertia_kgm2, i, -half_play_rad, half_play_rad, 2 * o.step_s,
      kPlayDamping_share * gain, tyre(w, i, rig, o));
}

std::string ball(const Caster& c, int support) {
  return fmt::format(
      "<geom type='sphere' size='{}' pos='{}' friction='{} 0 0' condim='{}' priority='1' conaffinity='{}'/>",
      c.radius_m, text(c.centre_m), c.friction, c.friction > 0 ? 3 : 1, affinity(support));
}

std::string swivel(const Caster& c, int support, double friction) {
  return fmt::format(
      "<body pos='{}' euler='0 0 {}'><joint type='hinge' axis='0 0 1' frictionloss='{}'/>{}"
      "<body pos='{}'><joint type='hinge' axis='0 1 0'/><inertial pos='0 0 0' mass='{}' diaginertia='{} {} {}'/>"
      "<geom type='sphere' size='{}' friction='{} 0 0' condim='3' priority='1' conaffinity='{}'/></body></body>",
      text(c.swivel_point_m), c.initial_angle_rad, c.swivel_friction_nm, inertial(c.fork, c.swivel_point_m),
      text(c.centre_m - c.swivel_point_m), c.wheel_mass_kg, c.wheel_transverse_inertia_kgm2, c.wheel_spin_inertia_kgm2,
      c.wheel_transverse_inertia_kgm2, c.radius_m, friction, affinity(support));
}

std::string supports_floor(const Rig& rig) {
  if (rig.floor.ripples.empty()) return "<geom class='floor' type='plane' size='0 0 1'/>";
  std::string xml;
  for (std::size_t k = 0; k < 2 + rig.robot.casters.size(); ++k) {
    xml += fmt::format(
        "<body name='floor{}' mocap='true'><geom class='floor' contype='{}' type='plane' size='0 0 1'/></body>", k,
        2 << k);
  }
  return xml;
}

// A cable is a capsule: round on top, and its ends reach as far as the cable's.
std::string cable(const Cable& c) {
  const double half_m = std::max(c.length_m - c.height_m, 0.001) / 2;
  return fmt::format("<geom class='floor' type='capsule' size='{} {}' pos='{} {} {}' euler='1.5707963267948966 0 {}'/>",
                     c.height_m / 2, half_m, c.x_m, c.y_m, c.height_m / 2, c.direction_rad - M_PI / 2);
}

std::string motor(int i, const Rig& rig, const MujocoOptions& o) {
  const double limit_nm = std::max(rig.drivetrain.motor[std::size_t(i)].torque_limit_nm, 1e-9);
  return fmt::format("<velocity joint='motor{}' kv='{}' forcelimited='true' forcerange='{} {}'/>", i,
                     servo_gain(i, rig, o), -limit_nm, limit_nm);
}

std::string head(const Rig& rig, const MujocoOptions& o) {
  const double down = std::sin(rig.floor.slope_rad) * kGravity_mps2;
  return fmt::format(
      "<mujoco><compiler angle='radian' inertiafromgeom='false'/>"
      "<option timestep='{}' gravity='{} {} {}' integrator='{}' cone='{}' impratio='{}'/>"
      "<size nconmax='40' njmax='300'/>"
      "<default><geom solref='{} {}' solimp='{} {} 0.001' contype='0' conaffinity='1'/>"
      "<default class='floor'><geom contype='1' conaffinity='0'/></default></default>",
      o.step_s, down * std::cos(rig.floor.downhill_rad), down * std::sin(rig.floor.downhill_rad),
      -std::cos(rig.floor.slope_rad) * kGravity_mps2, o.integrator, o.cone, o.impratio, o.contact_time_s,
      o.contact_damping_ratio, o.impedance, (1 + o.impedance) / 2);
}

}  // namespace

TyreFriction tyre_friction(const Wheel& wheel, const MujocoOptions& o, double friction) {
  const double patch_m = has_edges(o) ? 0 : wheel.patch_width_m / 4;
  const double torsion_m = (o.condim >= 4 ? o.torsion_m : 0) + patch_m;
  const double sliding = std::max(friction, kLeastFriction);
  return {sliding, sliding * torsion_m, o.condim >= 6 ? sliding * o.rolling_m : 0};
}

std::string model_xml(const Rig& rig, const MujocoOptions& o, const Pose2& X_WB) {
  const RobotModel& r = rig.robot;
  std::string xml = head(rig, o) + "<worldbody>" + supports_floor(rig);
  for (const Cable& c : rig.floor.cables) xml += cable(c);
  const double floor_m = floor_at(rig.floor, X_WB.x_m, X_WB.y_m).height_m;
  const double height_m = std::max(r.wheels[0].radius_m, r.wheels[1].radius_m) + floor_m;
  xml += fmt::format("<body name='base' pos='{} {} {}' euler='0 0 {}'><freejoint name='base'/>{}", X_WB.x_m, X_WB.y_m,
                     height_m, X_WB.theta_rad, inertial(r.base, Eigen::Vector3d::Zero()));
  for (std::size_t i = 0; i < r.casters.size(); ++i) {
    const int support = 2 + int(i);
    xml += r.casters[i].swivels ? swivel(r.casters[i], support, rig.floor.friction) : ball(r.casters[i], support);
  }
  for (int i = 0; i < 2; ++i) xml += wheel_body(i, rig, o);
  xml += "</body></worldbody><actuator>";
  for (int i = 0; i < 2; ++i) xml += motor(i, rig, o);
  return xml + "</actuator></mujoco>";
}

}  // namespace umbsim::worlds::mujoco

#include "experiment/scenario/robot_choice.h"

namespace umbsim {
namespace {

SuspensionChoice read_suspension(const YamlValue& value) {
  YamlMap map(value);
  SuspensionChoice s;
  const Bounds travel = Bounds::between(0, 0.5);
  if (map.has("wheel_travel_m")) s.wheel_travel_m = map.number("wheel_travel_m", travel);
  if (map.has("caster_travel_m")) s.caster_travel_m = map.number("caster_travel_m", travel);
  s.damping_ratio = map.number("damping_ratio", s.damping_ratio, {0, 10, true});
  map.finish();
  return s;
}

}  // namespace

RobotChoice read_robot(const YamlValue& value) {
  YamlMap map(value);
  RobotChoice r;
  r.urdf = map.string("urdf", r.urdf);
  r.joints.left = map.string("left_joint", "");
  r.joints.right = map.string("right_joint", "");
  if (map.has("wheel_radius_m")) r.wheel_size.radius_m = map.number("wheel_radius_m", {0, 10, true});
  if (map.has("wheel_width_m")) r.wheel_size.width_m = map.number("wheel_width_m", {0, 10, true});
  if (const auto v = map.find("suspension")) r.suspension = read_suspension(*v);
  r.caster_friction = map.number("caster_friction", r.caster_friction, Bounds::between(0, 2));
  r.torque_limit_nm = map.number("torque_limit_nm", r.torque_limit_nm, Bounds::at_least(0));
  map.finish();
  return r;
}

}  // namespace umbsim

#include "bench/worlds/checks/robots.h"

#include "effects/geometry.h"

namespace umbsim::worlds {
namespace {

struct Build {
  double radius_m, wheelbase_m, mass_kg, caster_ahead_m, wheel_kg, wheel_width_m;
};

Build build_of(Size size) {
  switch (size) {
    case Size::small:
      return {0.035, 0.2, 3, 0.08, 0.06, 0.02};
    case Size::large:
      return {0.1, 0.52, 90, 0.4, 2.5, 0.04};
    case Size::middle:
      break;
  }
  return {0.075, 0.34, 40, 0.25, 1, 0.03};  // the LabMate's size
}

Wheel wheel(const Build& b, const char* joint, double y_m) {
  Wheel w;
  w.joint = joint;
  w.centre_m = {0, y_m, 0};
  w.radius_m = b.radius_m;
  w.width_m = b.wheel_width_m;
  w.mass_kg = b.wheel_kg;
  w.spin_inertia_kgm2 = b.wheel_kg * b.radius_m * b.radius_m / 2;
  w.transverse_inertia_kgm2 = b.wheel_kg * (3 * b.radius_m * b.radius_m + b.wheel_width_m * b.wheel_width_m) / 12;
  w.effort_limit_nm = 0.7 * b.mass_kg * b.radius_m * 9.81;
  return w;
}

}  // namespace

const char* name(Size size) {
  switch (size) {
    case Size::small:
      return "3 kg";
    case Size::large:
      return "90 kg";
    case Size::middle:
      break;
  }
  return "40 kg";
}

Rig plain_rig(Size size, double payload_kg) {
  const Build b = build_of(size);
  Rig rig;
  RobotModel& r = rig.robot;
  r.name = name(size);
  const double sway = b.mass_kg * b.wheelbase_m * b.wheelbase_m;
  r.base.mass_kg = b.mass_kg;
  r.base.com_m = {0.24 * b.caster_ahead_m, 0, 0.5 * b.radius_m};
  r.base.inertia_kgm2 = Eigen::Vector3d(0.2 * sway, 0.2 * sway, 0.3 * sway).asDiagonal();
  r.wheels = {wheel(b, "left", b.wheelbase_m / 2), wheel(b, "right", -b.wheelbase_m / 2)};
  Caster ball;
  ball.link = "ball";
  ball.radius_m = 0.4 * b.radius_m;
  ball.centre_m = {b.caster_ahead_m, 0, ball.radius_m - b.radius_m};
  r.casters.push_back(ball);
  rig.drivetrain = Drivetrain(r.wheels[0].effort_limit_nm);
  LoadShift payload;
  payload.payload_kg = payload_kg;
  payload.ahead_m = r.base.com_m.x();
  payload.height_m = r.base.com_m.z();
  apply(payload, rig);
  return rig;
}

}  // namespace umbsim::worlds

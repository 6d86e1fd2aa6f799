#include "bench/fidelity/steps.h"

#include <fmt/format.h>

#include <cmath>

#include "bench/fidelity/contact/cable.h"
#include "bench/fidelity/table.h"
#include "core/pose2.h"
#include "umbmark/course.h"

namespace umbsim::fidelity {
namespace {

const char* const kText = R"(## 2. Convergence in the step

Each drive with steps of 20 to 1 ms (the cable with `fine_step_s` of 4 to 0.25 ms), LabMate, default settings. "Off":
distance and heading of the end point from the same drive with a much smaller step; for the square from exact kinematics
of the same wheel angles. The order is the slope of log(distance) over log(step) from the longest to the shortest step.

- square: 4 m, clockwise, driven on its own odometry without quantisation
- cable: 10 mm under the left wheel at 0.2 m/s
- uneven floor: 2.4 m straight over 0.5 mm rms at 0.3 m wavelength
- swivelling caster: forward, back, and forward again on curves; trail 30 mm
- braking slide: locked wheels from 1 m/s on friction 0.2

)";

// On its own odometry, exact wheel angles. Returns odometry^-1 * truth.
Pose2 drive_square(const PhysicsOptions& options, double side_m) {
  const RobotModel robot = labmate();
  World world(robot, {20}, {}, options);
  world.place({});
  Course course;
  course.side_m = side_m;
  const Plan plan(course, Direction::cw);
  const double R = robot.wheels[0].radius_m, b = robot.wheelbase_m();
  Pose2 X_OB;
  double left = 0, right = 0;
  int segment = 0;
  for (int k = 0; k * 0.02 < plan.duration_s(); ++k) {
    segment = plan.at(k * 0.02, segment).segment;
    const WheelSpeeds w = umbsim::drive(plan, k * 0.02, 0.02, X_OB, {R, R, b}, segment);
    world.command(w.left_radps, w.right_radps);
    world.advance(0.02);
    const double dl = world.wheel_angle(0) - left, dr = world.wheel_angle(1) - right;
    X_OB = X_OB * arc(R * (dl + dr) / 2, R * (dr - dl) / b);
    left += dl;
    right += dr;
  }
  return inverse(X_OB) * world.pose();
}

Pose2 cross_cable(const PhysicsOptions& options) {
  CableCase c;
  c.robot = labmate();
  c.options = options;
  return cross(c).X_WB;
}

Pose2 drive_uneven(const PhysicsOptions& options) {
  Floor floor;
  floor.ripples = random_ripples(0.0005, 0.3, 1, 0);
  World world(labmate(), {20}, floor, options);
  world.place({});
  trip(world, 4, 4, 7);
  return world.pose();
}

RobotModel with_swivelling_caster() {
  RobotModel robot = labmate();
  robot.base.com_m.x() *= -1;
  Caster caster;
  caster.link = "caster_wheel";
  caster.swivels = true;
  caster.radius_m = 0.03;
  caster.swivel_point_m = {-0.25, 0, 0};
  caster.centre_m = {-0.28, 0, 0.03 - robot.wheels[0].radius_m};
  caster.fork = {0.2, {-0.27, 0, -0.02}, Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal()};
  caster.wheel_mass_kg = 0.3;
  caster.wheel_spin_inertia_kgm2 = 1.35e-4;
  caster.wheel_transverse_inertia_kgm2 = 6.75e-5;
  robot.casters = {caster};
  return robot;
}

Pose2 swivel(const PhysicsOptions& options) {
  World world(with_swivelling_caster(), {20}, {}, options);
  world.place({});
  trip(world, 2, 2.6, 3);
  trip(world, -2, -2.4, 3);
  trip(world, 2.5, 2, 3);
  return world.pose();
}

Pose2 braking_slide(const PhysicsOptions& options) {
  Floor floor;
  floor.friction = 0.2;
  World world(labmate(), {200}, floor, options);
  world.place({});
  for (int i = 1; i <= 60; ++i) hold(world, 0.22 * i, 0.2 * i, 0.02);
  hold(world, 0, 0, 1.5);
  return world.pose();
}

Pose2 end_of(Drive drive, double step_s, Grid grid) {
  PhysicsOptions options;
  if (drive == Drive::cable) options.fine_step_s = step_s;
  else options.step_s = step_s;
  switch (drive) {
    case Drive::square: return drive_square(options, grid == Grid::full ? 4 : 1);
    case Drive::cable: return cross_cable(options);
    case Drive::uneven_floor: return drive_uneven(options);
    case Drive::swivelling_caster: return swivel(options);
    case Drive::braking_slide: return braking_slide(options);
  }
  return {};
}

}  // namespace

Convergence converge(Drive drive, Grid grid) {
  std::vector<double> steps_s{0.020, 0.010, 0.005, 0.002, 0.001};
  double reference_s = 0.0000625;
  if (drive == Drive::cable) steps_s = {0.004, 0.002, 0.001, 0.0005, 0.00025}, reference_s = 0.000015625;
  if (grid == Grid::coarse) steps_s = {steps_s[0], steps_s[2], steps_s[4]}, reference_s *= 2;
  Convergence c;
  Pose2 goal;
  if (drive != Drive::square) {
    c.reference_s = reference_s;
    goal = end_of(drive, reference_s, grid);
  }
  for (const double step_s : steps_s) {
    const Pose2 X_WB = end_of(drive, step_s, grid);
    c.runs.push_back({step_s, std::hypot(X_WB.x_m - goal.x_m, X_WB.y_m - goal.y_m), X_WB.theta_rad - goal.theta_rad});
  }
  c.order = std::log(c.runs.front().off_m / c.runs.back().off_m) /
            std::log(c.runs.front().step_s / c.runs.back().step_s);
  return c;
}

std::string steps_chapter(Grid grid) {
  Table table({"drive", "step", "off", "heading off", "order"});
  for (const auto& [name, which] :
       {std::pair{"square", Drive::square}, std::pair{"cable", Drive::cable},
        std::pair{"uneven floor", Drive::uneven_floor}, std::pair{"swivelling caster", Drive::swivelling_caster},
        std::pair{"braking slide", Drive::braking_slide}}) {
    const Convergence c = converge(which, grid);
    for (const StepRun& run : c.runs) {
      const bool last = &run == &c.runs.back();
      const std::string order = which == Drive::square ? "round-off" : fmt::format("{:.2f}", c.order);
      table.row({name, fmt::format("{} ms", 1000 * run.step_s), fmt::format("{:.2g} mm", 1000 * run.off_m),
                 fmt::format("{:.1e}°", degrees(run.off_rad)), last ? order : ""});
    }
  }
  return kText + table.text();
}

}  // namespace umbsim::fidelity

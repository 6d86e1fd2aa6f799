#include "bench/fidelity/contact/loads.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "bench/fidelity/table.h"
#include "sim/model/inertia.h"

namespace umbsim::fidelity {
namespace {

using Eigen::Vector3d;

struct LoadCase {
  RobotModel robot;
  double slope_rad = 0;
  double heading_rad = 0;        ///< against downhill
  double acceleration_mps2 = 0;  ///< forward
};

// Three loads from the sum and from both moments about the centre of pressure.
Vector3d statics(const LoadCase& c) {
  const Body b = body_of(c.robot);
  const double weight_n = b.mass_kg * kG_mps2 * std::cos(c.slope_rad);
  const double lean_m = b.com_m.z() * std::tan(c.slope_rad);
  const double a = c.acceleration_mps2;
  const double back_nm = b.mass_kg * a * b.com_m.z() + 2 * b.spin_kgm2 * a / b.radius_m;
  const double x_m = b.com_m.x() + lean_m * std::cos(c.heading_rad) - back_nm / weight_n;
  const double y_m = b.com_m.y() - lean_m * std::sin(c.heading_rad);
  Eigen::Matrix3d arms;
  arms << 1, 1, 1, 0, 0, b.ball_x_m, b.half_m, -b.half_m, b.ball_y_m;
  return arms.inverse() * Vector3d(weight_n, weight_n * x_m, weight_n * y_m);
}

Vector3d simulated(const LoadCase& c, const PhysicsOptions& options) {
  Floor floor;
  floor.slope_rad = c.slope_rad;
  World world(c.robot, {20}, floor, options);
  world.place({0, 0, c.heading_rad});
  const double change_radps = c.acceleration_mps2 * 0.02 / c.robot.wheels[0].radius_m;
  for (int i = 1; i <= 50 && change_radps != 0; ++i) hold(world, i * change_radps, i * change_radps, 0.02);
  return {world.loads().wheel_n[0], world.loads().wheel_n[1], world.loads().caster_n[0]};
}

std::vector<LoadCase> moved_centre(const RobotModel& robot, int n) {
  std::vector<LoadCase> cases;
  const double ball_m = robot.casters[0].centre_m.x(), half_m = robot.wheelbase_m() / 2;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      LoadCase c{robot};
      const double part = 0.15 + 0.5 * i / (n - 1);  // of the way to the ball
      c.robot.base.com_m.x() = part * ball_m;
      c.robot.base.com_m.y() = (1 - part) * half_m * 0.7 * (2.0 * j / (n - 1) - 1);
      cases.push_back(c);
    }
  }
  return cases;
}

std::vector<LoadCase> slopes(const RobotModel& robot, int n) {
  std::vector<LoadCase> cases;
  for (const double slope_deg : {2.0, 5.0, 8.0}) {
    for (int j = 0; j < 2 * n; ++j) cases.push_back({robot, slope_deg * M_PI / 180, M_PI * j / n});
  }
  return cases;
}

std::vector<LoadCase> payloads(const RobotModel& robot, int n) {
  std::vector<LoadCase> cases;
  for (const double share : {0.1, 0.5, 1.0}) {
    for (int j = 0; j < n; ++j) {
      LoadCase c{robot};
      const double m = share * robot.base.mass_kg;
      const Vector3d at(0.4 * robot.casters[0].centre_m.x(), 0.05 * (2.0 * j / (n - 1) - 1), 0.1);
      c.robot.base = lumped(robot.base, {m, at, Eigen::Matrix3d::Identity() * m * 0.01});
      cases.push_back(c);
    }
  }
  return cases;
}

std::vector<LoadCase> accelerations(const RobotModel& robot) {
  std::vector<LoadCase> cases;
  for (const double a : {-1.0, -0.5, -0.25, 0.25, 0.5, 1.0}) cases.push_back({robot, 0, 0, a});
  return cases;
}

std::vector<LoadCase> cases_of(const RobotModel& robot, LoadGrid which, Grid grid) {
  const int n = grid == Grid::full ? 7 : 3;
  if (which == LoadGrid::centre_of_mass) return moved_centre(robot, n);
  if (which == LoadGrid::slope) return slopes(robot, n);
  if (which == LoadGrid::payload) return payloads(robot, n);
  return accelerations(robot);
}

constexpr const char* kLoadsText = R"(## 4. Wheel loads against statics

Three supports: the loads follow from their sum and two moments. Their centre of pressure is the point below the centre
of mass, moved downhill by h tan α on a slope, and back by (m a h + 2 I_w a / R) / (m g) when the robot accelerates (the
wheels' spin takes its share). So the ball, at distance L ahead of the axle, loses m a h / L + 2 I_w a / (R L).

Worst difference of any support's load from this, as a share of the robot's weight. Centre of mass: a grid from 15 to
65 % of the way from axle to ball and to both sides; slopes of 2, 5 and 8° in all directions; payloads of 10, 50 and 100 %
of the base; accelerations up to ±1 m/s². Softness tilts the robot by what its springs give.

)";

}  // namespace

LoadCheck check_loads(const RobotModel& robot, LoadGrid which, Grid grid, const PhysicsOptions& options) {
  LoadCheck check;
  for (const LoadCase& c : cases_of(robot, which, grid)) {
    const double weight_n = body_of(c.robot).mass_kg * kG_mps2;
    check.worst = std::max(check.worst, (simulated(c, options) - statics(c)).cwiseAbs().maxCoeff() / weight_n);
    ++check.cases;
  }
  return check;
}

std::string loads_chapter(Grid grid) {
  Table table({"robot", "grid", "cases", "rigid", "default contacts"});
  for (const auto& [name, robot] : {std::pair{"LabMate", labmate()}, std::pair{"OptiOdom", optiodom()}}) {
    for (const auto& [text, which] :
         {std::pair{"centre of mass", LoadGrid::centre_of_mass}, std::pair{"slope", LoadGrid::slope},
          std::pair{"payload", LoadGrid::payload}, std::pair{"acceleration", LoadGrid::acceleration}}) {
      const LoadCheck hard = check_loads(robot, which, grid, rigid());
      const LoadCheck soft = check_loads(robot, which, grid, {});
      table.row({name, text, std::to_string(hard.cases), fmt::format("{:.1e}", hard.worst),
                 fmt::format("{:.1e}", soft.worst)});
    }
  }
  return kLoadsText + table.text();
}

}  // namespace umbsim::fidelity

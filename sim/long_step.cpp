// One time step of any length, where it is as good as many short ones.
#include <algorithm>
#include <cmath>

#include "sim/world_state.h"

namespace umbsim {
namespace {

constexpr double kSame_radps = 1e-9;

}  // namespace

// A wheel's rim, its play and its spring, and what lies on the floor, change along the way that the robot rolls.
bool World::State::one_step_will_do(double step_s, const std::array<double, 2>& target_radps) const {
  if (sprung || off_centre() || !floor.ripples.empty() || !floor.patches.empty() || !pushes.empty()) return false;
  for (const Motor& m : drivetrain.motor) {
    if (m.backlash_rad > 0 || m.droop_radps_per_nm > 0 || m.torque_limit_nm <= 0) return false;
  }
  if (floor.cables.empty()) return true;
  const double fastest_radps = std::max(std::abs(target_radps[0]), std::abs(target_radps[1]));
  const double radius_m = std::max(robot.wheels[0].radius_m, robot.wheels[1].radius_m);
  return !near_cable(kSpeculative_m + fastest_radps * radius_m * step_s, 0);
}

// Back to where it was if a motor gives way or a wheel slides, or would with what accelerates the robot by `peak_mps2`
// on it.
bool World::State::roll(double step_s, const std::array<double, 2>& target_radps, double peak_mps2) {
  const DofVector before = body.velocity();
  const ContactsBefore contacts_then = contacts_before();
  as_after_one_of(step_s);
  find_speeds(step_s, target_radps);
  const DofVector& u = body.velocity();
  const bool held = std::abs(u[6] - target_radps[0]) < kSame_radps && std::abs(u[7] - target_radps[1]) < kSame_radps;
  if (held && !slides(robot.total_mass_kg() * peak_mps2 * step_s)) {
    move_on(step_s, target_radps);
    return true;
  }
  body.set_velocity(before);
  begin_from(contacts_then);
  return false;
}

// A step's speed is that of its middle, seen from the robot where it ends. Before a step of another length it is turned
// to what it would be after one of that length: else what bends the robot's way in one would push it in the other.
void World::State::as_after_one_of(double step_s) {
  DofVector u = body.velocity();
  const Eigen::Vector3d turn = (last_step_s - step_s) * u.head<3>();
  const double angle_rad = turn.norm();
  if (angle_rad == 0) return;
  const Eigen::AngleAxisd ahead(angle_rad, turn / angle_rad);
  u.segment<3>(3) = ahead * u.segment<3>(3);
  body.set_velocity(u);
}

// The same motion at the speed that goes with these of the wheels, which roll.
void World::State::end_at(const std::array<double, 2>& wheel_radps) {
  DofVector u = body.velocity();
  std::array<double, 2> more_mps{};
  for (std::size_t i = 0; i < 2; ++i) {
    double& now = u[6 + Eigen::Index(i)];
    more_mps[i] = rolling_radius(supports[i]) * (wheel_radps[i] - now);
    now = wheel_radps[i];
  }
  const Eigen::Vector3d turning = (more_mps[1] - more_mps[0]) / robot.wheelbase_m() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axle = 0.5 * (robot.wheels[0].centre_m + robot.wheels[1].centre_m);
  u.head<3>() += turning;
  u.segment<3>(3) +=
      0.5 * (more_mps[0] + more_mps[1]) * Eigen::Vector3d::UnitX() + turning.cross(body.centre_of_mass() - axle);
  body.set_velocity(u);
}

bool World::roll(const std::array<double, 2>& mean_radps, double duration_s, double peak_mps2) {
  State& s = *state_;
  if (!s.one_step_will_do(duration_s, mean_radps) || !s.roll(duration_s, mean_radps, peak_mps2)) return false;
  s.end_at(s.command_radps);
  s.by_rolling = true;
  s.set_point_radps = s.last_command_radps = s.command_radps;
  return true;
}

}  // namespace umbsim

#include <cstdlib>
#include <filesystem>

#include "experiment/scenario.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

std::string robots_directory() {
  const char* chosen = std::getenv("UMBSIM_ROBOTS");
  return chosen ? chosen : UMBSIM_ROBOTS_DIR;
}

}  // namespace

std::string scenario_urdf(const Scenario& s) {
  const fs::path given = s.robot.urdf;
  if (given.is_absolute()) return given;
  const fs::path beside = fs::path(s.file).parent_path() / given;
  if (fs::exists(beside)) return beside;
  return fs::path(robots_directory()) / given;
}

RobotModel load_scenario_robot(const Scenario& scenario) {
  RobotModel robot = load_robot(scenario_urdf(scenario), scenario.robot.joints);
  for (Caster& caster : robot.casters) caster.friction = scenario.robot.caster_friction;
  return robot;
}

OdometryParameters initial_odometry(const Scenario& s, const RobotModel& nominal) {
  return {s.odometry.left_radius_m.value_or(nominal.wheels[0].radius_m),
          s.odometry.right_radius_m.value_or(nominal.wheels[1].radius_m),
          s.odometry.wheelbase_m.value_or(nominal.wheelbase_m()), s.encoders.ticks_per_revolution};
}

}  // namespace umbsim

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "core/data_folder.h"
#include "core/text/text_file.h"
#include "experiment/scenario/robots.h"
#include "experiment/scenario/scenario.h"
#include "recording/names.h"
#include "sim/urdf/completed.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string robots_directory() {
  const char* chosen = std::getenv("UMBSIM_ROBOTS");
  return chosen ? chosen : data_folder("robots").string();
}

std::string scenario_urdf(const Scenario& s) {
  const fs::path given = s.robot.urdf;
  if (given.is_absolute()) return given;
  const fs::path beside = fs::path(s.file).parent_path() / given;
  if (fs::exists(beside)) return beside;
  return fs::path(robots_directory()) / given;
}

std::string scenario_urdf_text(const Scenario& s) {
  const std::string file = scenario_urdf(s);
  return urdf_with_wheels(read_text_file(file, kMaxUrdfBytes), load_robot(file, s.robot.joints, s.robot.wheel_size));
}

void write_scenario(Scenario s, const fs::path& file) {
  const std::string text = scenario_urdf_text(s);
  s.robot.urdf = urdf_copy_name(s.robot.urdf);
  write_text_file(file.parent_path() / s.robot.urdf, text);
  write_text_file(file, resolved_yaml(s));
}

RobotModel load_scenario_robot(const Scenario& s, std::vector<Remark>* remarks) {
  RobotModel robot = load_robot(scenario_urdf(s), s.robot.joints, s.robot.wheel_size, remarks);
  for (Caster& caster : robot.casters) caster.friction = s.robot.caster_friction;
  suspend(robot, s.robot.suspension, s.physics.gravity_mps2, s.noise.floor_rms_m, remarks);
  return robot;
}

std::vector<std::string> assumed_of_robot(const Scenario& s) {
  std::vector<Remark> remarks;
  load_robot(scenario_urdf(s), s.robot.joints, s.robot.wheel_size, &remarks);
  std::vector<std::string> warnings;
  for (const Remark& r : remarks) {
    if (r.kind == Remark::Kind::assumed)
      warnings.push_back(fmt::format("{}: {}", fs::path(s.robot.urdf).filename().string(), r.text));
  }
  return warnings;
}

OdometryParameters initial_odometry(const Scenario& s, const RobotModel& nominal) {
  return {s.odometry.left_radius_m.value_or(nominal.wheels[0].radius_m),
          s.odometry.right_radius_m.value_or(nominal.wheels[1].radius_m),
          s.odometry.wheelbase_m.value_or(nominal.wheelbase_m()), s.encoders.ticks_per_revolution, s.odometry.scrub};
}

}  // namespace umbsim

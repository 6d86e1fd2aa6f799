#include "exchange/import/wheels/robot_numbers.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.h"
#include "core/text/text_file.h"
#include "recording/names.h"
#include "sim/model/robot_model.h"

namespace umbsim::exchange {

RecordedRobot robot_numbers(ImportOptions& o, std::vector<std::string>& found) {
  RecordedRobot robot;
  if (!o.robot_file.empty()) {
    const RobotModel model = load_robot(o.robot_file, {o.left_joint, o.right_joint});
    robot.urdf = urdf_copy_name(o.robot_file);
    robot.urdf_text = read_text_file(o.robot_file, kMaxUrdfBytes);
    robot.left_joint = o.left_joint;
    robot.right_joint = o.right_joint;
    robot.wheel_radius_m = (model.wheels[0].radius_m + model.wheels[1].radius_m) / 2;
    robot.wheelbase_m = model.wheelbase_m();
    o.left_joint = model.wheels[0].joint;
    o.right_joint = model.wheels[1].joint;
    found.push_back(fmt::format("robot: {}: wheel radius {:g} m, wheelbase {:g} m, joints '{}' and '{}'",
                                std::filesystem::path(o.robot_file).filename().string(), robot.wheel_radius_m,
                                robot.wheelbase_m, o.left_joint, o.right_joint));
  }
  if (o.wheel_radius_m) robot.wheel_radius_m = *o.wheel_radius_m;
  if (o.wheelbase_m) robot.wheelbase_m = *o.wheelbase_m;
  if (o.ticks_per_revolution) robot.ticks_per_revolution = *o.ticks_per_revolution;
  if (robot.wheelbase_m > 0) o.wheelbase_m = robot.wheelbase_m;
  return robot;
}

void require_numbers(const RecordedRobot& robot, const Log& log) {
  std::string missing;
  const auto need = [&](bool there, const char* what, const char* option) {
    if (!there) missing += fmt::format("{}the {}: give {}", missing.empty() ? "" : "; ", what, option);
  };
  need(robot.wheel_radius_m > 0, "wheel radius", "--wheel-radius METRES or --robot FILE.urdf");
  need(robot.wheelbase_m > 0, "wheelbase", "--wheelbase METRES or --robot FILE.urdf");
  const bool counts = log.left.unit == WheelUnit::ticks || log.right.unit == WheelUnit::ticks;
  need(robot.ticks_per_revolution > 0 || !counts, "ticks per revolution of a wheel", "--ticks-per-revolution N");
  if (!missing.empty()) throw InputError("the source does not say " + missing);
}

}  // namespace umbsim::exchange

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/help/help.h"
#include "cli/output/tables.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "experiment/robot/understood.h"

namespace umbsim {
namespace {

struct RobotArguments {
  std::string urdf;
  std::string picture;
  RobotChoice choice;
  double floor_rms_m = 0;
  double friction = 0.9;
};

void understand(RobotArguments& a) {
  Scenario scenario;
  scenario.robot = a.choice;
  scenario.robot.urdf = a.urdf;
  scenario.noise.floor_rms_m = a.floor_rms_m;
  scenario.floor_friction = a.friction;
  const UnderstoodRobot robot = understand_robot(scenario);
  if (!a.picture.empty()) replace_text_file(a.picture, robot_picture(robot));
  fmt::print("{}", wrapped_lines(understood_text(robot), 4));
  if (!a.picture.empty()) fmt::print("{}", wrapped("Picture in " + a.picture));
}

}  // namespace

void add_robot_command(CLI::App& app) {
  const auto a = std::make_shared<RobotArguments>();
  CLI::App* command = app.add_subcommand("robot", "Say what the program makes of a robot's URDF, and what is wrong");
  command->add_option("urdf", a->urdf, "URDF: a file or a shipped one, as labmate.urdf")->required();
  command->add_option("--left-joint", a->choice.joints.left, "Left drive joint, where the URDF does not tell");
  command->add_option("--right-joint", a->choice.joints.right, "Right drive joint");
  command->add_option("--wheel-radius", a->choice.wheel_size.radius_m, "Radius of the drive wheels, m")
      ->check(CLI::Range(1e-6, 10.));
  command->add_option("--wheel-width", a->choice.wheel_size.width_m, "Width of the drive wheels, m")
      ->check(CLI::Range(1e-6, 10.));
  command->add_option("--floor-rms", a->floor_rms_m, "Root mean square height of the floor, m, for the suspension")
      ->check(CLI::Range(0., 0.02));
  command->add_option("--friction", a->friction, "Of the floor")->check(CLI::Range(1e-3, 5.));
  command->add_option("--picture", a->picture, "Write a picture from above and from the side (SVG)");
  add_example(command, "umbsim robot labmate.urdf --picture robot.svg");
  command->callback([a] { understand(*a); });
}

}  // namespace umbsim

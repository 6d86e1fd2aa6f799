#include "bench/worlds/world/robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/text/text_file.h"
#include "gap/trial/draw/platform.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

constexpr double kFromFolder = 0.25;  // share of robots that come from a file
constexpr double kLightest_kg = 2, kHeaviest_kg = 200;
constexpr double kSmallest_m = 0.03, kLargest_m = 0.15;
constexpr double kFewestTicks = 200, kMostTicks = 20000;
constexpr double kQuadrature = 4;  // counts a line
// The LabMate's own, from which motors are scaled.
constexpr double kLabmateMass_kg = 40, kLabmateEffort_nm = 20;
constexpr double kWheelShare = 0.025;  // of the base's mass
constexpr double kCasterRadius = 0.4;  // of the wheel's
constexpr double kTrail = 0.5;         // of a swivelling caster, in radii of its wheel
constexpr std::size_t kMaxUrdfBytes = 16 * 1024 * 1024;

double log_uniform(RandomStream& random, double min, double max) { return min * std::pow(max / min, random.uniform()); }

std::string cylinder_inertia(double mass, double radius, double width) {
  const double spin = mass * radius * radius / 2, across = mass * (3 * radius * radius + width * width) / 12;
  return fmt::format(
      "<inertial><mass value=\"{:.6f}\"/><inertia ixx=\"{:.9f}\" ixy=\"0\" ixz=\"0\" iyy=\"{:.9f}\" iyz=\"0\" "
      "izz=\"{:.9f}\"/></inertial>",
      mass, across, spin, across);
}

std::string cylinder_shape(double radius, double width) {
  return fmt::format(
      "<collision><origin rpy=\"1.5707963267948966 0 0\"/><geometry><cylinder radius=\"{:.5f}\" length=\"{:.5f}\"/>"
      "</geometry></collision>",
      radius, width);
}

std::string joint(const std::string& name, const char* type, const std::string& parent, const std::string& child,
                  const std::string& xyz, const char* axis, double effort_nm) {
  std::string text = fmt::format(
      "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/><child link=\"{}\"/><origin xyz=\"{}\"/>\n", name,
      type, parent, child, xyz);
  if (axis[0] != '\0') text += fmt::format("    <axis xyz=\"{}\"/>\n", axis);
  if (effort_nm > 0) text += fmt::format("    <limit effort=\"{:.4f}\" velocity=\"60\"/>\n", effort_nm);
  return text + "  </joint>\n";
}

std::string drive_wheel(const RobotDimensions& d, const char* side, double y_m) {
  const double effort = kLabmateEffort_nm * d.base_mass_kg / kLabmateMass_kg * d.wheel_radius_m / kLabmateRadius_m;
  const std::string link = fmt::format("{}_wheel", side);
  return fmt::format("  <link name=\"{}\">\n    {}\n    {}\n  </link>\n", link,
                     cylinder_inertia(kWheelShare * d.base_mass_kg, d.wheel_radius_m, d.wheel_width_m),
                     cylinder_shape(d.wheel_radius_m, d.wheel_width_m)) +
         joint(link + "_joint", "continuous", "base_link", link, fmt::format("0 {:.5f} 0", y_m), "0 1 0", effort);
}

std::string ball(const RobotDimensions& d, const std::string& link, double x_m, double y_m) {
  const double radius = kCasterRadius * d.wheel_radius_m;
  return fmt::format(
             "  <link name=\"{}\">\n    <collision><geometry><sphere radius=\"{:.5f}\"/></geometry></collision>\n"
             "  </link>\n",
             link, radius) +
         joint(link + "_joint", "fixed", "base_link", link,
               fmt::format("{:.5f} {:.5f} {:.5f}", x_m, y_m, radius - d.wheel_radius_m), "", 0);
}

// A fork on an upright axis and its wheel, which trails.
std::string swivel(const RobotDimensions& d, double x_m) {
  const double radius = kCasterRadius * d.wheel_radius_m;
  const double fork_kg = 0.01 * d.base_mass_kg, inertia = fork_kg * radius * radius;
  return fmt::format(
             "  <link name=\"fork\">\n    <inertial><mass value=\"{:.6f}\"/><inertia ixx=\"{:.9f}\" ixy=\"0\" "
             "ixz=\"0\" "
             "iyy=\"{:.9f}\" iyz=\"0\" izz=\"{:.9f}\"/></inertial>\n  </link>\n",
             fork_kg, inertia, inertia, inertia) +
         joint("swivel", "continuous", "base_link", "fork",
               fmt::format("{:.5f} 0 {:.5f}", x_m, radius - d.wheel_radius_m), "0 0 1", 0) +
         fmt::format("  <link name=\"caster_wheel\">\n    {}\n    {}\n  </link>\n",
                     cylinder_inertia(fork_kg, radius, 0.5 * radius), cylinder_shape(radius, 0.5 * radius)) +
         joint("caster_wheel_joint", "continuous", "fork", "caster_wheel", fmt::format("{:.5f} 0 0", -kTrail * radius),
               "0 1 0", 0);
}

bool behind(const RobotDimensions& d) { return d.casters == "ball_behind" || d.casters == "swivel_behind"; }

std::string casters(const RobotDimensions& d) {
  const double x_m = behind(d) ? -d.caster_m : d.caster_m;
  if (d.casters.rfind("swivel", 0) == 0) return swivel(d, x_m);
  if (d.casters != "two_balls") return ball(d, "caster", x_m, 0);
  return ball(d, "left_caster", x_m, d.wheelbase_m / 3) + ball(d, "right_caster", x_m, -d.wheelbase_m / 3);
}

std::vector<fs::path> urdf_files(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

RobotDimensions draw_dimensions(RandomStream& random) {
  RobotDimensions d;
  d.base_mass_kg = rounded(log_uniform(random, kLightest_kg, kHeaviest_kg), 0.01);
  const double share = std::log(d.base_mass_kg / kLightest_kg) / std::log(kHeaviest_kg / kLightest_kg);
  const double usual_m = kSmallest_m * std::pow(kLargest_m / kSmallest_m, share);
  d.wheel_radius_m = rounded(std::clamp(usual_m * random.uniform(0.75, 1.35), kSmallest_m, kLargest_m), 1e-4);
  d.wheel_width_m = rounded(std::max(0.015, random.uniform(0.25, 0.5) * d.wheel_radius_m), 1e-3);
  d.wheelbase_m = rounded(d.wheel_radius_m * random.uniform(4, 6.5), 1e-4);
  d.casters = kCasterKinds[std::min(std::size_t(4), std::size_t(random.uniform(0, 5)))];
  d.caster_m = rounded(d.wheelbase_m * random.uniform(0.5, 0.9), 1e-3);
  d.mass_centre_share = rounded(random.uniform(0.15, 0.4), 0.01);
  d.mass_centre_height_m = rounded(random.uniform(0, 1.2) * d.wheel_radius_m, 1e-3);
  return d;
}

std::string robot_urdf(const RobotDimensions& d) {
  const double ahead_m = d.mass_centre_share * (behind(d) ? -d.caster_m : d.caster_m);
  const double long_m = 1.5 * d.caster_m, wide_m = 0.9 * d.wheelbase_m, high_m = 2 * d.wheel_radius_m;  // a box
  const auto of_box = [&](double a, double b) { return d.base_mass_kg * (a * a + b * b) / 12; };
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<robot name=\"robot\">\n  <link name=\"base_link\">\n    <inertial><origin "
      "xyz=\"{:.5f} 0 {:.5f}\"/><mass value=\"{:.4f}\"/><inertia ixx=\"{:.8f}\" ixy=\"0\" ixz=\"0\" iyy=\"{:.8f}\" "
      "iyz=\"0\" izz=\"{:.8f}\"/></inertial>\n  </link>\n",
      ahead_m, d.mass_centre_height_m, d.base_mass_kg, of_box(wide_m, high_m), of_box(long_m, high_m),
      of_box(long_m, wide_m));
  text += drive_wheel(d, "left", d.wheelbase_m / 2) + drive_wheel(d, "right", -d.wheelbase_m / 2);
  return text + casters(d) + "</robot>\n";
}

WorldRobot make_robot(const std::string& name, const std::string& urdf, double ticks_per_revolution) {
  const ScratchFolder scratch;
  write_text_file(scratch.path() / kTrialUrdf, urdf);
  return {name, urdf, load_robot((scratch.path() / kTrialUrdf).string()), ticks_per_revolution};
}

WorldRobot draw_robot(const std::string& folder, RandomStream& random) {
  const bool from_folder = random.uniform() < kFromFolder;
  const double which = random.uniform();
  const double ticks = rounded(log_uniform(random, kFewestTicks, kMostTicks), kQuadrature);
  const RobotDimensions drawn = draw_dimensions(random);
  const std::vector<fs::path> files = urdf_files(folder);
  if (!from_folder || files.empty()) return make_robot("drawn", robot_urdf(drawn), ticks);
  const fs::path& file = files[std::min(files.size() - 1, std::size_t(which * double(files.size())))];
  return make_robot(file.filename().string(), read_text_file(file, kMaxUrdfBytes), ticks);
}

}  // namespace umbsim::worlds

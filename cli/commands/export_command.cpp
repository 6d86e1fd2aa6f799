#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/help/help.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "exchange/export/mcap_log.h"
#include "exchange/export/one_log.h"
#include "exchange/export/result.h"
#include "exchange/export/ros2_control.h"
#include "exchange/export/text_logs.h"
#include "exchange/export/urdf_text.h"
#include "experiment/drive/drive_run.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"
#include "experiment/replay/replay.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;
using exchange::Result;

struct ExportArguments {
  std::string result, to, out, robot;
  bool force = false;
};

using Files = std::vector<std::pair<std::string, std::string>>;  // names and texts

/// The URDF that the result or --robot names.
std::string urdf_of(const Result& r, const ExportArguments& a) {
  if (!a.robot.empty()) return a.robot;
  if (!r.twin_file.empty()) return scenario_urdf(read_scenario(r.twin_file));
  if (r.recording && !r.recording->robot.urdf.empty()) return scenario_urdf(scenario_of(*r.recording, r.folder));
  throw InputError(fmt::format("{}: does not carry its robot: give --robot FILE.urdf", r.folder));
}

/// What of the calibration is known, else what the recording believes, else the robot's own dimensions.
OdometryParameters odometry_of(const Result& r, const RobotModel& model) {
  if (r.calibration) return r.calibration->calibrated;
  if (r.recording) return exchange::believed(r.recording->robot);
  return {model.wheels[0].radius_m, model.wheels[1].radius_m, model.wheelbase_m(), 0};
}

const Recording& recording_of(const Result& r, const std::string& to) {
  if (r.recording) return *r.recording;
  throw InputError(
      fmt::format("{}: has no runs to export to {}: give a result of `umbsim run`, or a recording", r.folder, to));
}

std::array<std::string, 2> joints_of(const Result& r, const ExportArguments& a) {
  const bool carried = r.recording && !r.recording->robot.urdf.empty();
  if (a.robot.empty() && !carried) return {"", ""};
  const RobotModel model = load_robot(urdf_of(r, a));
  return {model.wheels[0].joint, model.wheels[1].joint};
}

Files tum(const Recording& recording) {
  Files files;
  for (const RecordedRun& run : recording.runs) {
    files.emplace_back(run.id + ".truth.tum", exchange::truth_tum(run));
    files.emplace_back(run.id + ".odometry.tum", exchange::odometry_tum(run, recording.robot));
  }
  return files;
}

Files mcap(const Recording& recording, std::array<std::string, 2> joints, const std::string& name) {
  if (joints[0].empty()) joints = {"left_wheel_joint", "right_wheel_joint"};
  const std::string file = name + "_0.mcap";
  return {{file, exchange::mcap_log(recording, joints[0], joints[1])},
          {"metadata.yaml", exchange::rosbag2_metadata(recording, file)},
          {"runs.csv", exchange::runs_csv(exchange::one_log(recording))}};
}

// Friction of the floor, creep and slip of the tyres, as the twin has them. Gazebo's slip is a speed per force: creep
// (slip ratio per traction ratio) at the twin's speed and half of the robot's weight; the twin's slip is that itself.
exchange::WheelContact contact_of(const Result& r, const RobotModel& model) {
  if (r.twin_file.empty()) return {};
  const Scenario twin = read_scenario(r.twin_file);
  const Rig rig = rig_for(twin, model, {"export", Direction::cw, false, 0});
  const double mps_per_n = 2 * twin.course.linear_speed_mps / (rig.robot.total_mass_kg() * twin.physics.gravity_mps2);
  const Wheel& w = rig.robot.wheels[0];
  return {rig.floor.friction, mps_per_n * w.creep_along + w.slip_along_mps_per_n,
          mps_per_n * w.creep_across + w.slip_across_mps_per_n};
}

// Read again: joints whose frames are turned against the axle's cannot be moved by their y alone.
void check_urdf(const fs::path& file, const OdometryParameters& odometry) {
  constexpr double kDigits_m = 1e-8;
  const RobotModel model = load_robot(file.string());
  const double off = std::max({std::abs(model.wheels[0].radius_m - odometry.left_radius_m),
                               std::abs(model.wheels[1].radius_m - odometry.right_radius_m),
                               std::abs(model.wheelbase_m() - odometry.wheelbase_m)});
  if (off > kDigits_m) {
    throw InputError(
        fmt::format("{}: radii and wheelbase cannot be set: a wheel joint's frame is turned against its axle",
                    file.filename().string()));
  }
}

Files files_of(const Result& r, const ExportArguments& a) {
  if (a.to == "ros2_control") {
    const auto joints = joints_of(r, a);
    return {{"diff_drive_controller.yaml", exchange::ros2_control_yaml(r, joints[0], joints[1])}};
  }
  if (a.to == "tum") return tum(recording_of(r, a.to));
  if (a.to == "csv") {
    const Recording& recording = recording_of(r, a.to);
    return {{"samples.csv", exchange::samples_csv(recording)},
            {"runs.csv", exchange::runs_csv(exchange::one_log(recording))}};
  }
  if (a.to == "mcap") return mcap(recording_of(r, a.to), joints_of(r, a), r.name);
  const std::string urdf = urdf_of(r, a);
  const RobotModel model = load_robot(urdf);
  const OdometryParameters odometry = odometry_of(r, model);
  if (a.to == "urdf") return {{fs::path(urdf).filename().string(), exchange::calibrated_urdf(urdf, model, odometry)}};
  return {{"diff_drive.sdf", exchange::diff_drive_sdf(model, odometry, contact_of(r, model),
                                                      fmt::format("From {} by umbsim {}", r.name, r.version))}};
}

void export_result(const ExportArguments& a) {
  Result r = exchange::read_result(a.result);
  r.name = folder_name(a.result);
  const Files files = files_of(r, a);
  ResultFolder out(a.out, r.name + "-" + a.to, a.force);
  out.write([&](const fs::path& into) {
    for (const auto& [name, text] : files) write_text_file(into / name, text);
    if (a.to == "urdf") check_urdf(into / files.front().first, odometry_of(r, load_robot(urdf_of(r, a))));
    write_text_file(into / "provenance.json", provenance_json(a.result, 0).dump(2) + "\n");
  });
  std::string names;
  for (const auto& [name, text] : files) names += (names.empty() ? "" : ", ") + name;
  fmt::print("{}", wrapped(fmt::format("Exported to {}: {}", out.said(), names)));
}

}  // namespace

void add_export_command(CLI::App& app) {
  const auto a = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand("export", "Write a result as others read it: ROS 2, Gazebo, evo, tables");
  command->add_option("result", a->result, "Folder of a run, a recording, a calibration or a diagnosis")->required();
  command
      ->add_option("--to", a->to,
                   "Format: ros2_control (calibrated parameters), tum, csv, mcap (runs), urdf, sdf (robot)")
      ->required()
      ->check(CLI::IsMember({"ros2_control", "tum", "csv", "urdf", "sdf", "mcap"}));
  command->add_option("-o,--out", a->out, "Folder for it; default results/<result>-<format>");
  command->add_option("--robot", a->robot, "URDF, where the result does not carry its robot");
  command->add_flag("--force", a->force, "Replace a finished result");
  add_example(command, "umbsim export results/umbmark --to ros2_control");
  command->callback([a] { export_result(*a); });
}

}  // namespace umbsim

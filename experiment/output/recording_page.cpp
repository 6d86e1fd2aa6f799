#include "experiment/output/recording_page.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text/text_file.h"
#include "experiment/output/build_info.h"
#include "experiment/output/scene_json.h"
#include "experiment/scenario/robots.h"
#include "recording/recording.h"
#include "umbmark/figures.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPagePoses = 24000;  // of all runs together, about
constexpr std::size_t kRunPoses = 400;
constexpr std::size_t kFewestPoses = 40;
constexpr std::size_t kMostBytes = std::size_t(64) << 20;

OdometryParameters nominal_of(const RecordedRobot& robot) {
  return {robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, robot.ticks_per_revolution};
}

// Encoder rows up to each absolute pose, as they came.
RunDigest digest_of(const RecordedRun& run, const OdometryParameters& odometry, std::size_t most_poses) {
  Digester digester(odometry, run.truth.size(), most_poses);
  const double per_tick = 2 * M_PI / odometry.ticks_per_revolution;
  std::size_t next = 0;
  for (const TruthSample& truth : run.truth) {
    do {
      digester.add(run.encoders[next]);
    } while (++next < run.encoders.size() && run.encoders[next].time_s <= truth.time_s);
    next = std::min(next, run.encoders.size() - 1);
    const EncoderSample& now = run.encoders[next > 0 ? next - 1 : 0];
    const EncoderSample& first = run.encoders.front();
    WheelMoment wheels;
    wheels.angle_rad = {double(now.left_ticks - first.left_ticks) * per_tick,
                        double(now.right_ticks - first.right_ticks) * per_tick};
    digester.add(truth, {}, wheels);
  }
  return digester.finish(run.id);
}

void add_runs(Json& json, const Recording& recording, const OdometryParameters& odometry, const char* stage,
              std::size_t most_poses) {
  for (const RecordedRun& run : recording.runs) {
    if (run.truth.empty() || run.encoders.empty()) continue;
    const RunDigest digest = digest_of(run, odometry, most_poses);
    Json item{{"id", run.id},
              {"direction", run.direction},
              {"stage", is_bumped(run) ? "bumped" : stage},
              {"error", {{"x_m", digest.error.x_m}, {"y_m", digest.error.y_m}, {"theta_rad", digest.error.theta_rad}}}};
    add_digest(item, digest, nullptr);
    // Angles alone: nobody measured loads.
    for (Json& row : item["wheels"]) row.erase(row.begin() + 2, row.end());
    json["runs"].push_back(std::move(item));
    for (const RecordedBump& b : run.bumps)
      json["bumps"].push_back({{"run", run.id}, {"x_m", b.x_m}, {"y_m", b.y_m}, {"height_m", b.height_m}});
  }
}

// The robot, where its file is there and can be driven.
void add_robot(Json& json, const Recording& recording, const fs::path& folder) {
  if (recording.robot.urdf.empty()) return;
  fs::path file = folder / recording.robot.urdf;
  if (!fs::exists(file)) file = fs::path(robots_directory()) / recording.robot.urdf;
  try {
    const RobotModel model = load_robot(file, {recording.robot.left_joint, recording.robot.right_joint});
    json["robot"] = robot_scene_json(read_text_file(file, kMostBytes), file, model);
  } catch (const InputError&) {  // the page shows the recording without it
  }
}

std::optional<Json> file_json(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  Json json = Json::parse(read_text_file(file, kMostBytes), nullptr, false);
  if (!json.is_object()) throw InputError(file.string() + ": is not a JSON object");
  return json;
}

// What calibration.yaml changes in a scenario.
std::vector<std::string> odometry_settings(const fs::path& file) {
  const std::string text = read_text_file(file, kMostBytes);
  const std::regex line(R"(\n  (left_radius_m|right_radius_m|wheelbase_m): ([-+.0-9e]+))");
  std::vector<std::string> settings;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), line); it != std::sregex_iterator(); ++it)
    settings.push_back("odometry." + it->str(1) + "=" + it->str(2));
  return settings;
}

Json squares_json(const Recording& recording, const OdometryParameters& odometry) {
  Json summary = Json::object();
  const auto has = [&](const char* direction) {
    return std::any_of(recording.runs.begin(), recording.runs.end(), [&](const RecordedRun& run) {
      return run.direction == direction && !is_bumped(run) && !run.truth.empty();
    });
  };
  if (recording.path.shape != "square" || !has("cw") || !has("ccw")) return summary;
  const Umbmark u = umbmark(recording, odometry);
  summary["umbmark"] = umbmark_json(u);
  summary["calibration"] = calibration_json(u, std::nullopt);
  return summary;
}

}  // namespace

Json recording_report_json(const fs::path& folder) {
  const Recording recording = read_recording(folder);
  const fs::path resolved = folder / "scenario.resolved.yaml";
  OdometryParameters odometry = nominal_of(recording.robot);
  std::optional<Scenario> scenario;
  if (fs::exists(resolved)) {
    scenario = read_scenario(resolved.string());
    odometry = initial_odometry(*scenario, load_scenario_robot(*scenario));
  }
  const std::optional<Json> summary = file_json(folder / "summary.json");
  Json json{{"title", recording.title},
            {"description", scenario ? scenario->description : recording.source},
            {"version", build_info().version},
            {"side_m", recording.path.side_m},
            {"wheelbase_m", odometry.wheelbase_m}};
  if (scenario) {
    json["scenario"] = scenario->name;
    json["seed"] = scenario->seed;
  }
  json["summary"] = summary ? *summary : squares_json(recording, odometry);
  if (json["summary"].contains("cost")) json["summary"]["cost"].erase("wall_s");
  json["runs"] = Json::array();
  json["bumps"] = Json::array();
  const bool again = fs::exists(folder / "calibrated" / "recording.yaml") && fs::exists(folder / "calibration.yaml");
  const std::size_t runs = recording.runs.size() * (again ? 2 : 1);
  const std::size_t poses = std::clamp(kPagePoses / std::max<std::size_t>(1, runs), kFewestPoses, kRunPoses);
  add_runs(json, recording, odometry, "before", poses);
  if (again && scenario) {
    const Scenario calibrated = read_scenario(resolved.string(), odometry_settings(folder / "calibration.yaml"));
    add_runs(json, read_recording(folder / "calibrated"), initial_odometry(calibrated, load_scenario_robot(calibrated)),
             "after", poses);
  }
  add_robot(json, recording, folder);
  if (scenario) json["floor"] = floor_scene_json(rig_for(*scenario, load_scenario_robot(*scenario), {}).floor);
  if (auto provenance = file_json(folder / "provenance.json")) {
    provenance->erase("host");
    provenance->erase("input");
    json["provenance"] = *provenance;
  }
  return json;
}

}  // namespace umbsim

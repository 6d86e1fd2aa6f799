#include <fmt/format.h>

#include <map>
#include <set>

#include "core/text/text_file.h"
#include "core/text/yaml_reader.h"
#include "recording/csv.h"
#include "recording/names.h"
#include "recording/read_waypoints.h"
#include "recording/recording.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

// Beyond any wheeled robot or floor: a value out here is a slip of the unit.
const Bounds kLength{0, 1e4, true};
const Bounds kWheel{0, 100, true};
const Bounds kTicks{0, 1e9, true};
const Bounds kSpeed{0, 1e3, true};
const Bounds kRate{0, 1e6, true};
const Bounds kNoise = Bounds::between(0, 1e3);
const Bounds kHeading = Bounds::between(-1e4, 1e4);
const Bounds kPlace = Bounds::between(-1e6, 1e6);
const Bounds kPayload = Bounds::between(0, 1e6);
constexpr std::int64_t kMaxInnerBumps = 1000;
const std::vector<std::string> kTurns = {"in_place", "arc"};

std::optional<double> optional_number(YamlMap& map, const char* key, Bounds bounds) {
  const auto value = map.find(key);
  return value ? std::optional(value->number(bounds)) : std::nullopt;
}

/// A string that `problem` finds nothing wrong with.
std::string checked(const YamlValue& value, std::string (*problem)(const std::string&)) {
  std::string text = value.string();
  const std::string what = problem(text);
  if (!what.empty()) value.fail(fmt::format("'{}' {}", text, what));
  return text;
}

std::string file_name_problem(const std::string& name) {
  if (name.empty() || name == "." || name == ".." || name.find_first_of("/\\") != std::string::npos) {
    return "must be the name of a file in robots/ or beside the recording";
  }
  return "";
}

void check_format(YamlMap& top) {
  const YamlValue format = top.at("format");
  const std::string name = format.string();
  if (name != kRecordingFormat) format.fail(fmt::format("'{}' is not known (must be '{}')", name, kRecordingFormat));
}

// A length of a robot's, for which millimetres are a likely mistake.
double robot_metres(YamlMap& map, const std::string& key) {
  const YamlValue value = map.at(key);
  const double length = value.number();
  if (length <= kWheel.max) return value.number(kWheel);
  value.fail(fmt::format("{:g} is out of range (must be {}, in metres: {:g} if this is millimetres)", length,
                         kWheel.text(), length / 1000));
}

/// The file of the recording that `value` names. Throws if it leaves the recording's folder.
fs::path inner_file(const fs::path& directory, const YamlValue& value, const std::string& name) {
  const std::string problem = link_problem(directory, name);
  if (!problem.empty()) value.fail(fmt::format("'{}' {}", name, problem));
  return directory / name;
}

void read_urdf(const fs::path& directory, const YamlValue& value, RecordedRobot& robot) {
  robot.urdf = checked(value, file_name_problem);
  const fs::path file = inner_file(directory, value, robot.urdf);
  std::error_code ignored;
  if (fs::exists(file, ignored)) robot.urdf_text = read_text_file(file, kMaxUrdfBytes);
}

RecordedRobot read_robot(const fs::path& directory, const YamlValue& value) {
  YamlMap map(value);
  RecordedRobot robot;
  if (const auto urdf = map.find("urdf")) read_urdf(directory, *urdf, robot);
  robot.wheel_radius_m = robot_metres(map, "wheel_radius_m");
  robot.wheelbase_m = robot_metres(map, "wheelbase_m");
  robot.ticks_per_revolution = map.number("ticks_per_revolution", kTicks);
  robot.left_joint = map.string("left_joint", "");
  robot.right_joint = map.string("right_joint", "");
  map.finish();
  return robot;
}

void read_shape(YamlMap& map, RecordedPath& path) {
  path.shape = map.at("shape").choice({"square", "circle", "figure_eight", "path", "free"});
  const auto side = map.find("side_m"), radius = map.find("radius_m"), waypoints = map.find("waypoints_m");
  if (path.shape == "square") path.side_m = map.number("side_m", kLength);
  if (path.shape != "square" && side) side->fail(fmt::format("only a square has a side (shape is {})", path.shape));
  const bool round = path.shape == "circle" || path.shape == "figure_eight";
  if (radius && !round) radius->fail(fmt::format("only circles have a radius (shape is {})", path.shape));
  if (radius) path.radius_m = radius->number(kLength);
  if (waypoints && path.shape != "path")
    waypoints->fail(fmt::format("only a path has waypoints (shape is {})", path.shape));
  if (waypoints) path.waypoints = read_waypoints(*waypoints, kPlace);
}

RecordedPath read_path(const YamlValue& value) {
  YamlMap map(value);
  RecordedPath path;
  read_shape(map, path);
  path.turn = map.choice("turn", path.turn, kTurns);
  path.turn_radius_m = optional_number(map, "turn_radius_m", kLength);
  path.linear_speed_mps = optional_number(map, "linear_speed_mps", kSpeed);
  path.angular_speed_radps = optional_number(map, "angular_speed_radps", kSpeed);
  path.linear_acceleration_mps2 = optional_number(map, "linear_acceleration_mps2", kSpeed);
  path.angular_acceleration_radps2 = optional_number(map, "angular_acceleration_radps2", kSpeed);
  map.finish();
  return path;
}

void read_truth_kind(const YamlValue& value, Recording& recording) {
  YamlMap map(value);
  recording.truth_kind = map.at("kind").choice({"track", "endpoints"});
  recording.truth_position_sd_m = map.number("position_sd_m", 0, kNoise);
  recording.truth_heading_sd_rad = map.number("heading_sd_rad", 0, kNoise);
  map.finish();
}

std::vector<RecordedBump> read_bumps(const YamlValue& value) {
  std::vector<RecordedBump> bumps;
  for (const YamlValue& item : value.list()) {
    YamlMap map(item);
    bumps.push_back({map.number("x_m", kPlace), map.number("y_m", kPlace), map.number("height_m", kLength)});
    map.finish();
  }
  return bumps;
}

void read_encoders(const fs::path& file, RecordedRun& run) {
  CsvReader csv(file, {{"time_s", "left_ticks", "right_ticks"},
                       {"time_s", "left_ticks", "right_ticks", "left_command_radps", "right_command_radps"}});
  run.has_commands = csv.header_index() == 1;
  run.encoders.reserve(csv.estimated_rows());
  while (csv.next_row()) {
    EncoderSample& sample = run.encoders.emplace_back();
    sample.time_s = csv.increasing_time_s();
    sample.left_ticks = csv.integer();
    sample.right_ticks = csv.integer();
    if (!run.has_commands) continue;
    sample.left_command_radps = csv.number();
    sample.right_command_radps = csv.number();
  }
  if (run.encoders.size() < 2) csv.fail_file(fmt::format("has {} rows (must be >= 2)", run.encoders.size()));
}

void read_truth(const fs::path& file, bool endpoints, RecordedRun& run) {
  CsvReader csv(file, {{"time_s", "x_m", "y_m", "theta_rad"}});
  run.truth.reserve(csv.estimated_rows());
  while (csv.next_row()) {
    TruthSample& sample = run.truth.emplace_back();
    sample.time_s = csv.increasing_time_s();
    sample.X_WB.x_m = csv.number();
    sample.X_WB.y_m = csv.number();
    sample.X_WB.theta_rad = csv.number();
  }
  const std::size_t rows = run.truth.size();
  if (rows < 2) csv.fail_file(fmt::format("has {} rows (must be >= 2)", rows));
  if (endpoints && rows != 2) csv.fail_file(fmt::format("has {} rows (must be 2, as truth.kind is endpoints)", rows));
}

void check_shared_clock(const YamlValue& value, const RecordedRun& run) {
  const double encoders_from = run.encoders.front().time_s, encoders_to = run.encoders.back().time_s;
  const double truth_from = run.truth.front().time_s, truth_to = run.truth.back().time_s;
  if (encoders_from < truth_to && truth_from < encoders_to) return;
  value.fail(fmt::format("encoders ({} to {} s) and truth ({} to {} s) do not overlap in time", encoders_from,
                         encoders_to, truth_from, truth_to));
}

void read_overrides(YamlMap& map, RecordedRun& run) {
  run.start_heading_rad = optional_number(map, "start_heading_rad", kHeading);
  run.linear_speed_mps = optional_number(map, "linear_speed_mps", kSpeed);
  if (const auto turn = map.find("turn")) run.turn = turn->choice(kTurns);
  run.turn_radius_m = optional_number(map, "turn_radius_m", kLength);
  run.payload_kg = optional_number(map, "payload_kg", kPayload);
  if (const auto bumps = map.find("bumps")) run.bumps = read_bumps(*bumps);
  if (const auto count = map.find("inner_wheel_bumps")) run.inner_wheel_bumps = int(count->integer(0, kMaxInnerBumps));
}

/// The entries of `runs` one after the other, with what must differ between them.
class RunReader {
 public:
  RunReader(fs::path directory, bool endpoints) : directory_(std::move(directory)), endpoints_(endpoints) {}

  RecordedRun read(const YamlValue& value) {
    YamlMap map(value);
    RecordedRun run;
    const YamlValue id = map.at("id");
    run.id = checked(id, run_id_problem);
    if (!ids_.insert(run.id).second) id.fail(fmt::format("'{}' is the id of an earlier run", run.id));
    run.direction = map.at("direction").choice({"cw", "ccw", "free"});
    read_overrides(map, run);
    const fs::path encoders = file(map.at("encoders"));
    const fs::path truth = file(map.at("truth"));
    map.finish();
    read_encoders(encoders, run);
    read_truth(truth, endpoints_, run);
    check_shared_clock(value, run);
    return run;
  }

 private:
  fs::path file(const YamlValue& value) {
    const std::string name = checked(value, inner_path_problem);
    const fs::path file = inner_file(directory_, value, name);
    const auto [used, is_new] = users_.emplace(fs::weakly_canonical(file), value.path());
    if (!is_new) value.fail(fmt::format("'{}' is the file of {} already", name, used->second));
    return file;
  }

  fs::path directory_;
  bool endpoints_;
  std::set<std::string> ids_;
  std::map<fs::path, std::string> users_;
};

}  // namespace

Recording read_recording(const fs::path& directory) {
  std::error_code ignored;
  if (!fs::is_directory(directory, ignored)) {
    throw InputError(SourceMark{directory.string()}, "is not a recording (a folder with recording.yaml)");
  }
  const fs::path file = directory / "recording.yaml";
  const std::string problem = link_problem(directory, file.filename().string());
  if (!problem.empty()) throw InputError(SourceMark{file.string()}, problem);
  YamlMap top(YamlValue::load(file.string()));
  check_format(top);
  Recording recording;
  recording.title = top.at("title").string();
  recording.source = top.string("source", "");
  recording.robot = read_robot(directory, top.at("robot"));
  recording.path = read_path(top.at("path"));
  YamlMap encoders(top.at("encoders"));
  recording.encoder_rate_hz = encoders.number("rate_hz", kRate);
  encoders.finish();
  read_truth_kind(top.at("truth"), recording);
  const YamlValue runs = top.at("runs");
  top.finish();

  RunReader reader(directory, recording.truth_kind == "endpoints");
  for (const YamlValue& run : runs.list()) recording.runs.push_back(reader.read(run));
  if (recording.runs.empty()) runs.fail("must list at least one run");
  return recording;
}

}  // namespace umbsim

#include "experiment/scenario.h"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxRate_hz = 10000;

RobotChoice read_robot(const YamlValue& value) {
  YamlMap map(value);
  RobotChoice r;
  r.urdf = map.string("urdf", r.urdf);
  r.joints.left = map.string("left_joint", "");
  r.joints.right = map.string("right_joint", "");
  r.caster_friction = map.number("caster_friction", r.caster_friction, Bounds::between(0, 2));
  r.torque_limit_nm = map.number("torque_limit_nm", r.torque_limit_nm, Bounds::at_least(0));
  map.finish();
  return r;
}

EncoderSpec read_encoders(const YamlValue& value) {
  YamlMap map(value);
  EncoderSpec e;
  e.ticks_per_revolution = map.number("ticks_per_revolution", e.ticks_per_revolution, Bounds::between(1, 1e9));
  e.rate_hz = map.number("rate_hz", e.rate_hz, Bounds::between(1, kMaxRate_hz));
  map.finish();
  return e;
}

double read_floor(const YamlValue& value) {
  YamlMap map(value);
  const double friction = map.number("friction", 0.9, {0, 5, true});
  map.finish();
  return friction;
}

Course read_course(const YamlValue& value) {
  YamlMap map(value);
  Course c;
  const Bounds positive = Bounds::positive();
  map.choice("shape", "square", {"square"});
  c.side_m = map.number("side_m", c.side_m, {0, 1000, true});
  c.turn = map.choice("turn", c.turn, {"in_place", "arc"});
  c.turn_radius_m = map.number("turn_radius_m", c.turn_radius_m, positive);
  c.linear_speed_mps = map.number("linear_speed_mps", c.linear_speed_mps, {0, 10, true});
  c.angular_speed_radps = map.number("angular_speed_radps", c.angular_speed_radps, {0, 20, true});
  c.linear_acceleration_mps2 = map.number("linear_acceleration_mps2", c.linear_acceleration_mps2, positive);
  c.angular_acceleration_radps2 = map.number("angular_acceleration_radps2", c.angular_acceleration_radps2, positive);
  c.dwell_s = map.number("dwell_s", c.dwell_s, Bounds::between(0, 60));
  c.laps = int(map.integer("laps", c.laps, 1, 1000));
  map.finish();
  if (c.turn == "arc" && c.turn_radius_m >= c.side_m / 2) {
    value.fail(fmt::format("turn_radius_m = {} does not fit into a square of side_m = {} (must be < side_m / 2)",
                           c.turn_radius_m, c.side_m));
  }
  return c;
}

RunChoice read_runs(const YamlValue& value) {
  YamlMap map(value);
  RunChoice r;
  if (const auto list = map.find("directions")) {
    r.directions.clear();
    for (const YamlValue& item : list->list()) {
      const Direction d = item.choice({"cw", "ccw"}) == "cw" ? Direction::cw : Direction::ccw;
      for (const Direction seen : r.directions) {
        if (seen == d) item.fail("the direction is given twice");
      }
      r.directions.push_back(d);
    }
    if (r.directions.empty()) list->fail("must name cw, ccw or both");
  }
  r.per_direction = int(map.integer("per_direction", r.per_direction, 1, 1000));
  r.start_heading_rad = map.number("start_heading_rad", 0, Bounds::between(-2 * M_PI, 2 * M_PI));
  map.finish();
  return r;
}

Cable read_cable(const YamlValue& value) {
  YamlMap map(value);
  Cable c;
  c.x_m = map.number("x_m", Bounds{});
  c.y_m = map.number("y_m", Bounds{});
  c.height_m = map.number("height_m", c.height_m, {0, 0.05, true});
  c.direction_rad = map.number("direction_rad", c.direction_rad, Bounds{});
  c.length_m = map.number("length_m", c.length_m, Bounds::positive());
  map.finish();
  return c;
}

BumpChoice read_bumps(const YamlValue& value, const Course& course) {
  YamlMap map(value);
  BumpChoice b;
  const std::string wheel = map.choice("wheel", "inner", {"inner", "outer", "left", "right"});
  for (const BumpWheel w : {BumpWheel::inner, BumpWheel::outer, BumpWheel::left, BumpWheel::right}) {
    if (wheel == name(w)) b.laid.wheel = w;
  }
  b.laid.leg = int(map.integer("leg", 1, 1, 4 * course.laps));
  const bool only_fixed = map.has("cables") && !map.has("count");
  b.laid.count = int(map.integer("count", only_fixed ? 0 : 10, 0, 1000));
  b.laid.height_m = map.number("height_m", b.laid.height_m, {0, 0.05, true});
  if (const auto list = map.find("cables")) {
    for (const YamlValue& item : list->list()) b.fixed.push_back(read_cable(item));
  }
  map.finish();
  return b;
}

NoiseChoice read_noise(const YamlValue& value) {
  YamlMap map(value);
  NoiseChoice n;
  n.floor_rms_m = map.number("floor_rms_m", 0, Bounds::between(0, 0.02));
  n.floor_wavelength_m = map.number("floor_wavelength_m", n.floor_wavelength_m, Bounds::between(0.02, 100));
  n.radius_scatter = map.number("radius_scatter", 0, Bounds::between(0, 0.1));
  map.finish();
  return n;
}

TruthChoice read_truth(const YamlValue& value) {
  YamlMap map(value);
  TruthChoice t;
  t.kind = map.choice("kind", t.kind, {"track", "endpoints"});
  t.rate_hz = map.number("rate_hz", t.rate_hz, {0, kMaxRate_hz, true});
  t.position_sd_m = map.number("position_sd_m", 0, Bounds::between(0, 1));
  t.heading_sd_rad = map.number("heading_sd_rad", 0, Bounds::between(0, 1));
  map.finish();
  return t;
}

OdometryChoice read_odometry(const YamlValue& value) {
  YamlMap map(value);
  OdometryChoice o;
  const Bounds positive = Bounds::positive();
  if (map.has("left_radius_m")) o.left_radius_m = map.number("left_radius_m", positive);
  if (map.has("right_radius_m")) o.right_radius_m = map.number("right_radius_m", positive);
  if (map.has("wheelbase_m")) o.wheelbase_m = map.number("wheelbase_m", positive);
  map.finish();
  return o;
}

CalibrationChoice read_calibration(const YamlValue& value) {
  YamlMap map(value);
  CalibrationChoice c;
  const std::string method = map.choice("method", name(c.method), {"none", "endpoint", "heading"});
  for (const Calibrate m : {Calibrate::none, Calibrate::endpoint, Calibrate::heading}) {
    if (method == name(m)) c.method = m;
  }
  c.max_passes = int(map.integer("max_passes", c.max_passes, 1, 10));
  map.finish();
  return c;
}

PhysicsOptions read_physics(const YamlValue& value) {
  YamlMap map(value);
  PhysicsOptions p;
  p.step_s = map.number("step_s", p.step_s, {0, 0.05, true});
  p.fine_step_s = map.number("fine_step_s", p.fine_step_s, {0, 0.05, true});
  p.gravity_mps2 = map.number("gravity_mps2", p.gravity_mps2, {0, 100, true});
  p.softness.static_sink_m = map.number("static_sink_m", p.softness.static_sink_m, Bounds::between(0, 0.01));
  p.softness.damping_ratio = map.number("damping_ratio", p.softness.damping_ratio, {0, 10, true});
  map.finish();
  return p;
}

// The same value without its place in a text: errors about it then name the key, and no line of the scenario file.
YAML::Node without_marks(const YAML::Node& node) {
  YAML::Node copy(node.Type());
  if (node.IsScalar()) copy = node.Scalar();
  for (const auto& entry : node) {
    if (node.IsMap()) copy[entry.first.Scalar()] = without_marks(entry.second);
    else copy.push_back(without_marks(entry));
  }
  copy.SetTag(node.Tag());
  return copy;
}

// Puts the value of `a.b.c=value` into the document.
void set_value(const YamlValue& document, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--set " + setting + ": must have the form key.path=value, as in course.side_m=2");
  }
  YAML::Node node = document.node();
  const std::string path = setting.substr(0, equals);
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    if (dot == begin) throw InputError("--set " + setting + ": empty part in the key path");
    if (node.IsDefined() && !node.IsNull() && !node.IsMap()) {
      throw InputError("--set " + setting + ": '" + path.substr(0, begin - 1) + "' is not a map");
    }
    YAML::Node child = node[path.substr(begin, dot - begin)];
    node.reset(child);
    begin = dot + 1;
  }
  const std::string text = setting.substr(equals + 1);
  if (text.empty()) throw InputError("--set " + setting + ": a value is missing after the =");
  node = without_marks(YamlValue::parse(text, "--set " + setting).node());
}

std::string robots_directory() {
  const char* chosen = std::getenv("UMBSIM_ROBOTS");
  return chosen ? chosen : UMBSIM_ROBOTS_DIR;
}

std::string find_urdf(const Scenario& s) {
  const fs::path given = s.robot.urdf;
  if (given.is_absolute()) return given;
  const fs::path beside = fs::path(s.file).parent_path() / given;
  if (fs::exists(beside)) return beside;
  return fs::path(robots_directory()) / given;
}

}  // namespace

const char* name(BumpWheel wheel) {
  constexpr const char* kNames[] = {"inner", "outer", "left", "right"};
  return kNames[int(wheel)];
}

const char* name(Calibrate method) {
  constexpr const char* kNames[] = {"none", "endpoint", "heading"};
  return kNames[int(method)];
}

Scenario read_scenario(const std::string& file, const std::vector<std::string>& settings) {
  const YamlValue document = YamlValue::load(file);
  for (const std::string& setting : settings) set_value(document, setting);
  YamlMap map(document);
  Scenario s;
  s.file = file;
  map.choice("format", "umbsim-scenario/1", {"umbsim-scenario/1"});
  s.name = map.string("name", fs::path(file).stem().string());
  if (s.name.empty() || s.name.find_first_of("/\\") != std::string::npos || s.name.front() == '.') {
    map.at("name").fail("must be usable as a folder name: not empty, without slashes, not starting with a dot");
  }
  s.description = map.string("description", "");
  s.seed = std::uint64_t(map.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  if (const auto v = map.find("robot")) s.robot = read_robot(*v);
  if (const auto v = map.find("encoders")) s.encoders = read_encoders(*v);
  if (const auto v = map.find("floor")) s.floor_friction = read_floor(*v);
  if (const auto v = map.find("course")) s.course = read_course(*v);
  if (const auto v = map.find("runs")) s.runs = read_runs(*v);
  if (const auto v = map.find("bumps")) s.bumps = read_bumps(*v, s.course);
  if (const auto v = map.find("noise")) s.noise = read_noise(*v);
  if (const auto v = map.find("truth")) s.truth = read_truth(*v);
  if (const auto v = map.find("odometry")) s.odometry = read_odometry(*v);
  if (const auto v = map.find("calibration")) s.calibration = read_calibration(*v);
  if (const auto v = map.find("physics")) s.physics = read_physics(*v);
  if (const auto v = map.find("effects")) s.effects = read_effects(*v);
  map.finish();
  return s;
}

RobotModel load_scenario_robot(const Scenario& scenario) {
  RobotModel robot = load_robot(find_urdf(scenario), scenario.robot.joints);
  for (Caster& caster : robot.casters) caster.friction = scenario.robot.caster_friction;
  return robot;
}

OdometryParameters initial_odometry(const Scenario& s, const RobotModel& nominal) {
  return {s.odometry.left_radius_m.value_or(nominal.wheels[0].radius_m),
          s.odometry.right_radius_m.value_or(nominal.wheels[1].radius_m),
          s.odometry.wheelbase_m.value_or(nominal.wheelbase_m()), s.encoders.ticks_per_revolution};
}

}  // namespace umbsim

#include "experiment/scenario/scenario.h"

#include <fmt/format.h>

#include <filesystem>

#include "experiment/scenario/read_course.h"
#include "experiment/scenario/robot_choice.h"
#include "experiment/scenario/settings.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxRate_hz = 10000;

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
  if (course.shape != "square") value.fail("cables are laid on squares only; course.shape is " + course.shape);
  BumpChoice b;
  const std::string wheel = map.choice("wheel", "inner", {"inner", "outer", "left", "right"});
  for (const BumpWheel w : {BumpWheel::inner, BumpWheel::outer, BumpWheel::left, BumpWheel::right}) {
    if (wheel == name(w)) b.laid.wheel = w;
  }
  b.laid.leg = int(map.integer("leg", 1, 1, legs_per_lap(course) * course.laps));
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
  n.motor_scatter = map.number("motor_scatter", 0, Bounds::between(0, 0.1));
  n.wheel_noise_m_per_sqrt_m = map.number("wheel_noise_m_per_sqrt_m", 0, Bounds::between(0, kRoughest_m_per_sqrt_m));
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
  if (const auto v = map.find("left_radius_m")) o.left_radius_m = v->number(positive);
  if (const auto v = map.find("right_radius_m")) o.right_radius_m = v->number(positive);
  if (const auto v = map.find("wheelbase_m")) o.wheelbase_m = v->number(positive);
  o.scrub = map.number("scrub", 0, Bounds::between(0, 0.1));
  map.finish();
  return o;
}

PathNoise read_uncertainty(const YamlValue& value) {
  YamlMap map(value);
  PathNoise n;
  n.left_m_per_sqrt_m = map.number("left_m_per_sqrt_m", 0, Bounds::between(0, 1));
  n.right_m_per_sqrt_m = map.number("right_m_per_sqrt_m", 0, Bounds::between(0, 1));
  map.finish();
  return n;
}

std::vector<AbsoluteFix> read_fixes(const YamlValue& value, const Course& course, const PathNoise& uncertainty) {
  std::vector<AbsoluteFix> fixes;
  for (const YamlValue& item : value.list()) {
    YamlMap map(item);
    AbsoluteFix f;
    f.leg = int(map.at("leg").integer(1, legs_per_lap(course) * course.laps));
    f.noise.position_sd_m = map.number("position_sd_m", f.noise.position_sd_m, {0, 10, true});
    f.noise.heading_sd_rad = map.number("heading_sd_rad", f.noise.heading_sd_rad, {0, 10, true});
    map.finish();
    fixes.push_back(f);
  }
  if (!fixes.empty() && !uncertainty.any()) {
    value.fail("an absolute fix needs uncertainty.left_m_per_sqrt_m and right_m_per_sqrt_m: an odometry that believes "
               "itself exact learns nothing from it");
  }
  return fixes;
}

// The run itself calibrates by UMBmark, which squares alone are made for.
CalibrationChoice default_calibration(const Course& course) {
  CalibrationChoice c;
  if (course.shape != "square") c.method = Calibrate::none;
  return c;
}

CalibrationChoice read_calibration(const YamlValue& value, const Course& course) {
  YamlMap map(value);
  CalibrationChoice c = default_calibration(course);
  const std::string method = map.choice("method", name(c.method), {"none", "endpoint", "heading"});
  if (method != "none" && course.shape != "square") {
    map.at("method").fail(fmt::format("'{}' needs squares, course.shape is {}: must be none. `umbsim calibrate` has methods "
                                      "for it", method, course.shape));
  }
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
  const auto document = [&](std::size_t count) {
    const YamlValue loaded = YamlValue::load(file);
    for (std::size_t i = 0; i < count; ++i) apply_setting(loaded, settings[i]);
    return loaded;
  };
  const YamlValue whole = document(settings.size());
  try {
    return read_scenario(whole);
  } catch (const InputError& e) {
    blame_setting(e, settings, document);
  }
}

Scenario read_scenario(const YamlValue& document) {
  YamlMap map(document);
  Scenario s;
  s.file = document.file();
  map.choice("format", "umbsim-scenario/1", {"umbsim-scenario/1"});
  s.name = map.string("name", fs::path(s.file).stem().string());
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
  if (const auto v = map.find("uncertainty")) s.uncertainty = read_uncertainty(*v);
  if (const auto v = map.find("fixes")) s.fixes = read_fixes(*v, s.course, s.uncertainty);
  s.calibration = default_calibration(s.course);
  if (const auto v = map.find("calibration")) s.calibration = read_calibration(*v, s.course);
  if (const auto v = map.find("physics")) s.physics = read_physics(*v);
  if (const auto v = map.find("effects")) s.effects = read_effects(*v);
  if (const auto v = map.find("expect")) s.expect = read_expectations(*v, ExpectationsOf::run);
  map.finish();
  return s;
}

}  // namespace umbsim

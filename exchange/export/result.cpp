#include "exchange/export/result.h"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text/text_file.h"
#include "core/text/yaml_reader.h"

namespace umbsim::exchange {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kLargest = std::size_t(256) << 20;

json read_json(const fs::path& file) {
  try {
    return json::parse(read_text_file(file, kLargest));
  } catch (const json::exception& e) {
    throw InputError(SourceMark{file.string()}, fmt::format("is damaged: {}", e.what()));
  }
}

// What the return headings' scatter says of alpha and beta (heading form: alpha = (cw - ccw) / 8, beta = (cw + ccw) /
// 8), carried to radii and wheelbase by the formulas of Borenstein & Feng 1996; two-sided 95 % by Student's t.
void intervals_from_scatter(const json& umbmark, double side_m, CalibratedOdometry& c) {
  const json& cw = umbmark.at("cw");
  const json& ccw = umbmark.at("ccw");
  const double n1 = cw.at("runs"), n2 = ccw.at("runs");
  if (n1 < 2 || n2 < 2) return;
  const double s1 = cw.at("sd_heading_rad"), s2 = ccw.at("sd_heading_rad");
  const double sd_rad = std::sqrt(s1 * s1 / n1 + s2 * s2 / n2) / 8;
  const boost::math::students_t t(n1 + n2 - 2);
  const double half_rad = boost::math::quantile(t, 0.975) * sd_rad;
  // E_b = (pi / 2) / (pi / 2 - alpha), so dE_b = E_b^2 dalpha / (pi / 2).
  const double e_b = c.calibrated.wheelbase_m / c.nominal.wheelbase_m;
  const double half_b = c.nominal.wheelbase_m * e_b * e_b * half_rad / (M_PI / 2);
  c.intervals["wheelbase_m"] = {c.calibrated.wheelbase_m - half_b, c.calibrated.wheelbase_m + half_b};
  if (side_m <= 0) return;
  // Radii are nominal times 1 -+ h, h = b/2 beta / L.
  const double half_h = c.calibrated.wheelbase_m / 2 * half_rad / side_m;
  for (const auto& [name, radius, nominal] :
       {std::tuple{"left_radius_m", c.calibrated.left_radius_m, c.nominal.left_radius_m},
        std::tuple{"right_radius_m", c.calibrated.right_radius_m, c.nominal.right_radius_m}}) {
    c.intervals[name] = {radius - nominal * half_h, radius + nominal * half_h};
  }
}

// The wheels' random errors that scatter so: after a way s of either wheel the heading's variance is 2 k^2 s / b^2.
void noise_from_scatter(const json& umbmark, double side_m, CalibratedOdometry& c) {
  const json& cw = umbmark.at("cw");
  const json& ccw = umbmark.at("ccw");
  const double n1 = cw.at("runs"), n2 = ccw.at("runs");
  if (n1 + n2 < 3 || side_m <= 0) return;
  const double s1 = cw.at("sd_heading_rad"), s2 = ccw.at("sd_heading_rad");
  const double variance = ((n1 - 1) * s1 * s1 + (n2 - 1) * s2 * s2) / (n1 + n2 - 2);
  const double b = c.calibrated.wheelbase_m;
  const double way_m = 4 * side_m + 2 * M_PI * b / 2;
  const double k = std::sqrt(variance * b * b / (2 * way_m));
  if (k <= 0) return;
  c.noise = PathNoise{k, k};
  c.noise_from = "the scatter of the return headings, both wheels alike";
}

// Where the mean radius cannot be seen it is the nominal one, so that E_d and E_b say the rest (Borenstein & Feng
// 1995).
void intervals_from_figures(const json& method, CalibratedOdometry& c) {
  const double mean_m = (c.nominal.left_radius_m + c.nominal.right_radius_m) / 2;
  const double b_m = c.nominal.wheelbase_m;
  if (method.contains("e_d")) {
    const double low = method["e_d"].at("ci95").at(0), high = method["e_d"].at("ci95").at(1);
    c.intervals["left_radius_m"] = {mean_m * 2 / (1 + high), mean_m * 2 / (1 + low)};
    c.intervals["right_radius_m"] = {mean_m * 2 * low / (1 + low), mean_m * 2 * high / (1 + high)};
  }
  if (method.contains("e_b"))
    c.intervals["wheelbase_m"] = {b_m * method["e_b"].at("ci95").at(0).get<double>(),
                                  b_m * method["e_b"].at("ci95").at(1).get<double>()};
}

// A method that says so itself, with its intervals.
void from_methods(const json& result, CalibratedOdometry& c) {
  const json methods = result.value("comparison", json::object()).value("methods", json::array());
  for (const json& m : methods) {
    if (m.value("name", "") != c.method) continue;
    if (!m.value("mean_radius_observed", true)) intervals_from_figures(m, c);
    for (const char* key : {"left_radius_m", "right_radius_m", "wheelbase_m"}) {
      if (!m.contains(key) || !m[key].is_object() || !m[key].contains("ci95")) continue;
      c.intervals[key] = {m[key]["ci95"].at(0), m[key]["ci95"].at(1)};
    }
    if (!m.contains("left_m_per_sqrt_m") || !m.contains("right_m_per_sqrt_m")) continue;
    const auto k = [&](const char* key) {
      return m[key].is_object() ? m[key].at("value").get<double>() : m[key].get<double>();
    };
    c.noise = PathNoise{k("left_m_per_sqrt_m"), k("right_m_per_sqrt_m")};
    c.noise_from = "the fit of " + c.method;
  }
}

// What was believed before: said, or by the method's factors, or of the recording that was calibrated on.
OdometryParameters nominal_of(const json& j, const Result& r, const CalibratedOdometry& c) {
  if (j.contains("nominal")) {
    const json& n = j["nominal"];
    return {n.at("left_radius_m"), n.at("right_radius_m"), n.at("wheelbase_m"), 0};
  }
  OdometryParameters o = c.calibrated;
  const json forms = j.value("calibration", json::object());
  if (!forms.contains(c.method) || !forms[c.method].is_object()) {
    std::error_code ignored;
    if (r.input.empty() || !fs::exists(fs::path(r.input) / "recording.yaml", ignored)) {
      throw InputError(SourceMark{r.folder},
                       fmt::format("does not say what the robot was believed to be, and the recording "
                                   "'{}' is not here: export from the folder in which it was made",
                                   r.input));
    }
    const RecordedRobot robot = read_recording(r.input).robot;
    return {robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, 0};
  }
  const json& estimate = forms[c.method];
  o.left_radius_m /= estimate.at("left_factor").get<double>();
  o.right_radius_m /= estimate.at("right_factor").get<double>();
  o.wheelbase_m /= estimate.at("e_b").get<double>();
  return o;
}

// The side of the squares, which calibration.json leaves to its own formula: (E_d - 1) / (E_d + 1) = b/2 beta / L.
double side_of(const json& umbmark, const CalibratedOdometry& c) {
  const json& heading = umbmark.at("heading");
  const double e_d = heading.at("e_d"), beta_rad = heading.at("beta_rad"), e_b = heading.at("e_b");
  const double h = (e_d - 1) / (e_d + 1);
  return std::abs(h) > 1e-12 ? e_b * c.nominal.wheelbase_m / 2 * beta_rad / h : 0;
}

void read_calibration(const fs::path& folder, Result& r) {
  const json j = read_json(folder / "calibration.json");
  CalibratedOdometry c;
  // The formats know radii and a wheelbase only.
  const bool scrubs = j.contains("without_scrub");
  c.method = (scrubs ? j["without_scrub"] : j).value("method", "heading");
  const json& o = (scrubs ? j["without_scrub"] : j).at("odometry");
  c.calibrated = {o.at("left_radius_m"), o.at("right_radius_m"), o.at("wheelbase_m"), 0};
  c.nominal = nominal_of(j, r, c);
  from_methods(j, c);
  if (j.contains("umbmark") && j["umbmark"].contains("cw")) {
    const double side = side_of(j["umbmark"], c);
    if (c.intervals.empty() && c.method == "heading") intervals_from_scatter(j["umbmark"], side, c);
    if (!c.noise) noise_from_scatter(j["umbmark"], side, c);
  }
  r.calibration = c;
}

// A run's own: calibration.yaml is what its second drive believed.
void read_run_calibration(const fs::path& folder, Result& r) {
  if (!r.recording || !fs::exists(folder / "calibration.yaml") || !fs::exists(folder / "summary.json")) return;
  const json umbmark = read_json(folder / "summary.json").value("umbmark", json::object());
  YamlMap top(YamlValue::load((folder / "calibration.yaml").string()));
  YamlMap o(top.at("odometry"));
  const RecordedRobot& robot = r.recording->robot;
  CalibratedOdometry c;
  c.nominal = {robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, robot.ticks_per_revolution};
  const Bounds kAny = Bounds::positive();
  c.calibrated = {o.number("left_radius_m", kAny), o.number("right_radius_m", kAny), o.number("wheelbase_m", kAny),
                  robot.ticks_per_revolution};
  c.method = read_json(folder / "summary.json").value("/calibration/applied"_json_pointer, "heading");
  if (umbmark.contains("cw")) {
    if (c.method == "heading") intervals_from_scatter(umbmark, r.recording->path.side_m, c);
    noise_from_scatter(umbmark, r.recording->path.side_m, c);
  }
  r.calibration = c;
}

}  // namespace

Result read_result(const std::string& folder) {
  Result r;
  r.folder = folder;
  const fs::path path(folder);
  std::error_code ignored;
  const auto has = [&](const char* name) { return fs::exists(path / name, ignored); };
  if (!has("recording.yaml") && !has("calibration.json") && !has("twin.yaml")) {
    throw InputError(SourceMark{folder},
                     "is no result that can be exported (a run, a recording, a calibration or a diagnosis)");
  }
  if (has("provenance.json")) {
    const json p = read_json(path / "provenance.json");
    r.version = p.value("version", "") + (p.contains("commit") ? " (" + p["commit"].get<std::string>() + ")" : "");
    r.input = p.value("input", "");
  }
  try {
    if (has("recording.yaml")) r.recording = read_recording(folder);
    if (has("calibration.json"))
      read_calibration(path, r);
    else
      read_run_calibration(path, r);
  } catch (const json::exception& e) {
    throw InputError(SourceMark{folder}, fmt::format("its calibration is damaged: {}", e.what()));
  }
  if (has("twin.yaml")) r.twin_file = (path / "twin.yaml").string();
  return r;
}

}  // namespace umbsim::exchange

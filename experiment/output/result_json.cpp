#include "experiment/output/result_json.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <utility>

#include "experiment/output/build_info.h"
#include "experiment/wheel_loads.h"

namespace umbsim {
namespace {

Json odometry_json(const OdometryParameters& o) {
  return {{"left_radius_m", o.left_radius_m}, {"right_radius_m", o.right_radius_m}, {"wheelbase_m", o.wheelbase_m}};
}

Json one_direction_json(const Cluster& c) {
  return {{"r_cg_m", c.r_cg_m},
          {"e_theta_rad", c.heading_rad},
          {"rms_m", error_shares(c).rms_m},
          {"runs", c.errors.size()}};
}

// One direction alone (lecture 7.4): the smaller of both return errors is what a careless test would report.
Json one_way_json(const ExperimentResult& r) {
  const bool has_cw = !r.cw.errors.empty(), has_ccw = !r.ccw.errors.empty();
  const bool take_cw = has_cw && (!has_ccw || r.cw.r_cg_m <= r.ccw.r_cg_m);
  const Cluster& c = take_cw ? r.cw : r.ccw;
  Json json{{"direction", take_cw ? "cw" : "ccw"}, {"r_cg_m", c.r_cg_m}, {"e_theta_rad", c.heading_rad}};
  if (has_cw && has_ccw) {
    const Cluster& other = take_cw ? r.ccw : r.cw;
    json["other_r_cg_m"] = other.r_cg_m;
    json["warning"] = fmt::format(
        "The {0} {4} alone would report {1:.1f} mm; the {2} {4} shows {3:.1f} mm. One direction can hide one error "
        "behind the other: a one-way test is unfit for differential drives.",
        take_cw ? "cw" : "ccw", c.r_cg_m * 1000, take_cw ? "ccw" : "cw", other.r_cg_m * 1000,
        r.scenario.course.shape == "figure_eight" ? "figure eight" : r.scenario.course.shape);
  } else {
    json["warning"] =
        "Only one direction was driven. One E_d can be hidden by one E_b: a one-way test is unfit for differential "
        "drives. Drive both.";
  }
  if (has_cw) json["cw"] = one_direction_json(r.cw);
  if (has_ccw) json["ccw"] = one_direction_json(r.ccw);
  return json;
}

// Systematic against non-systematic. A single run has no spread, and so no shares.
Json shares_json(const ErrorShares& s, bool spread_is_known) {
  const auto known = [&](double value) { return spread_is_known ? Json(value) : Json(); };
  return {{"systematic", known(s.systematic)},     {"non_systematic", known(s.non_systematic)},
          {"rms_m", s.rms_m},                      {"systematic_m", s.systematic_m},
          {"non_systematic_m", known(s.non_systematic_m)}};
}

Json shares_json(const ExperimentResult& r) {
  std::vector<ErrorShares> directions;
  Json parts;
  bool all_known = true;
  for (const auto& [c, direction] : {std::pair{&r.cw, "cw"}, std::pair{&r.ccw, "ccw"}}) {
    if (c->errors.empty()) continue;
    const bool known = c->errors.size() > 1;
    directions.push_back(error_shares(*c));
    parts[direction] = shares_json(directions.back(), known);
    all_known = all_known && known;
  }
  Json json = shares_json(error_shares(directions), all_known);
  json.update(parts);
  return json;
}

Json covariance_json(const PoseCovariance& P) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(Json::array({P(i, 0), P(i, 1), P(i, 2)}));
  return rows;
}

// Of the plain runs of one direction.
Json figures_json(const Recording& recording, const std::vector<PoseTrack>& tracks, const char* direction) {
  std::vector<const PoseTrack*> chosen;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const RecordedRun& run = recording.runs[i];
    const bool bumped = !run.bumps.empty() || run.inner_wheel_bumps;
    if (!bumped && run.direction == direction) chosen.push_back(&tracks[i]);
  }
  const UncertaintyFigures f = uncertainty_figures(chosen);
  if (f.runs == 0) return {};
  const Ellipse e = ellipse_95(f.end_covariance);
  return {{"runs", f.runs},
          {"end_covariance", covariance_json(f.end_covariance)},
          {"ellipse_95_semi_axes_m", {e.a_m, e.b_m}},
          {"ellipse_95_angle_rad", e.angle_rad},
          {"heading_sd_rad", std::sqrt(f.end_covariance(2, 2))},
          {"inside_95_share", f.end_inside_95_share},
          {"inside_95_share_on_the_way", f.way_inside_95_share}};
}

void add_figures(Json& json, const Recording& recording, const std::vector<PoseTrack>& tracks) {
  for (const char* direction : {"cw", "ccw"}) {
    Json figures = figures_json(recording, tracks, direction);
    if (!figures.is_null()) json[direction] = std::move(figures);
  }
}

// Predicted ellipses at the end of the runs, and how often the true end lies in them.
Json uncertainty_json(const ExperimentResult& r) {
  Json json{{"left_m_per_sqrt_m", r.scenario.uncertainty.left_m_per_sqrt_m},
            {"right_m_per_sqrt_m", r.scenario.uncertainty.right_m_per_sqrt_m},
            {"fixes", r.scenario.fixes.size()}};
  add_figures(json, r.recording, r.tracks);
  if (!r.passes.empty()) add_figures(json["after"], r.passes.back().recording, r.passes.back().tracks);
  return json;
}

Json loads_json(const ExperimentResult& r) {
  Json json;
  const auto loads = wheel_loads(r);
  for (const auto& [l, side] : {std::pair{&loads[0], "left"}, std::pair{&loads[1], "right"}}) {
    json[side] = {{"least_n", l->least_n},
                  {"mean_n", l->mean_n},
                  {"unloaded_share", l->unloaded_share},
                  {"longest_unloaded_s", l->longest_unloaded_s}};
  }
  return json;
}

Json recovery_json(const ExperimentResult& r) {
  const CalibrationPass& last = r.passes.back();
  // What the calibration as a whole (all passes) says of the robot.
  const double e_d = last.odometry.right_radius_m / last.odometry.left_radius_m /
                     (r.odometry.right_radius_m / r.odometry.left_radius_m);
  const double e_b = last.odometry.wheelbase_m / r.odometry.wheelbase_m;
  const double after_m = last.umbmark.e_max_syst_m;
  Json json{{"method", name(r.scenario.calibration.method)},
            {"e_d", e_d},
            {"e_b", e_b},
            {"e_d_error", e_d - r.injected.e_d},
            {"e_b_error", e_b - r.injected.e_b},
            {"e_max_before_m", r.umbmark->e_max_syst_m},
            {"e_max_after_m", after_m},
            {"improvement", after_m > 0 ? Json(r.umbmark->e_max_syst_m / after_m) : Json()},
            {"passes", r.passes.size()},
            {"odometry", odometry_json(last.odometry)},
            {"after", umbmark_json(last.umbmark)}};
  return json;
}

}  // namespace

Json cluster_json(const Cluster& c) {
  return {{"centroid_x_m", c.centroid_x_m}, {"centroid_y_m", c.centroid_y_m},
          {"heading_rad", c.heading_rad},   {"runs", c.errors.size()},
          {"r_cg_m", c.r_cg_m},             {"sd_x_m", c.sd_x_m},
          {"sd_y_m", c.sd_y_m},             {"sd_m", c.sd_m},
          {"sd_heading_rad", c.sd_heading_rad}, {"standard_error_m", c.standard_error_m},
          {"laps", c.laps}};
}

Json estimate_json(const ErrorEstimate& e) {
  return {{"alpha_rad", e.alpha_rad}, {"beta_rad", e.beta_rad},       {"e_d", e.e_d},
          {"e_b", e.e_b},             {"left_factor", e.left_factor}, {"right_factor", e.right_factor}};
}

Json calibration_json(const Umbmark& u, std::optional<CalibrationMethod> applied) {
  Json json{{"applied", applied ? name(*applied) : "none"}};
  for (const CalibrationMethod form : {CalibrationMethod::endpoint, CalibrationMethod::heading}) {
    json[name(form)] = estimate_json(estimate(u, form));
    json[name(form)]["trust"] = when_to_trust(form);
  }
  return json;
}

Json umbmark_json(const Umbmark& u) {
  return {{"cw", cluster_json(u.cw)},
          {"ccw", cluster_json(u.ccw)},
          {"e_max_syst_m", u.e_max_syst_m},
          {"endpoint", estimate_json(u.endpoint)},
          {"endpoint_y", estimate_json(u.endpoint_y)},
          {"heading", estimate_json(u.heading)},
          {"type_a_share", u.type_a_share},
          {"type_b_share", u.type_b_share}};
}

Json summary_json(const ExperimentResult& r) {
  Json json{{"format", "umbsim-result/1"}, {"scenario", r.scenario.name}, {"seed", r.scenario.seed}};
  if (r.umbmark) json["umbmark"] = umbmark_json(*r.umbmark);
  json["one_way"] = one_way_json(r);
  json["shares"] = shares_json(r);
  if (r.scenario.uncertainty.any()) json["uncertainty"] = uncertainty_json(r);
  if (r.extended) {
    const ExtendedUmbmark& e = *r.extended;
    json["extended"] = {{"mean_abs_heading_error_rad", e.mean_abs_heading_error_rad},
                        {"per_bump_heading_error_rad", e.per_bump_heading_error_rad},
                        {"cw_mean_abs_heading_error_rad", e.cw_mean_abs_heading_error_rad},
                        {"ccw_mean_abs_heading_error_rad", e.ccw_mean_abs_heading_error_rad},
                        {"cables_not_crossed", r.cables.not_crossed},
                        {"cables_without_grip", r.cables.without_grip},
                        {"cw", cluster_json(e.cw)},
                        {"ccw", cluster_json(e.ccw)}};
  }
  json["injected"] = {{"e_d", r.injected.e_d}, {"e_b", r.injected.e_b}};
  if (r.umbmark) json["calibration"] = calibration_json(*r.umbmark, r.applied());
  if (!r.passes.empty()) json["recovery"] = recovery_json(r);
  json["loads"] = loads_json(r);
  if (!r.warnings.empty()) json["warnings"] = r.warnings;
  json["cost"] = {{"simulated_s", r.cost.simulated_s},
                  {"wall_s", r.wall_s},
                  {"steps", r.cost.steps},
                  {"newton_steps", r.cost.newton_steps},
                  {"solver_fallbacks", r.cost.solver_fallbacks}};
  return json;
}

Json provenance_json(const std::string& input, std::uint64_t seed) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const BuildInfo info = build_info();
  return {{"program", "umbsim"},          {"version", info.version},   {"commit", info.commit},
          {"input", input},      {"seed", seed},            {"compiler", info.compiler},
          {"bullet_version", info.bullet}, {"build_type", info.build_type}, {"host", host}};
}

Json page_provenance_json(const std::string& input, std::uint64_t seed) {
  Json json = provenance_json(input, seed);
  json.erase("host");
  json.erase("input");
  return json;
}

}  // namespace umbsim

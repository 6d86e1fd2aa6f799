#include "experiment/result_json.h"

#include <unistd.h>

#include <cmath>

#include <fmt/format.h>

#include "experiment/build_info.h"

namespace umbsim {
namespace {

Json odometry_json(const OdometryParameters& o) {
  return {{"left_radius_m", o.left_radius_m}, {"right_radius_m", o.right_radius_m}, {"wheelbase_m", o.wheelbase_m}};
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
        "The {} square alone would report {:.1f} mm; the {} square shows {:.1f} mm. One direction can hide one error "
        "behind the other: a one-way test is unfit for differential drives.",
        take_cw ? "cw" : "ccw", c.r_cg_m * 1000, take_cw ? "ccw" : "cw", other.r_cg_m * 1000);
  } else {
    json["warning"] =
        "Only one direction was driven. One E_d can be hidden by one E_b: a one-way test is unfit for differential "
        "drives. Drive both.";
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

// At most this many poses of a run go into the page.
constexpr std::size_t kPagePoses = 400;

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json path_json(const Pose2& p) { return Json::array({rounded(p.x_m), rounded(p.y_m), rounded(p.theta_rad)}); }

// Truth and odometry at the same moments, in the floor frame.
void add_paths(Json& json, const RecordedRun& run, const OdometryParameters& odometry) {
  json["truth"] = Json::array();
  json["odometry"] = Json::array();
  const std::size_t stride = 1 + run.truth.size() / kPagePoses;
  DeadReckoning reckoning(odometry, run.truth.front().X_WB, run.encoders.front().left_ticks,
                          run.encoders.front().right_ticks);
  std::size_t e = 0;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    for (; e < run.encoders.size() && run.encoders[e].time_s <= run.truth[i].time_s + 1e-9; ++e) {
      reckoning.update(run.encoders[e].left_ticks, run.encoders[e].right_ticks);
    }
    if (i % stride != 0 && i + 1 != run.truth.size()) continue;
    json["truth"].push_back(path_json(run.truth[i].X_WB));
    json["odometry"].push_back(path_json(reckoning.pose()));
  }
}

void add_runs(Json& json, const Recording& recording, const OdometryParameters& odometry, const char* stage) {
  for (const RecordedRun& run : recording.runs) {
    const bool bumped = !run.bumps.empty() || run.inner_wheel_bumps;
    const ReturnError e = return_error(run, odometry);
    Json item{{"id", run.id},
              {"direction", run.direction},
              {"stage", bumped ? "bumped" : stage},
              {"error", {{"x_m", e.x_m}, {"y_m", e.y_m}, {"theta_rad", e.theta_rad}}}};
    add_paths(item, run, odometry);
    json["runs"].push_back(std::move(item));
    for (const RecordedBump& b : run.bumps) {
      json["bumps"].push_back({{"run", run.id}, {"x_m", b.x_m}, {"y_m", b.y_m}, {"height_m", b.height_m}});
    }
  }
}

}  // namespace

Json cluster_json(const Cluster& c) {
  return {{"centroid_x_m", c.centroid_x_m}, {"centroid_y_m", c.centroid_y_m},
          {"heading_rad", c.heading_rad},   {"runs", c.errors.size()},
          {"r_cg_m", c.r_cg_m},             {"sd_x_m", c.sd_x_m},
          {"sd_y_m", c.sd_y_m},             {"sd_m", c.sd_m},
          {"sd_heading_rad", c.sd_heading_rad}, {"standard_error_m", c.standard_error_m}};
}

Json estimate_json(const ErrorEstimate& e) {
  return {{"alpha_rad", e.alpha_rad}, {"beta_rad", e.beta_rad},       {"e_d", e.e_d},
          {"e_b", e.e_b},             {"left_factor", e.left_factor}, {"right_factor", e.right_factor}};
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
  if (r.extended) {
    const ExtendedUmbmark& e = *r.extended;
    json["extended"] = {{"mean_abs_heading_error_rad", e.mean_abs_heading_error_rad},
                        {"per_bump_heading_error_rad", e.per_bump_heading_error_rad},
                        {"cw_mean_abs_heading_error_rad", e.cw_mean_abs_heading_error_rad},
                        {"ccw_mean_abs_heading_error_rad", e.ccw_mean_abs_heading_error_rad},
                        {"cw", cluster_json(e.cw)},
                        {"ccw", cluster_json(e.ccw)}};
  }
  json["injected"] = {{"e_d", r.injected.e_d}, {"e_b", r.injected.e_b}};
  if (r.umbmark) {
    json["calibration"] = {{"endpoint", estimate_json(r.umbmark->endpoint)},
                           {"heading", estimate_json(r.umbmark->heading)}};
  }
  if (!r.passes.empty()) json["recovery"] = recovery_json(r);
  json["cost"] = {{"simulated_s", r.cost.simulated_s},
                  {"wall_s", r.wall_s},
                  {"steps", r.cost.steps},
                  {"newton_steps", r.cost.newton_steps},
                  {"solver_fallbacks", r.cost.solver_fallbacks}};
  return json;
}

Json report_json(const ExperimentResult& r) {
  Json json{{"title", r.recording.title},
            {"scenario", r.scenario.name},
            {"description", r.scenario.description},
            {"version", build_info().version},
            {"seed", r.scenario.seed},
            {"side_m", r.scenario.course.side_m},
            {"wheelbase_m", r.odometry.wheelbase_m},
            {"summary", summary_json(r)}};
  json["summary"]["cost"].erase("wall_s");  // the page is the same bytes on every run
  json["runs"] = Json::array();
  json["bumps"] = Json::array();
  add_runs(json, r.recording, r.odometry, "before");
  if (!r.passes.empty()) add_runs(json, r.passes.back().recording, r.passes.back().odometry, "after");
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

}  // namespace umbsim

#include "cli/output/calibration_json.h"

#include <cmath>

#include "calibration/compare/residuals.h"

namespace umbsim {
namespace {

using namespace calibration;

constexpr std::size_t kMoments = 100;  // of a run

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json estimate(const Estimate& e) {
  Json json{{"value", e.value}};
  if (e.has_interval()) json["ci95"] = {e.low, e.high};
  return json;
}

Json odometry(const OdometryParameters& o) {
  Json json{{"left_radius_m", o.left_radius_m}, {"right_radius_m", o.right_radius_m}, {"wheelbase_m", o.wheelbase_m}};
  if (o.scrub > 0) json["scrub"] = o.scrub;
  return json;
}

Json mean_errors(const std::vector<MeanError>& errors, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (std::size_t i = 0; i < errors.size(); ++i)
    json[names[i]] = {{"final_mm", errors[i].final_mm}, {"raw_final_mm", errors[i].raw_final_mm}};
  return json;
}

Json tracker(const TrackerFit& t) {
  return {{"recording", t.recording},
          {"heading_offset_rad", t.heading_offset_rad},
          {"marker_m", {t.marker_x_m, t.marker_y_m}},
          {"clock_offset_s", t.clock_offset_s},
          {"clock_rate", t.clock_rate}};
}

Json fit_json(const Fit& fit, const OdometryParameters& nominal) {
  const FitFigures f = figures(fit, nominal);
  Json json{{"e_d", estimate(f.e_d)}, {"e_b", estimate(f.e_b)}, {"mean_radius_observed", fit.scale_observed}};
  if (fit.scale_observed) {
    json["mean_radius_m"] = estimate(f.mean_radius_m);
    json["left_radius_m"] = estimate(f.left_radius_m);
    json["right_radius_m"] = estimate(f.right_radius_m);
    json["wheelbase_m"] = estimate(f.wheelbase_m);
  }
  json["condition"] = number(fit.condition);
  if (!fit.covariance.empty()) {
    json["degrees_of_freedom"] = {{"e_d", spread(fit.covariance, kEd).degrees_of_freedom},
                                  {"e_b", spread(fit.covariance, kEb).degrees_of_freedom}};
  }
  if (fit.scrub) json["scrub"] = estimate(*fit.scrub);
  if (fit.own_bias) json["own_bias"] = {{"e_d", kEd.dot(*fit.own_bias)}, {"e_b", kEb.dot(*fit.own_bias)}};
  if (fit.noise) {
    json["left_m_per_sqrt_m"] = estimate(fit.noise->left_m_per_sqrt_m);
    json["right_m_per_sqrt_m"] = estimate(fit.noise->right_m_per_sqrt_m);
  }
  for (const TrackerFit& t : fit.trackers) json["trackers"].push_back(tracker(t));
  return json;
}

Json method_json(const MethodResult& r, const Comparison& c, const Task& task) {
  Json json{{"name", r.name}};
  if (r.method) {
    json["source"] = r.method->source;
    json["takes_for_exact"] = r.method->takes_for_exact;
    json["cannot_see"] = r.method->cannot_see;
  }
  if (!r.why_not.empty()) {
    json["no_answer"] = r.why_not;
    return json;
  }
  if (r.fit) json.update(fit_json(*r.fit, c.nominal));
  json["odometry"] = odometry(r.odometry);
  if (r.e_max_m) json["e_max_syst_m"] = *r.e_max_m;
  json["held_out_mm"] = r.held_out_mm;
  json["held_out_answers"] = r.held_out_answers;
  json["held_out_folds_mm"] = r.fold_mm;
  json["train"] = mean_errors(r.train, task.train_names);
  if (!task.test.empty()) json["test"] = mean_errors(r.test, task.test_names);
  json["warnings"] = r.fit ? Json(r.fit->warnings) : Json::array();
  return json;
}

Json parts_json(const Parts& parts) {
  Json json{{"fits", Json::array()}, {"starts", Json::array()}};
  for (const PartFit& p : parts.fits) {
    Json fit{{"recording", p.recording}, {"part", p.part}, {"pieces", p.pieces}};
    if (p.e_d) fit["e_d"] = estimate(*p.e_d);
    if (p.e_b) fit["e_b"] = estimate(*p.e_b);
    json["fits"].push_back(fit);
  }
  for (const StartHeading& s : parts.starts) {
    json["starts"].push_back(
        {{"recording", s.recording}, {"run", s.run}, {"off_rad", s.off_rad}, {"usual_rad", s.usual_rad}});
  }
  json["warnings"] = parts.warnings;
  return json;
}

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json columns(const std::vector<Pose2>& poses) {
  Json x = Json::array(), y = Json::array(), theta = Json::array();
  for (const Pose2& p : poses) {
    x.push_back(rounded(p.x_m));
    y.push_back(rounded(p.y_m));
    theta.push_back(rounded(p.theta_rad));
  }
  return {{"x_m", x}, {"y_m", y}, {"theta_rad", theta}};
}

Json return_errors(const Umbmark& u) {
  Json json{{"e_max_syst_m", u.e_max_syst_m}};
  for (const auto& [cluster, direction] : {std::pair{&u.cw, "cw"}, std::pair{&u.ccw, "ccw"}}) {
    json[direction] = cluster_json(*cluster);
    for (const ReturnError& e : cluster->errors)
      json[direction]["errors"].push_back({{"run", e.run}, {"x_m", e.x_m}, {"y_m", e.y_m}, {"theta_rad", e.theta_rad}});
  }
  return json;
}

}  // namespace

Json residuals_json(const Comparison& c, const Task& task) {
  Json json = Json::array();
  for (const RunResiduals& r : run_residuals(task, c, kMoments)) {
    Json times = Json::array(), finals = Json::object();
    for (const double t : r.time_s) times.push_back(rounded(t));
    for (std::size_t i = 0; i < c.results.size(); ++i) {
      if (c.results[i].why_not.empty()) finals[c.results[i].name] = r.final_mm[i];
    }
    json.push_back({{"recording", r.recording},
                    {"run", r.run},
                    {"direction", r.direction},
                    {"test", r.test},
                    {"final_mm", finals},
                    {"time_s", times},
                    {"tracked", columns(r.tracked)},
                    {"before", columns(r.before)},
                    {"after", columns(r.after)}});
  }
  return json;
}

Json squares_json(const Comparison& c, const Task& task) {
  Json json = Json::array();
  for (const SquaresBeforeAfter& s : squares_before_after(task, c)) {
    json.push_back({{"recording", s.recording},
                    {"side_m", s.side_m},
                    {"before", return_errors(s.before)},
                    {"after", return_errors(s.after)}});
  }
  return json;
}

Json comparison_json(const Comparison& c, const Task& task) {
  Json methods = Json::array();
  for (const MethodResult& r : c.results) methods.push_back(method_json(r, c, task));
  return {{"winner", {{"name", c.results[c.winner].name}, {"why", c.why}}},
          {"held_out", c.held_out},
          {"folds", c.folds},
          {"methods", methods},
          {"parts", parts_json(c.parts)},
          {"warnings", c.warnings}};
}

}  // namespace umbsim

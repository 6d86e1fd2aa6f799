#include "gap/output/diagnosis_json.h"

#include <algorithm>
#include <cmath>

#include "gap/output/parameter_estimates.h"

namespace umbsim::gap {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json parameter_json(const ParameterEstimate& e) {
  Json json{{"value", e.value}, {"ci95", {e.ci95[0], e.ci95[1]}}, {"unit", e.unit}};
  if (const std::string text = shown_text(e); !text.empty()) json["text"] = text;
  return json;
}

Json worth_json(const Worth& w) { return {{"position_mm", number(w.mm)}, {"heading_deg", number(w.deg)}}; }

// Of the cause that the twin holds, where runs were held out: together, and each of several effects beside the others.
Json worth_of(const Cause& cause, const Diagnosis& d) {
  const Fit& twin = d.twin;
  if (!d.closure.known || d.twin_is_nominal() || cause.name != d.explanation.name()) return nullptr;
  Json json = worth_json(d.closure.together());
  if (d.closure.worth.size() < 2) return json;
  for (std::size_t i = 0; i < d.closure.worth.size(); ++i)
    json["effects"][twin.hypotheses[i].effect] = worth_json(d.closure.worth[i]);
  return json;
}

// Dimensions that are no cause and stand in the twin for what the causes leave, and what these do without them.
Json effective_json(const Diagnosis& d) {
  if (!d.effective) return nullptr;
  Json dimensions = Json::object();
  for (const ParameterEstimate& e : effective_dimensions(d)) dimensions[e.effect][e.parameter] = parameter_json(e);
  return {{"dimensions", dimensions},
          {"beside_causes", d.effective->fit.hypotheses.size() > d.effective->dimensions.size()},
          {"held_out_fraction_without", number(d.closure.fraction)},
          {"after_mm_without", d.closure.after_mm}};
}

// What is found that shows in commands or counts, and moves no pose of held-out runs beyond the noise.
Json remarks_of(const Diagnosis& d) {
  Json remarks = Json::array();
  const auto& twin = d.twin.hypotheses;
  for (const Hypothesis& h : d.explanation.hypotheses) {
    if (!shows_in_counts(h)) continue;
    const auto at = std::find_if(twin.begin(), twin.end(), [&](const Hypothesis& t) { return t.effect == h.effect; });
    const std::size_t i = std::size_t(at - twin.begin());
    const bool moves = d.closure.known && i < d.closure.worth.size() && d.closure.worth[i].mm > d.noise_floor_mm;
    if (!moves) remarks.push_back(h.effect);
  }
  return remarks;
}

}  // namespace

Json diagnosis_json(const Diagnosis& d) {
  Json json{{"format", "umbsim-diagnosis/1"}};
  json["gap"] = {{"detected", d.detected},
                 {"in_poses", d.in_poses},
                 {"p_value", d.p_value},
                 {"noise_floor_mm", number(d.noise_floor_mm)},
                 {"before_mm", number(d.before_mm)}};
  json["noise"] = {{"heading_rad_per_sqrt_m", std::sqrt(d.noise.heading_rad2_pm)},
                   {"along_m_per_sqrt_m", std::sqrt(d.noise.along_m2_pm)},
                   {"across_m_per_sqrt_m", std::sqrt(d.noise.across_m2_pm)},
                   {"position_sd_m", d.noise.position_sd_m},
                   {"heading_sd_rad", d.noise.heading_sd_rad},
                   {"clock_s", d.noise.clock_s}};
  Json segments = Json::array();
  for (const SegmentScore& s : d.segments) {
    segments.push_back(
        {{"run", s.run}, {"leg", s.leg}, {"part", s.part}, {"score", number(s.score)}, {"at_m", {s.at_x_m, s.at_y_m}}});
  }
  json["where"] = {{"stage", d.stage}, {"pattern", d.pattern}, {"segments", segments}};
  if (d.has_place) json["where"]["place_m"] = {d.place_m[0], d.place_m[1]};
  Json causes = Json::array();
  for (const Cause& c : d.causes) {
    Json effects = Json::object();
    if (c.name == "none" || c.name == "unknown") {
      effects[c.name] = Json::object();
    } else {
      for (const Hypothesis& f : c.fit.hypotheses) effects[f.effect] = Json::object();
      for (const ParameterEstimate& e : parameter_estimates(c, d)) {
        effects[e.effect][e.parameter] = parameter_json(e);
      }
      for (const Effect& e : c.fit.effects()) {
        if (e.info->one_run && effects.contains(e.info->name)) effects[e.info->name]["run"] = e.values.run;
      }
    }
    causes.push_back({{"effects", effects},
                      {"probability", c.probability},
                      {"held_out_log_density", number(c.fit.held_out)},
                      {"squared_error_drop", number(c.squared_error_drop)}});
    if (const Json worth = worth_of(c, d); !worth.is_null()) causes.back()["worth"] = worth;
    if (causes.size() == 12) break;
  }
  json["causes"] = causes;
  json["set"] = d.set;
  json["indistinguishable"] = d.indistinguishable;
  json["unexplained"] = {{"detected", d.unexplained},
                         {"p_value", d.unexplained_p},
                         {"description", d.unexplained ? d.left_over.description : ""}};
  json["remarks"] = remarks_of(d);
  if (d.detected) {
    json["remainder"] = {{"position_mm", number(d.remainder.mm)},
                         {"share", number(d.remainder.share)},
                         {"where", d.left_over.where},
                         {"pattern", d.remainder.pattern},
                         {"in_catalogue", d.remainder.in_catalogue}};
  }
  if (const Closure& c = d.twin_closure(); c.known) {
    json["closure"] = {{"held_out_fraction", number(c.fraction)},
                       {"ci95", {number(c.ci95[0]), number(c.ci95[1])}},
                       {"before_mm", c.before_mm},
                       {"after_mm", c.after_mm},
                       {"noise_floor_mm", c.floor_mm},
                       {"before_deg", c.before_deg},
                       {"after_deg", c.after_deg},
                       {"explainable_fraction", number(d.explainable_fraction)},
                       {"effective", effective_json(d)}};
  } else {
    json["closure"] = {{"held_out_fraction", nullptr},
                       {"note", d.detected ? "the tracks show no gap that could be closed" : "no gap to close"}};
  }
  json["limits"] = d.limits;
  return json;
}

}  // namespace umbsim::gap

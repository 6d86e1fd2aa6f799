#include "gap/output/diagnosis_json.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace umbsim::gap {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kParameterDraws = 2000;
// What a replay is off by that no residual shows, standard deviations, from development trials (docs/gap.md).
constexpr double kReplayShare = 0.03;  // of a size, against its neutral value
constexpr double kScrubShare =
    0.08;  // of what scrubs: the floor's roughness, which lets the wheels slip, is known to a fifth
constexpr double kReplayAngle_rad = 0.01;
constexpr double kReplayPlace_m = 0.005;
constexpr double kReplayMoment_s = 0.01;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

bool is_angle(const EffectParameter& p) { return p.unit == "rad" && p.bounds.min <= -3 && p.bounds.max >= 3; }

double replay_sd(const std::string& effect, const EffectParameter& p, double value, double neutral) {
  if (is_angle(p)) return kReplayAngle_rad;
  if (p.name == "x_m" || p.name == "y_m") return kReplayPlace_m;
  if (p.name == "leg") return 0;
  if (p.name == "seconds_into_leg") return kReplayMoment_s;
  return (is(effect, kScrubs) ? kScrubShare : kReplayShare) * std::abs(value - neutral);
}

}  // namespace

// Draws from the posterior, seen through the hypothesis's own coordinates.
std::vector<ParameterEstimate> parameter_estimates(const Fit& fit, double overdispersion) {
  std::vector<ParameterEstimate> estimates;
  if (fit.hypotheses.empty()) return estimates;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(fit.covariance * overdispersion);
  const Eigen::MatrixXd root = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  RandomStream random(1, "parameter intervals");
  std::vector<Eigen::VectorXd> draws;
  for (int i = 0; i < kParameterDraws; ++i) {
    Eigen::VectorXd z(fit.p.size());
    for (Eigen::Index j = 0; j < z.size(); ++j) z[j] = random.normal();
    draws.push_back(fit.p + root * z);
  }
  Eigen::Index at = 0;
  for (const Hypothesis& f : fit.hypotheses) {
    const Eigen::Index n = Eigen::Index(f.parameters.size());
    const EffectInfo& info = find_effect(f.effect);
    const EffectValues best = f.values(fit.p.segment(at, n));
    const EffectValues neutral = neutral_effect(info).values;
    for (std::size_t k = 0; k < info.parameters.size(); ++k) {
      std::vector<double> values;
      for (const Eigen::VectorXd& draw : draws) {
        double v = f.values(draw.segment(at, n)).numbers[k];
        if (is_angle(info.parameters[k])) v = best.numbers[k] + std::remainder(v - best.numbers[k], 2 * M_PI);
        values.push_back(v);
      }
      std::sort(values.begin(), values.end());
      const bool fixed = values.front() == values.back();
      if (fixed && best.numbers[k] == neutral.numbers[k]) continue;
      const double best_k = best.numbers[k];
      const double replay = 1.96 * replay_sd(f.effect, info.parameters[k], best_k, neutral.numbers[k]);
      const Bounds possible = is_angle(info.parameters[k]) ? Bounds{} : info.parameters[k].bounds;
      estimates.push_back(
          {f.effect,
           info.parameters[k].name,
           info.parameters[k].unit,
           best_k,
           {std::max(std::min(best_k, possible.min),
                     best_k - std::hypot(best_k - values[kParameterDraws / 40], replay)),
            std::min(std::max(best_k, possible.max),
                     best_k + std::hypot(values[kParameterDraws - 1 - kParameterDraws / 40] - best_k, replay))}});
    }
    at += n;
  }
  return estimates;
}

std::vector<ParameterEstimate> parameter_estimates(const Cause& cause, double overdispersion) {
  std::vector<ParameterEstimate> estimates = parameter_estimates(cause.fit, overdispersion);
  for (const Fit& variant : cause.variants) {
    for (const ParameterEstimate& v : parameter_estimates(variant, overdispersion)) {
      const EffectInfo& info = find_effect(v.effect);
      const auto parameter = std::find_if(info.parameters.begin(), info.parameters.end(),
                                          [&](const EffectParameter& p) { return p.name == v.parameter; });
      if (is_angle(*parameter)) continue;  // of what may not be there
      const auto same = [&](const ParameterEstimate& e) { return e.effect == v.effect && e.parameter == v.parameter; };
      auto at = std::find_if(estimates.begin(), estimates.end(), same);
      if (at == estimates.end()) {
        const double neutral = parameter->neutral;
        at = estimates.insert(at, {v.effect, v.parameter, v.unit, neutral, {neutral, neutral}});
      }
      at->ci95[0] = std::min(at->ci95[0], v.ci95[0]);
      at->ci95[1] = std::max(at->ci95[1], v.ci95[1]);
    }
  }
  return estimates;
}

namespace {

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

std::vector<ParameterEstimate> effective_dimensions(const Diagnosis& d) {
  std::vector<ParameterEstimate> found;
  if (!d.effective) return found;
  const auto& names = d.effective->dimensions;
  for (const ParameterEstimate& e : parameter_estimates(d.effective->fit, d.overdispersion)) {
    if (std::find(names.begin(), names.end(), e.effect) != names.end()) found.push_back(e);
  }
  return found;
}

FoundParameter found(const ParameterEstimate& e) { return {e.parameter, e.value, e.ci95[0], e.ci95[1]}; }

std::string shown_text(const ParameterEstimate& e) {
  const EffectInfo& info = find_effect(e.effect);
  return is_neutral(info, found(e)) ? "" : shown(info, found(e));
}

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
      for (const ParameterEstimate& e : parameter_estimates(c, d.overdispersion)) {
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

#include "gap/plan/json.h"

#include <cmath>

namespace umbsim::gap {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double x) { return std::round(x * 1e4) / 1e4; }

Json matrix(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < m.cols(); ++j) row.push_back(rounded(m(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json separation_json(const Separation& s) {
  Json pairs = Json::array();
  for (const auto& [pair, probability] : s.alike) {
    pairs.push_back({{"effects", {pair.first, pair.second}}, {"probability", rounded(probability)}});
  }
  std::vector<std::string> named = s.race.effects;
  named.push_back("none");
  const std::size_t n = s.race.effects.size();
  return {{"separated_pairs", s.separated},
          {"pairs", n * (n - (n > 0 ? 1 : 0)) / 2},
          {"not_shown", s.not_shown},
          {"indistinguishable", s.groups},
          {"alike", pairs},
          {"confusion", {{"truth", s.race.effects}, {"named", named}, {"probability", matrix(s.race.named)}}},
          {"head_to_head", matrix(s.race.mistaken)}};
}

Json run_json(const PlanContext& context, std::size_t run) {
  return {{"run", context.labels[run]}, {"duration_s", rounded(context.durations_s[run])}};
}

Json recommendation_json(const Recommendation& r, const PlanContext& context) {
  Json steps = Json::array();
  double duration_s = 0;
  for (const PlanStep& step : r.steps) {
    Json one = run_json(context, step.run);
    one["shows"] = step.shows;
    one["separates"] = Json::array();
    for (const Pair& p : step.separates) one["separates"].push_back({p.first, p.second});
    duration_s += context.durations_s[step.run];
    steps.push_back(std::move(one));
  }
  return {{"runs", steps}, {"duration_s", rounded(duration_s)}, {"result", separation_json(r.result)}};
}

}  // namespace

Json plan_json(const Plan& plan, const PlanContext& context, const PlanOptions& options, const NoiseModel& noise) {
  Json json{{"format", "umbsim-gap-plan/1"}, {"title", context.title}};
  json["options"] = {{"severity_floors", options.severity},
                     {"alike_above", options.alike},
                     {"shown_above", options.shown},
                     {"draws", options.draws},
                     {"seed", options.seed}};
  json["noise"] = {{"heading_rad_per_sqrt_m", std::sqrt(noise.heading_rad2_pm)},
                   {"along_m_per_sqrt_m", std::sqrt(noise.along_m2_pm)},
                   {"across_m_per_sqrt_m", std::sqrt(noise.across_m2_pm)},
                   {"position_sd_m", noise.position_sd_m},
                   {"heading_sd_rad", noise.heading_sd_rad}};
  Json runs = Json::array();
  Json menu = Json::array();
  for (std::size_t r = 0; r < context.labels.size(); ++r) {
    (r < context.given ? runs : menu).push_back(run_json(context, r));
  }
  json["runs"] = runs;
  json["menu"] = menu;
  Json weak = Json::object();
  for (const auto& [effect, severity] : plan.weak) weak[effect] = rounded(severity);
  json["weaker_than_asked"] = weak;
  json["not_in_catalogue_of_diagnosis"] = plan.no_hypothesis;
  json["these_runs"] = separation_json(plan.given);
  json["recommended"] = recommendation_json(plan.from_nothing, context);
  json["further"] = recommendation_json(plan.further, context);
  json["limits"] = context.limits;
  return json;
}

}  // namespace umbsim::gap

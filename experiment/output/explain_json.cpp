#include "experiment/output/result_json.h"
#include "experiment/output/scene_json.h"

namespace umbsim {
namespace {

Json contributions_json(const Contributions& contributions) {
  Json json = Json::object();
  for (const auto& [direction, c] : contributions) {
    json[name(direction)] = {
        {"x_m", c.x_m}, {"y_m", c.y_m}, {"distance_m", c.distance_m()}, {"heading_rad", c.heading_rad}};
  }
  return json;
}

}  // namespace

Json explanation_json(const Scenario& scenario, const Explanation& e) {
  Json effects = Json::array();
  for (const ExplainedEffect& effect : e.effects) {
    effects.push_back({{"name", effect.name},
                       {"alone", contributions_json(effect.alone)},
                       {"missed", contributions_json(effect.missed)}});
  }
  return {{"format", "umbsim-explanation/1"},
          {"scenario", scenario.name},
          {"seed", scenario.seed},
          {"whole", contributions_json(e.whole)},
          {"without_effects", contributions_json(e.baseline)},
          {"effects", std::move(effects)},
          {"sum_alone", contributions_json(e.sum_alone)},
          {"interaction", contributions_json(e.interaction)}};
}

Json explained_runs_json(const Scenario& scenario, const Explanation& e) {
  const RobotModel nominal = load_scenario_robot(scenario);
  Json json{{"runs", Json::array()}, {"wheelbase_m", nominal.wheelbase_m()}};
  if (scenario.course.shape == "square") json["side_m"] = scenario.course.side_m;
  for (const ExplainedRun& run : e.runs) {
    Json item{{"id", run.id}, {"direction", run.direction}, {"stage", run.with}};
    add_digest(item, run.digest, nullptr);
    json["runs"].push_back(std::move(item));
  }
  json["robot"] = robot_scene_json(scenario_urdf_text(scenario), scenario_urdf(scenario), nominal);
  json["floor"] = floor_scene_json(rig_for(scenario, nominal, {}).floor);
  return json;
}

}  // namespace umbsim

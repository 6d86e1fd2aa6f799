#include "experiment/output/build_info.h"
#include "experiment/output/result_json.h"
#include "experiment/output/scene_json.h"

namespace umbsim {
namespace {

void add_runs(Json& json, const DrivenRuns& driven, const char* stage) {
  for (std::size_t i = 0; i < driven.recording.runs.size(); ++i) {
    const RecordedRun& run = driven.recording.runs[i];
    const bool bumped = !run.bumps.empty() || run.inner_wheel_bumps;
    const ReturnError& e = driven.digests[i].error;
    Json item{{"id", run.id},
              {"direction", run.direction},
              {"stage", bumped ? "bumped" : stage},
              {"error", {{"x_m", e.x_m}, {"y_m", e.y_m}, {"theta_rad", e.theta_rad}}}};
    add_digest(item, driven.digests[i], &driven.tracks[i]);
    json["runs"].push_back(std::move(item));
    for (const RecordedBump& b : run.bumps) {
      json["bumps"].push_back({{"run", run.id}, {"x_m", b.x_m}, {"y_m", b.y_m}, {"height_m", b.height_m}});
    }
  }
}

}  // namespace

Json report_json(const ExperimentResult& r) {
  Json json{{"title", r.recording.title},
            {"scenario", r.scenario.name},
            {"description", r.scenario.description},
            {"version", build_info().version},
            {"seed", r.scenario.seed},
            {"wheelbase_m", r.odometry.wheelbase_m},
            {"summary", summary_json(r)}};
  if (r.scenario.course.shape == "square") json["side_m"] = r.scenario.course.side_m;
  json["summary"]["cost"].erase("wall_s");  // the page is the same bytes on every run
  json["runs"] = Json::array();
  json["bumps"] = Json::array();
  add_runs(json, r, "before");
  if (!r.passes.empty()) add_runs(json, r.passes.back(), "after");
  const std::string urdf = scenario_urdf(r.scenario);
  json["robot"] = robot_scene_json(scenario_urdf_text(r.scenario), urdf, r.nominal);
  json["floor"] = floor_scene_json(rig_for(r.scenario, r.nominal, {}).floor);
  json["provenance"] = page_provenance_json(r.scenario.file, r.scenario.seed);
  return json;
}

}  // namespace umbsim

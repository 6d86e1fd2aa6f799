#include "experiment/output/figures.h"

#include <unordered_map>

#include "experiment/output/result_json.h"
#include "experiment/wheel_loads.h"

namespace umbsim {
namespace {

using Figures = std::vector<std::pair<std::string, Cell>>;

void flatten(const Json& json, const std::string& path, Figures& figures) {
  const auto inner = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) flatten(value, inner(key), figures);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) flatten(json[i], inner(std::to_string(i)), figures);
  } else if (json.is_number()) {
    figures.emplace_back(path, json.get<double>());
  } else if (json.is_null()) {
    figures.emplace_back(path, Cell{});  // a figure that this experiment does not have
  }
}

Figures flattened(const ExperimentResult& result) {
  Json summary = summary_json(result);
  summary.erase("seed");
  summary["cost"].erase("wall_s");
  Figures figures;
  flatten(summary, "", figures);
  figures.emplace_back("warnings", double(run_warnings(result).size()));
  return figures;
}

// An experiment that has everything: two directions with two runs each, cables, uncertainty, a calibration pass.
ExperimentResult complete_result() {
  ExperimentResult r;
  r.scenario.uncertainty = {1, 1};
  r.cw.errors.resize(2);
  r.ccw.errors.resize(2);
  r.umbmark.emplace().cw = r.cw;
  r.umbmark->ccw = r.ccw;
  r.extended.emplace().cw = r.cw;
  r.extended->ccw = r.ccw;
  for (const char* direction : {"cw", "ccw"}) {
    RecordedRun run;
    run.direction = direction;
    r.recording.runs.push_back(run);
    TrackSample sample{};
    sample.estimate.covariance.setIdentity();
    r.tracks.emplace_back();
    r.tracks.back().end = sample;
  }
  r.odometry = {1, 1, 1, 1};
  CalibrationPass pass{{r.recording, r.digests, r.tracks, {}}, r.odometry, *r.umbmark};
  pass.umbmark.e_max_syst_m = 1;
  r.passes.push_back(std::move(pass));
  return r;
}

}  // namespace

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, value] : flattened(complete_result())) list.push_back(name);
    return list;
  }();
  return names;
}

std::vector<Cell> figures_of(const ExperimentResult& result) {
  static const std::unordered_map<std::string, std::size_t> places = [] {
    std::unordered_map<std::string, std::size_t> map;
    for (const std::string& name : figure_names()) map.emplace(name, map.size());
    return map;
  }();
  std::vector<Cell> cells(places.size());
  for (const auto& [name, value] : flattened(result)) {
    const auto place = places.find(name);
    if (place != places.end()) cells[place->second] = value;
  }
  return cells;
}

}  // namespace umbsim

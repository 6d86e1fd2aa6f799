#include "bench/worlds/score/score.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "core/error.h"
#include "core/text/text_file.h"
#include "experiment/replay/replay.h"
#include "gap/trial/write/seal.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGroups[] = {"engine", "driver", "tracker", "runs", "robot"};

double leaning(const Diagnosis& d) {
  for (const Cause& c : d.causes) {
    if (c.effects.count("unknown")) return c.probability;
  }
  return 0;
}

bool has_parameters(const std::string& effect) {
  for (const EffectInfo& info : catalogue()) {
    if (info.name == effect) return true;
  }
  return false;
}

void weigh_what_is_not_there(const TrialFolder& folder, WorldVerdict& w) {
  const Verdict& v = w.verdict;
  if (v.failed || v.diagnosis.causes.empty()) return;
  const Json json = read_json(folder.diagnoses() / v.name / "diagnosis.json");
  const Json& floor = json.at("gap").at("noise_floor_mm");
  const Cause& first = v.diagnosis.causes.front();
  for (const std::string& effect : first.effects) {
    if (!has_parameters(effect) || v.answer.effects.count(effect)) continue;
    const auto p = first.parameters.find(effect);
    const double floor_mm = floor.is_number() ? floor.get<double>() : 0;
    w.not_there.push_back(worth(folder.recordings() / v.name, effect,
                                p == first.parameters.end() ? std::map<std::string, ParameterEstimate>{} : p->second,
                                floor_mm));
  }
}

void group(WorldScore& score) {
  std::map<std::string, std::map<std::string, std::vector<const WorldVerdict*>>> cases;
  std::vector<const WorldVerdict*> all;
  for (const WorldVerdict& w : score.verdicts) {
    all.push_back(&w);
    for (const auto& [by, which] : w.groups) cases[by][which].push_back(&w);
    if (w.kind == "single" || w.kind == "outside" || w.kind == "excluded")
      cases["effect"][w.verdict.truth].push_back(&w);
  }
  score.all = world_figures(all);
  for (const auto& [by, groups] : cases) {
    for (const auto& [which, verdicts] : groups) score.groups[by][which] = world_figures(verdicts);
  }
}

// What sets of runs, drivers and trackers show in sizes of files is no secret; the effect must not show.
LeakFigure leak_of(const TrialFolder& folder, const std::vector<WorldVerdict>& verdicts) {
  std::vector<std::vector<double>> features;
  std::vector<std::string> labels;
  for (const WorldVerdict& w : verdicts) {
    if (w.kind == "pair" || w.kind == "triple") continue;
    features.push_back(metadata(folder.recordings() / w.verdict.name));
    labels.push_back(w.verdict.truth);
  }
  return metadata_leak(features, labels);
}

}  // namespace

double worth(const fs::path& directory, const std::string& effect,
             const std::map<std::string, ParameterEstimate>& parameters, double noise_floor_mm) {
  Effect named = neutral_effect(find_effect(effect));
  for (std::size_t i = 0; i < named.info->parameters.size(); ++i) {
    const auto p = parameters.find(named.info->parameters[i].name);
    if (p != parameters.end()) named.values.numbers[i] = p->second.value;
  }
  if (noise_floor_mm <= 0) return 0;
  const Recording recording = read_recording(directory);
  const Replay replay(scenario_of(recording, directory.string()), recording);
  double sum = 0, count = 0;
  for (std::size_t run = 0; run < recording.runs.size(); ++run) {
    const std::vector<Pose2> with = replay.poses(run, {named}), without = replay.poses(run, {});
    for (std::size_t i = 0; i < with.size(); ++i) {
      sum += std::pow(with[i].x_m - without[i].x_m, 2) + std::pow(with[i].y_m - without[i].y_m, 2);
      ++count;
    }
  }
  return 1000 * std::sqrt(sum / count) / noise_floor_mm;
}

WorldScore score_worlds(const TrialFolder& folder) {
  const TrialScore trial = score_trial(folder, folder.answers());
  const Json answers = Json::parse(read_text_file(folder.answers(), kMaxAnswerBytes)).at("cases");
  WorldScore score;
  score.name = trial.trial;
  score.answers_sha256 = trial.answers_sha256;
  score.sealed = trial.sealed;
  for (const Verdict& v : trial.verdicts) {
    const Json world = answers.at(v.name).value("world", Json::object());
    score.worlds_redrawn += world.value("worlds_redrawn", 0);
    if (!fs::exists(folder.diagnoses() / v.name)) {
      ++score.not_diagnosed;
      continue;
    }
    WorldVerdict w;
    w.verdict = v;
    w.kind = world.value("kind", std::string(v.answer.effects.empty() ? "none" : "single"));
    for (const char* by : kGroups) w.groups[by] = world.value(by, std::string("?"));
    w.unknown = leaning(v.diagnosis);
    w.steps = world.value("steps", 0.0);
    w.of_the_world = world.value("of_the_world", 0.0);
    score.verdicts.push_back(std::move(w));
  }
  tbb::parallel_for(std::size_t(0), score.verdicts.size(),
                    [&](std::size_t i) { weigh_what_is_not_there(folder, score.verdicts[i]); });
  group(score);
  score.leak = leak_of(folder, score.verdicts);
  return score;
}

}  // namespace umbsim::worlds

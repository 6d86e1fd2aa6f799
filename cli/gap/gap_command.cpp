#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "cli/commands.h"
#include "cli/gap/gap_menu.h"
#include "cli/gap/gap_recordings.h"
#include "cli/gap/gap_simulator.h"
#include "cli/help/help.h"
#include "cli/jobs.h"
#include "cli/output/answer.h"
#include "cli/output/pages.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "experiment/output/build_info.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"
#include "experiment/output/scene_json.h"
#include "experiment/replay/replay.h"
#include "gap/answer/twin.h"
#include "gap/diagnose.h"
#include "gap/output/diagnosis_json.h"
#include "gap/output/diagnosis_text.h"
#include "gap/output/tracks_json.h"
#include "gap/output/verdict.h"
#include "gap/plan/ties.h"
#include "gap/replay/remembered.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct DiagnoseArguments {
  std::vector<std::string> recordings;
  std::string scenario;
  std::vector<std::string> excluded;
  std::string out;
  bool force = false;
  bool open = false;
  Answer answer;
  bool no_cache = false;
  int jobs = 0;
};

// The scenario with the diagnosed effects added; each effect once. Wheels that scrub need the floor that they scrub on.
Scenario twin(Scenario scenario, const Replay& replay, const gap::Diagnosis& d) {
  const gap::Fit& fit = d.driven_twin();
  if (!fit.hypotheses.empty()) {
    std::vector<Effect> once;
    for (const Effect& e : combined(scenario.effects, fit.driven_at(fit.p))) {
      const auto there =
          std::find_if(once.begin(), once.end(), [&](const Effect& other) { return other.info == e.info; });
      if (there == once.end())
        once.push_back(e);
      else
        *there = e;
    }
    scenario.effects = std::move(once);
    double& roughness = scenario.noise.wheel_noise_m_per_sqrt_m;
    if (roughness == 0 && replay.scrubs(scenario.effects)) {
      const double walk = std::sqrt(d.noise.heading_rad2_pm);
      roughness =
          std::min(kRoughest_m_per_sqrt_m, gap::roughness_m_per_sqrt_m(walk, replay.recording().robot.wheelbase_m));
    }
  }
  return scenario;
}

// What to drive next, where something is tied: the menu is driven by the nominal robot.
std::vector<gap::NextExperiment> next_runs(const Scenario& scenario, const Recording& recording, const gap::Ties& ties,
                                           const gap::NoiseModel& noise, bool no_cache) {
  if (ties.members.size() <= ties.own) return {};
  const std::vector<gap::MenuRun> menu = menu_for(scenario, recording.path);
  Recording without_runs = recording;
  without_runs.runs.clear();
  const Recording driven = with_menu(std::move(without_runs), scenario, menu);
  const Replay replay(scenario, driven);
  const gap::Campaign campaign = gap::campaign_of(driven);
  const gap::Model model(campaign, gap::remembered(cached_gap_simulator(replay, no_cache), driven), gap::Scatter{},
                         noise);
  std::vector<std::string> labels;
  for (const gap::MenuRun& m : menu) labels.push_back(m.label);
  return gap::next_experiments(model, labels, ties, gap::Thresholds{});
}

// The page is the same bytes on every run: without the cost.
Json page(const gap::Model& model, const gap::Diagnosis& d, const Json& json, const Scenario& scenario,
          const std::string& given) {
  Json data{{"title", "Gap diagnosis: " + model.recording().title}, {"version", build_info().version}};
  data["diagnosis"] = json;
  data["diagnosis"].erase("cost");
  data["runs"] = gap::tracks_json(model, d);
  data["side_m"] = model.recording().path.side_m;
  data["robot"] =
      robot_scene_json(scenario_urdf_text(scenario), scenario_urdf(scenario), load_scenario_robot(scenario));
  data["robot"]["wheelbase_m"] = model.recording().robot.wheelbase_m;
  data["floor"] = floor_scene_json(rig_for(scenario, load_scenario_robot(scenario), {}).floor);
  data["provenance"] = page_provenance_json(given, 0);
  return data;
}

/// A diagnosis, and what to drive next.
struct Diagnosed {
  gap::Diagnosis diagnosis;
  std::vector<gap::NextExperiment> next;
};

Diagnosed diagnosed(const DiagnoseArguments& a, const GapRecordings& recordings, const gap::Model& model,
                    GapStages& stages) {
  const gap::ProgressCallback progress = [&](const std::string& stage, double share) { stages.report(stage, share); };
  const std::set<std::string> excluded(a.excluded.begin(), a.excluded.end());
  Diagnosed done{gap::diagnose(model, excluded, gap::Thresholds{}, progress), {}};
  gap::Diagnosis& d = done.diagnosis;
  d.limits.insert(d.limits.begin(), recordings.limits().begin(), recordings.limits().end());
  progress("what could be another effect", 0);
  const gap::Ties ties = gap::find_ties(model, d, excluded, gap::Thresholds{});
  gap::add_ties(ties, gap::Thresholds{}, d);
  progress("what to drive next", 0);
  done.next = next_runs(recordings.scenario(), recordings.campaign().parts.front(), ties, d.noise, a.no_cache);
  stages.done();
  return done;
}

Json json_of(const Diagnosed& done, double wall_s) {
  Json json = gap::diagnosis_json(done.diagnosis);
  json["next_experiment"] = Json::array();
  for (const gap::NextExperiment& n : done.next)
    json["next_experiment"].push_back({{"run", n.run}, {"separates", n.separates}});
  json["verdict"] = gap::verdict(done.diagnosis, done.next);
  json["cost"] = {{"wall_s", wall_s}, {"simulated_s", done.diagnosis.simulated_s}};
  return json;
}

void write_diagnosis(const fs::path& into, const DiagnoseArguments& a, const GapRecordings& recordings,
                     const gap::Model& model, const gap::Diagnosis& d, const Json& json) {
  write_text_file(into / "diagnosis.json", json.dump(2) + "\n");
  const std::string given = fmt::format("{}", fmt::join(a.recordings, " "));
  const Scenario found = twin(recordings.scenario(), recordings.replay(), d);
  write_page(into, PageKind::gap, page(model, d, json, found, given));
  write_scenario(found, into / "twin.yaml");
  write_text_file(into / "provenance.json", provenance_json(given, 0).dump(2) + "\n");
}

void run_diagnose(const DiagnoseArguments& a) {
  const ThreadLimit limit(a.jobs);
  const auto start = std::chrono::steady_clock::now();
  for (const std::string& e : a.excluded) find_effect(e);
  const GapRecordings recordings(a.recordings, a.scenario);
  const gap::Campaign& campaign = recordings.campaign();
  std::optional<ResultFolder> out;
  if (a.answer.wants_folder(a.out)) out.emplace(a.out, recordings.name() + "-diagnosis", a.force);
  GapStages stages(campaign.all.runs.size(), gap::stages_of_diagnosis());
  gap::Model model(campaign, stages.counted(recordings.simulator(a.no_cache)), gap::Scatter{});
  const Diagnosed done = diagnosed(a, recordings, model, stages);
  const Json json = json_of(done, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  std::string words = wrapped(fmt::format("{}: {}", recordings.name(), campaign.all.title)) +
                      gap::diagnosis_text(done.diagnosis, done.next);
  if (out) {
    out->write([&](const fs::path& into) { write_diagnosis(into, a, recordings, model, done.diagnosis, json); });
    words += fmt::format("Result in {}: diagnosis.json, twin.yaml; {}\n", out->said(), page_said(out->path()));
  }
  print_answer(a.answer, words, json);
  if (out) finish_page(out->path(), a.open);
}

}  // namespace

void add_gap_command(CLI::App& app) {
  CLI::App* group = app.add_subcommand("gap", "Diagnose the gap between a scenario and a recording");
  group->require_subcommand(1);
  add_example(group, "umbsim gap diagnose results/umbmark");
  const auto a = std::make_shared<DiagnoseArguments>();
  CLI::App* command = group->add_subcommand(
      "diagnose",
      "Where the simulator and the recorded robot part, which effect explains it, how much adding it helps");
  command
      ->add_option("recording", a->recordings,
                   "Folder of the recording (real or simulated); several of one robot are diagnosed together")
      ->required();
  command->add_option("--scenario", a->scenario,
                      "Scenario that was thought to describe it, with its effects; default: the recording's robot");
  command->add_option("--exclude", a->excluded, "Take an effect out of the catalogue (repeatable)")
      ->allow_extra_args(false);
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<recordings>-diagnosis");
  command->add_flag("--force", a->force, "Replace a finished result");
  add_answer_options(command, a->answer, "diagnosis.json");
  add_open_option(command, a->open);
  command->add_flag("--no-cache", a->no_cache, "Keep no simulated tracks in the user's cache folder, and use none");
  add_threads_option(*command, a->jobs);
  add_example(command, "umbsim gap diagnose results/umbmark --exclude bump");
  command->callback([a] { run_diagnose(*a); });
  add_gap_trial_command(*group);
  add_gap_predict_command(*group);
  add_gap_plan_command(*group);
}

}  // namespace umbsim

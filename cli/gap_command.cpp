#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/gap_menu.h"
#include "cli/gap_simulator.h"
#include "core/text_file.h"
#include "experiment/build_info.h"
#include "experiment/replay.h"
#include "experiment/result_json.h"
#include "experiment/run_folder.h"
#include "gap/check.h"
#include "gap/clock.h"
#include "gap/diagnosis_json.h"
#include "gap/plan_ties.h"
#include "gap/remembered.h"
#include "gap/tracks_json.h"
#include "report/report.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct DiagnoseArguments {
  std::string recording;
  std::string scenario;
  std::vector<std::string> excluded;
  std::string out;
  bool force = false;
  bool no_cache = false;
};

std::string folder_name(const std::string& path) {
  const fs::path p = fs::absolute(path).lexically_normal();
  return p.has_filename() ? p.filename().string() : p.parent_path().filename().string();
}

// The scenario with the diagnosed effects added; each effect once. Wheels that scrub need the floor that they scrub on.
std::string twin_yaml(Scenario scenario, const Replay& replay, const gap::Diagnosis& d) {
  if (!d.causes.empty() && d.causes.front().name != "none" && d.causes.front().name != "unknown" &&
      !d.twin_is_nominal) {
    std::vector<Effect> once;
    for (const Effect& e : combined(scenario.effects, gap::twin_effects(d.causes.front().fit))) {
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
  return resolved_yaml(scenario);
}

constexpr std::size_t kLongestUrdf = 16 << 20;  // bytes

// A robot that lay beside the recording lies beside the twin, too.
void keep_urdf(const Scenario& scenario, const fs::path& into) {
  const fs::path given = scenario.robot.urdf;
  const fs::path beside = fs::path(scenario.file).parent_path() / given;
  if (given.is_absolute() || !fs::exists(beside)) return;
  write_text_file(into / given.filename(), read_text_file(beside, kLongestUrdf));
}

std::string summary_text(const gap::Diagnosis& d, const std::vector<gap::NextExperiment>& next) {
  std::string text;
  if (!d.detected) {
    text += fmt::format("No gap beyond the noise (floor {:.1f} mm, scenario off by {:.1f} mm).\n", d.noise_floor_mm,
                        d.before_mm);
    if (d.set.size() > 1) text += fmt::format("Not told apart: {}\n", fmt::join(d.set, ", "));
  } else {
    text += fmt::format("Gap: the scenario is off by {:.1f} mm; run-to-run noise makes {:.1f} mm.\n", d.before_mm,
                        d.noise_floor_mm);
    text += fmt::format("Where: stage {}, pattern {}", d.stage, d.pattern.empty() ? "undecided" : d.pattern);
    if (d.has_place) text += fmt::format(", at ({:.2f}, {:.2f}) m", d.place_m[0], d.place_m[1]);
    text += "\nWhich:\n";
    for (std::size_t i = 0; i < d.causes.size() && i < 5; ++i) {
      const gap::Cause& c = d.causes[i];
      text += fmt::format("  {:5.1f} %  {}", 100 * c.probability, c.name);
      if (c.name != "unknown" && c.name != "none") {
        for (const auto& e : gap::parameter_estimates(c, d.overdispersion)) {
          text += fmt::format("  {} {:.5g} [{:.5g}, {:.5g}] {}", e.parameter, e.value, e.ci95[0], e.ci95[1],
                              e.unit == "1" ? "" : e.unit);
        }
      }
      text += "\n";
    }
    text += fmt::format("Not told apart: {}\n", fmt::join(d.set, ", "));
    for (const auto& group : d.indistinguishable)
      text += fmt::format("Alike in these runs: {}\n", fmt::join(group, ", "));
    for (const gap::NextExperiment& n : next) {
      text += fmt::format("Next: {} separates {}\n", n.run, fmt::join(n.separates, ", "));
    }
    if (!d.left_over.empty()) text += fmt::format("Left over: {}\n", d.left_over);
    if (d.closure.known) {
      text += fmt::format(
          "How far: held-out closure {:.1f} % [{:.1f}, {:.1f}]: {:.1f} mm -> {:.1f} mm, {:.3f} deg -> {:.3f} deg\n",
          100 * d.closure.fraction, 100 * d.closure.ci95[0], 100 * d.closure.ci95[1], d.closure.before_mm,
          d.closure.after_mm, d.closure.before_deg, d.closure.after_deg);
    }
  }
  for (const std::string& limit : d.limits) text += "Limit: " + limit + "\n";
  return text;
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
  const gap::Model model(driven, gap::remembered(cached_gap_simulator(replay, no_cache), driven), gap::Scatter{},
                         noise);
  std::vector<std::string> labels;
  for (const gap::MenuRun& m : menu) labels.push_back(m.label);
  return gap::next_experiments(model, labels, ties, gap::Thresholds{});
}

// The page is the same bytes on every run: without the cost.
std::string page(const gap::Model& model, const gap::Diagnosis& d, const Json& json) {
  Json data{{"title", "Gap diagnosis: " + model.recording().title}, {"version", build_info().version}};
  data["diagnosis"] = json;
  data["diagnosis"].erase("cost");
  data["runs"] = gap::tracks_json(model, d);
  return render_gap_report(data);
}

void run_diagnose(const DiagnoseArguments& a) {
  const auto start = std::chrono::steady_clock::now();
  const std::string out = a.out.empty() ? "results/" + folder_name(a.recording) + "-diagnosis" : a.out;
  for (const std::string& e : a.excluded) find_effect(e);
  const Recording given = read_recording(a.recording);
  std::vector<std::string> limits = gap::check_recording(given, a.recording);
  const Recording recording = gap::followed_through(given, limits);
  const Scenario scenario = a.scenario.empty() ? scenario_of(recording, a.recording) : read_scenario(a.scenario);
  prepare_output_folder(out, a.force);
  const Replay replay(scenario, recording);
  GapStages stages(recording.runs.size());
  const gap::Say say = [&](const std::string& stage) { stages.say(stage); };
  const gap::Simulator simulator = stages.counted(cached_gap_simulator(replay, a.no_cache));
  const gap::Model model(recording, gap::remembered(simulator, recording), gap::Scatter{});
  const std::set<std::string> excluded(a.excluded.begin(), a.excluded.end());
  gap::Diagnosis d = gap::diagnose(model, excluded, gap::Thresholds{}, say);
  d.limits.insert(d.limits.begin(), limits.begin(), limits.end());
  say("what could be another effect");
  const gap::Ties ties = gap::find_ties(model, d, excluded, gap::Thresholds{});
  gap::add_ties(ties, gap::Thresholds{}, d);
  const std::vector<gap::NextExperiment> next = next_runs(scenario, recording, ties, d.noise, a.no_cache);
  stages.done();
  Json json = gap::diagnosis_json(d);
  json["next_experiment"] = Json::array();
  for (const gap::NextExperiment& n : next) {
    json["next_experiment"].push_back({{"run", n.run}, {"separates", n.separates}});
  }
  json["cost"] = {{"wall_s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()},
                  {"simulated_s", d.simulated_s}};
  write_folder(out, a.force, [&](const fs::path& into) {
    write_text_file(into / "diagnosis.json", json.dump(2) + "\n");
    write_text_file(into / "report.html", page(model, d, json));
    write_text_file(into / "twin.yaml", twin_yaml(scenario, replay, d));
    keep_urdf(scenario, into);
    write_text_file(into / "provenance.json", provenance_json(a.recording, 0).dump(2) + "\n");
  });
  fmt::print("{}: {}\n{}Result in {}: diagnosis.json, twin.yaml; open {}/report.html\n", folder_name(a.recording),
             recording.title, summary_text(d, next), out, out);
}

}  // namespace

void add_gap_command(CLI::App& app) {
  CLI::App* group = app.add_subcommand("gap", "Diagnose the gap between a scenario and a recording");
  group->require_subcommand(1);
  const auto a = std::make_shared<DiagnoseArguments>();
  CLI::App* command = group->add_subcommand(
      "diagnose",
      "Where the simulator and the recorded robot part, which effect explains it, how much adding it helps");
  command->add_option("recording", a->recording, "Folder of the recording (real or simulated)")->required();
  command->add_option("--scenario", a->scenario,
                      "Scenario that was thought to describe it, with its effects; default: the recording's robot");
  command->add_option("--exclude", a->excluded, "Take an effect out of the catalogue (repeatable)")
      ->allow_extra_args(false);
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<recording>-diagnosis");
  command->add_flag("--force", a->force, "Replace a finished result");
  command->add_flag("--no-cache", a->no_cache, "Keep no simulated tracks in the user's cache folder, and use none");
  command->callback([a] { run_diagnose(*a); });
  add_gap_trial_command(*group);
  add_gap_predict_command(*group);
  add_gap_plan_command(*group);
}

}  // namespace umbsim

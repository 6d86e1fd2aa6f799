// Recordings of robots with known faults, driven in MuJoCo: what a diagnosis that was tuned on its own simulator has
// not seen. docs/trial.md, "Another engine".
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "bench/second_engine/cases.h"
#include "bench/second_engine/drive_case.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/random.h"
#include "gap/trial/answers.h"
#include "gap/trial/trial_folder.h"

namespace umbsim::second_engine {
namespace {

namespace fs = std::filesystem;

constexpr double kPayloadShare = 15.0 / 40;  // of the base's mass, as on the LabMate
constexpr double kTurnRadius_m = 0.4;

// The recommended runs, with a payload that suits the robot.
std::vector<PlannedRun> runs_of(const Platform& platform) {
  std::vector<PlannedRun> runs = recommended_runs();
  for (PlannedRun& run : runs) {
    if (run.payload_kg > 0) run.payload_kg = std::round(kPayloadShare * platform.robot.base_mass_kg * 10) / 10;
    if (run.turn_radius_m > 0) run.turn_radius_m = kTurnRadius_m;
  }
  return runs;
}

TrialPlan plan_of(const CaseList& list) {
  TrialPlan plan;
  plan.seed = list.seed;
  plan.noise = list.noise;
  return plan;
}

TrialDrive drive_of(const CaseList& list, std::size_t index) {
  const Case& c = list.cases[index];
  const Platform& platform = list.platforms.at(c.platform);
  TrialDrive drive;
  drive.robot = platform.robot;
  drive.planned = planned_recording(plan_of(list), platform, runs_of(platform));
  drive.planned.title = "second engine, case " + c.name;
  drive.effects = c.effects;
  drive.heading_walk_rad_per_sqrt_m = list.noise.heading_walk_rad_per_sqrt_m;
  drive.radius_scatter = list.noise.radius_scatter;
  drive.seed = RandomStream(list.seed, "second engine case " + c.name).bits() >> 1;
  return drive;
}

// By platform.
using Scales = std::map<std::string, std::unique_ptr<SeverityScale>>;

Scales severity_scales(const CaseList& list, const TrialSimulator& simulator) {
  Scales scales;
  for (const auto& [name, platform] : list.platforms) scales[name];
  tbb::parallel_for_each(scales.begin(), scales.end(), [&](auto& entry) {
    const Platform& platform = list.platforms.at(entry.first);
    const TrialPlan plan = plan_of(list);
    entry.second = std::make_unique<SeverityScale>(plan, platform, planned_recording(plan, platform, runs_of(platform)),
                                                   simulator);
  });
  return scales;
}

Json answer_of(const Case& c, const Scales* scales) {
  Json json{{"effects", Json::object()}, {"excluded", c.excluded}};
  for (const Effect& effect : c.effects) {
    const std::string& name = effect.info->name;
    json["effects"][name] = effect_json(effect);
    if (!scales) continue;
    const Signal signal = name == "motor_response" ? Signal::motors : Signal::odometry;
    const double severity = scales->at(c.platform)->severity(effect, signal);
    json["severities"][name] = {{"severity", severity}};
  }
  return json;
}

void write_case(const TrialDrive& drive, const EngineOptions& engine, const fs::path& folder) {
  try {
    write_whole(folder, [&](const fs::path& into) { write_recording(drive_case(engine, drive), into); });
  } catch (const RunError& e) {
    throw RunError(fmt::format("{}: {}", folder.filename().string(), e.what()));
  }
}

void write_answers(const CaseList& list, const std::vector<Json>& answers, const TrialFolder& folder) {
  Json all{{"format", "umbsim-trial-answers/1"}, {"cases", Json::object()}};
  std::vector<CaseEntry> entries;
  for (std::size_t i = 0; i < list.cases.size(); ++i) {
    all["cases"][list.cases[i].name] = answers[i];
    entries.push_back({list.cases[i].name, list.cases[i].excluded});
  }
  const std::string text = all.dump(1) + "\n";
  write_file_whole(folder.answers(), text);
  write_file_whole(folder.cases(), case_entries_text("second-engine", entries));
}

struct Arguments {
  std::string file;
  std::string folder;
  int jobs = 0;
  bool severities = true;
};

void generate(const Arguments& a) {
  const CaseList list = read_cases(a.file);
  const TrialFolder folder(a.folder);
  fs::create_directories(folder.recordings());
  const int jobs = a.jobs > 0 ? a.jobs : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  std::vector<Json> answers;
  for (const Case& c : list.cases) answers.push_back(answer_of(c, nullptr));
  write_answers(list, answers, folder);
  tbb::parallel_for(std::size_t(0), list.cases.size(), [&](std::size_t i) {
    write_case(drive_of(list, i), list.engine, folder.recordings() / list.cases[i].name);
  });
  if (a.severities) {
    const TrialSimulator simulator = [&](const TrialDrive& d) { return drive_case(list.engine, d); };
    const Scales scales = severity_scales(list, simulator);
    tbb::parallel_for(std::size_t(0), list.cases.size(),
                      [&](std::size_t i) { answers[i] = answer_of(list.cases[i], &scales); });
    write_answers(list, answers, folder);
  }
  fmt::print("{}: {} recordings\n", folder.root.string(), list.cases.size());
}

}  // namespace
}  // namespace umbsim::second_engine

int main(int argc, char** argv) {
  umbsim::second_engine::Arguments a;
  CLI::App app("Recordings of robots with known faults, driven in MuJoCo");
  app.add_option("cases", a.file, "List of cases (YAML, docs/trial.md)")->required();
  app.add_option("-o,--out", a.folder, "Folder of the recordings and answers")->required();
  app.add_option("-j,--jobs", a.jobs, "Cases at the same time; 0: one per core")->check(CLI::Range(0, 1024));
  app.add_flag("!--no-severities", a.severities, "Do not drive each effect again for its severity");
  CLI11_PARSE(app, argc, argv);
  try {
    umbsim::second_engine::generate(a);
    return 0;
  } catch (const umbsim::InputError& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 3;
  }
}

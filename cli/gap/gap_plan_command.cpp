#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "calibration/intake/intake.h"
#include "cli/commands.h"
#include "cli/gap/gap_menu.h"
#include "cli/gap/gap_simulator.h"
#include "cli/help/help.h"
#include "cli/jobs.h"
#include "cli/output/colour.h"
#include "cli/output/pages.h"
#include "cli/shipped.h"
#include "core/text/text_file.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"
#include "gap/noise/clock.h"
#include "gap/plan/json.h"
#include "gap/replay/remembered.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct PlanArguments {
  std::string subject;
  std::vector<std::string> effects;
  std::vector<std::string> excluded;
  std::string out;
  gap::PlanOptions options;
  bool force = false;
  bool open = false;
  bool no_cache = false;
  bool matrix = false;
  int jobs = 0;
};

/// The runs that are asked about, as the nominal robot drives them, and what is known of the noise.
struct Subject {
  std::string name;
  Scenario scenario;
  Recording recording;
  gap::NoiseModel noise;
  gap::Scatter scatter;
  std::vector<std::string> limits;
};

// Noise as a scenario describes it; counting is part of it (gap/evidence/model.cpp).
gap::NoiseModel noise_of(const Scenario& s, const RecordedRobot& robot, std::vector<std::string>& limits) {
  gap::NoiseModel noise;
  const double k = s.noise.wheel_noise_m_per_sqrt_m;
  if (k > 0) {
    // Both wheels' paths vary by k^2 per metre: the heading by 2 k^2 / b^2, the way by k^2 / 2.
    noise.heading_rad2_pm = 2 * k * k / (robot.wheelbase_m * robot.wheelbase_m);
    noise.along_m2_pm = k * k / 2;
  } else {
    limits.push_back("the scenario has no noise of the wheels: a usual value is taken");
  }
  if (s.noise.floor_rms_m > 0) limits.push_back("the uneven floor of `noise` is not part of the noise floor");
  constexpr double kGoodTracker = 1e-4;  // m, rad: as where a recording does not say
  const double rounding_m = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution / std::sqrt(12.0);
  const auto or_good = [](double sd) { return sd > 0 ? sd : kGoodTracker; };
  noise.position_sd_m = std::hypot(or_good(s.truth.position_sd_m), rounding_m / M_SQRT2);
  noise.heading_sd_rad = std::hypot(or_good(s.truth.heading_sd_rad), rounding_m * M_SQRT2 / robot.wheelbase_m);
  return noise;
}

Subject of_scenario(const std::string& file) {
  Subject s;
  s.scenario = read_scenario(shipped_path(ShippedKind::scenario, file));
  s.name = s.scenario.name;
  s.recording = gap::with_moments_between(run_experiment(nominal_scenario(s.scenario), 0, false).recording);
  s.recording.title = s.scenario.description.empty() ? s.name : s.scenario.description;
  s.recording.truth_position_sd_m = s.scenario.truth.position_sd_m;
  s.recording.truth_heading_sd_rad = s.scenario.truth.heading_sd_rad;
  s.noise = noise_of(s.scenario, s.recording.robot, s.limits);
  if (s.scenario.noise.radius_scatter > 0) s.scatter.radius = s.scenario.noise.radius_scatter;
  return s;
}

// The recorded poses give the noise and the start, and are then replaced by what the nominal robot would do.
Subject of_recording(const std::string& folder, bool no_cache) {
  Subject s;
  intake::Intake given = intake::take_in(folder);
  s.limits = std::move(given.limits);
  s.name = folder_name(folder);
  s.recording = gap::followed_through(given.recording, s.limits);
  s.scenario = scenario_of(s.recording, folder);
  const Replay replay(s.scenario, s.recording);
  const gap::Campaign campaign = gap::campaign_of(s.recording);
  const gap::Model model(campaign, gap::remembered(cached_gap_simulator(replay, no_cache), s.recording), s.scatter);
  s.noise = model.noise();
  Recording nominal = s.recording;
  for (std::size_t r = 0; r < nominal.runs.size(); ++r) {
    for (std::size_t k = 0; k < nominal.runs[r].truth.size(); ++k) {
      nominal.runs[r].truth[k].X_WB = model.nominal().tracks[r][k];
    }
  }
  s.recording = std::move(nominal);
  return s;
}

// A folder that is none may have the name of a shipped scenario.
bool is_recording(const std::string& subject) {
  if (fs::exists(fs::path(subject) / "recording.yaml")) return true;
  return fs::is_directory(subject) && shipped_path(ShippedKind::scenario, subject) == subject;
}

std::vector<double> durations_s(const Recording& recording) {
  std::vector<double> result;
  for (const RecordedRun& run : recording.runs) result.push_back(run.encoders.back().time_s);
  return result;
}

gap::PlanOptions options_of(const PlanArguments& a) {
  gap::PlanOptions options = a.options;
  for (const std::string& e : a.effects) options.effects.insert(find_effect(e).name);
  if (a.effects.empty()) {
    for (const EffectInfo& info : catalogue()) options.effects.insert(info.name);
  }
  for (const std::string& e : a.excluded) options.effects.erase(find_effect(e).name);
  if (options.effects.size() < 2) throw InputError("gap plan: at least two effects are needed, to be told apart");
  return options;
}

void plan(const PlanArguments& a) {
  const ThreadLimit limit(a.jobs);
  const gap::PlanOptions options = options_of(a);
  Subject s = is_recording(a.subject) ? of_recording(a.subject, a.no_cache) : of_scenario(a.subject);
  ResultFolder out(a.out, s.name + "-plan", a.force);
  gap::PlanContext context{s.recording.title, {}, {}, s.recording.runs.size(), s.limits};
  for (const RecordedRun& run : s.recording.runs) context.labels.push_back(run.id);
  const std::vector<gap::MenuRun> menu = menu_for(s.scenario, s.recording.path);
  for (const gap::MenuRun& m : menu) context.labels.push_back(m.label);
  const Recording all = with_menu(s.recording, s.scenario, menu);
  context.durations_s = durations_s(all);
  const Replay replay(s.scenario, all);
  GapStages stages(all.runs.size(), gap::stages_of_plan());
  const gap::ProgressCallback progress = [&](const std::string& stage, double share) { stages.report(stage, share); };
  const gap::Simulator simulator = stages.counted(cached_gap_simulator(replay, a.no_cache));
  const gap::Campaign campaign = gap::campaign_of(all);
  const gap::Model model(campaign, gap::remembered(simulator, all), s.scatter, s.noise);
  const gap::Plan result = gap::plan(model, context.given, s.scatter.radius, options, progress);
  stages.done();
  out.write([&](const fs::path& into) {
    const Json json = gap::plan_json(result, context, options, s.noise);
    write_text_file(into / "plan.json", json.dump(1) + "\n");
    write_page(into, PageKind::plan, plan_page(json, s.name, page_provenance_json(a.subject, options.seed)));
    write_text_file(into / "provenance.json", provenance_json(a.subject, options.seed).dump(2) + "\n");
  });
  print_words(gap::plan_text(result, context, options, a.matrix) +
              fmt::format("Result in {}: plan.json; {}\n", out.said(), page_said(out.path())));
  finish_page(out.path(), a.open);
}

}  // namespace

void add_gap_plan_command(CLI::App& group) {
  const auto a = std::make_shared<PlanArguments>();
  CLI::App* command = group.add_subcommand(
      "plan", "Before any data: which effects a set of runs can tell apart, and the shortest set that does");
  command->add_option("subject", a->subject, "Scenario (its own runs) or folder of a recording (the same runs)")
      ->required();
  command->add_option("--effects", a->effects, "Effects to be told apart, by commas; default: the catalogue")
      ->delimiter(',');
  command->add_option("--exclude", a->excluded, "Leave an effect out (repeatable)")->allow_extra_args(false);
  command->add_option("--severity", a->options.severity, "Size of each effect in noise floors of these runs")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--alike", a->options.alike, "Probability of a mistake above which two effects are not told apart")
      ->check(CLI::Range(0.001, 0.5))
      ->capture_default_str();
  command->add_option("--draws", a->options.draws, "Sampled cases of each effect")
      ->check(CLI::Range(10, 100000))
      ->capture_default_str();
  command->add_option("--seed", a->options.seed, "Of the sampled cases")->capture_default_str();
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<name>-plan");
  command->add_flag("--force", a->force, "Replace a finished result");
  add_open_option(command, a->open);
  command->add_flag("--no-cache", a->no_cache, "Keep no simulated tracks in the user's cache folder, and use none");
  command->add_flag("--matrix", a->matrix, "Print the whole matrix of what would be named for what");
  add_threads_option(*command, a->jobs);
  add_example(command, "umbsim gap plan umbmark");
  command->callback([a] { plan(*a); });
}

}  // namespace umbsim

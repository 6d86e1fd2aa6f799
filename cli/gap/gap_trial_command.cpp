#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/help/help.h"
#include "cli/output/pages.h"
#include "cli/shipped.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "experiment/drive/planned_runs.h"
#include "experiment/output/build_info.h"
#include "experiment/output/result_json.h"
#include "experiment/output/run_folder.h"
#include "gap/noise/track_filter.h"
#include "gap/trial/diagnose/diagnose_cases.h"
#include "gap/trial/score/score.h"
#include "gap/trial/write/generate.h"
#include "report/score_page.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct TrialArguments {
  std::string file;
  std::string folder;
  std::string shard = "1/1";
  std::string program;
  std::string cache;
  std::string answers;
  int jobs = 0;
  bool retry = false;
};

RobotModel load_trial_robot(const TrialRobot& robot) {
  const ScratchFolder scratch;
  const fs::path urdf = scratch.path() / kTrialUrdf;
  write_text_file(urdf, robot_urdf(robot));
  return load_robot(urdf.string());
}

// The simulator as gap/trial/ asks for it.
Recording simulate(const TrialDrive& drive) {
  Scenario s;
  s.seed = drive.seed;
  s.effects = drive.effects;
  s.noise.radius_scatter = drive.radius_scatter;
  s.noise.motor_scatter = drive.motor_scatter;
  s.noise.wheel_noise_m_per_sqrt_m =
      gap::roughness_m_per_sqrt_m(drive.heading_walk_rad_per_sqrt_m, drive.robot.wheelbase_m);
  s.truth.kind = drive.planned.truth_kind;
  s.truth.position_sd_m = drive.planned.truth_position_sd_m;
  s.truth.heading_sd_rad = drive.planned.truth_heading_sd_rad;
  return drive_planned_runs(s, load_trial_robot(drive.robot), drive.planned);
}

std::string default_folder(const TrialPlan& plan) { return "results/trial-" + plan.name; }

void generate(const TrialArguments& a) {
  const TrialPlan plan = read_trial(shipped_path(ShippedKind::trial, a.file));
  const TrialFolder folder(a.folder.empty() ? default_folder(plan) : a.folder);
  const GenerateResult result = generate_trial(plan, folder, simulate, parse_shard(a.shard), a.jobs);
  fmt::print("{}: {} of {} cases stand\n", folder.root.string(), result.finished, result.cases);
  if (result.seal) fmt::print("SHA-256 of the answers: {}\n", *result.seal);
}

void diagnose(const TrialArguments& a) {
  const fs::path program = a.program.empty() ? fs::read_symlink("/proc/self/exe") : fs::absolute(a.program);
  const TrialFolder folder(a.folder);
  const DiagnoseResult result = diagnose_cases(folder, {program, a.cache, parse_shard(a.shard), a.jobs, a.retry});
  fmt::print("{}: {} of {} cases diagnosed, {} of them failed\n", folder.root.string(), result.finished, result.cases,
             result.failed);
}

void write_score(const TrialScore& score, const fs::path& folder, const fs::path& answers) {
  const Confusion c = confusion(score.verdicts);
  write_folder(folder, true, [&](const fs::path& into) {
    const Json json = score_json(score);
    write_text_file(into / "summary.json", json.dump(1) + "\n");
    write_page(into, PageKind::score,
               score_page(json, folder, build_info().version, page_provenance_json(answers.string(), 0)));
    write_text_file(into / "summary.md", score_markdown(score));
    write_text_file(into / "table.txt", score_table(score));
    write_text_file(into / "confusion.csv", confusion_csv(c));
    write_text_file(into / "confusion.svg", confusion_svg(c, "Trial " + score.trial));
    write_text_file(into / "provenance.json", provenance_json(answers.string(), 0).dump(2) + "\n");
  });
}

void score(const TrialArguments& a) {
  const TrialFolder folder(a.folder);
  const fs::path answers = a.answers.empty() ? folder.answers() : fs::path(a.answers);
  const TrialScore result = score_trial(folder, answers);
  write_score(result, folder.score(), answers);
  fmt::print("{}Result in {}: summary.json, summary.md, table.txt, confusion.csv, confusion.svg; {}\n",
             wrapped_lines(score_table(result), 6), folder.score().string(), page_said(folder.score().string()));
}

void whole_trial(TrialArguments a) {
  a.file = shipped_path(ShippedKind::trial, a.file, {"generate", "diagnose", "score"});
  if (a.folder.empty()) a.folder = default_folder(read_trial(a.file));
  generate(a);
  diagnose(a);
  score(a);
}

using Arguments = std::shared_ptr<TrialArguments>;

void add_jobs(CLI::App& command, const Arguments& a) {
  command.add_option("-j,--jobs", a->jobs, "Cases at the same time, and cores for all of them; 0: one per core")
      ->check(CLI::Range(0, 1024));
}

void add_shard(CLI::App& command, const Arguments& a) {
  command.add_option("--shard", a->shard, "Do only part i of n of the cases: i/n")->capture_default_str();
}

void add_diagnosis(CLI::App& command, const Arguments& a) {
  command.add_option("--program", a->program,
                     "Program to be tried, called as `PROGRAM gap diagnose RECORDING --out FOLDER "
                     "[--exclude EFFECT]...`; default: this one");
  command.add_option("--cache", a->cache, "Cache folder that all diagnoses share; default: cache/ of the trial");
  command.add_flag("--retry", a->retry, "Diagnose again where the process failed before");
}

void add_folder(CLI::App& command, const Arguments& a) {
  command.add_option("folder", a->folder, "Folder of the trial")->required();
}

void add_generate(CLI::App& trial, const Arguments& a) {
  CLI::App* command = trial.add_subcommand("generate", "Draw the cases, drive them, seal the answers");
  command->add_option("trial", a->file, "Trial: a file (YAML) or a shipped one's name")->required();
  command->add_option("-o,--out", a->folder, "Folder of the trial; default results/trial-<name>");
  add_jobs(*command, a);
  add_shard(*command, a);
  add_example(command, "umbsim gap trial generate ci");
  command->callback([a] { generate(*a); });
}

void add_diagnose(CLI::App& trial, const Arguments& a) {
  CLI::App* command =
      trial.add_subcommand("diagnose", "Diagnose every case in a process that is given its recording alone");
  add_folder(*command, a);
  add_diagnosis(*command, a);
  add_jobs(*command, a);
  add_shard(*command, a);
  add_example(command, "umbsim gap trial diagnose results/trial-ci");
  command->callback([a] { diagnose(*a); });
}

void add_score(CLI::App& trial, const Arguments& a) {
  CLI::App* command = trial.add_subcommand("score", "Open the answers and compare");
  add_folder(*command, a);
  command->add_option("--answers", a->answers, "Answers file (JSON or YAML, docs/trial.md); default: the trial's own");
  add_example(command, "umbsim gap trial score results/trial-ci");
  command->callback([a] { score(*a); });
}

}  // namespace

void add_gap_trial_command(CLI::App& gap) {
  const auto a = std::make_shared<TrialArguments>();
  CLI::App* trial = gap.add_subcommand(
      "trial", "Draw cases whose effect is withheld, have them diagnosed, score; does what is not done yet");
  trial->require_subcommand(0, 1);
  trial->add_option("trial", a->file, "Trial: a file (YAML) or a shipped one's name");
  trial->add_option("-o,--out", a->folder, "Folder of the trial; default results/trial-<name>");
  add_diagnosis(*trial, a);
  add_jobs(*trial, a);
  add_generate(*trial, std::make_shared<TrialArguments>());
  add_diagnose(*trial, std::make_shared<TrialArguments>());
  add_score(*trial, std::make_shared<TrialArguments>());
  add_example(trial, "umbsim gap trial ci");
  trial->callback([a, trial] {
    if (!trial->get_subcommands().empty()) return;
    if (a->file.empty()) throw CLI::RequiredError("TRIAL.yaml, generate, diagnose or score");
    whole_trial(*a);
  });
}

}  // namespace umbsim

#include <memory>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/tables.h"
#include "core/text_file.h"
#include "experiment/figures.h"
#include "experiment/junit.h"
#include "experiment/result_json.h"
#include "experiment/run.h"
#include "experiment/run_folder.h"
#include "report/report.h"

namespace umbsim {
namespace {

struct RunArguments {
  std::string scenario = UMBSIM_SCENARIOS_DIR "/umbmark.yaml";
  std::string out;
  std::string junit;
  std::vector<std::string> settings;
  bool force = false;
  int jobs = 0;
};

// The expectations of the scenario, held against its figures.
std::vector<Check> check(const ExperimentResult& result) {
  return umbsim::check(result.scenario.expect, {figure_names(), {{0, result.scenario.name, "", figures_of(result)}}});
}

void run(const RunArguments& a) {
  const Scenario scenario = read_scenario(a.scenario, a.settings);
  const std::string out = a.out.empty() ? "results/" + scenario.name : a.out;
  prepare_output_folder(out, a.force);
  std::optional<tbb::global_control> limit;  // of writing, too
  if (a.jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(a.jobs));
  const ExperimentResult result = run_experiment(scenario, a.jobs);
  write_run_folder(result, render_report(report_json(result)), out, a.force);
  const std::vector<Check> checks = check(result);
  if (!a.junit.empty()) replace_text_file(a.junit, junit_xml(scenario.name, checks, {}));
  fmt::print("{}{}Result in {}: open {}/report.html\n", experiment_table(result), checks_text(checks), out, out);
  if (!all_met(checks)) throw Exit(kUnmet, "an expectation was not met");
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto a = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "Drive a scenario's squares, measure, calibrate, drive again, report");
  command->add_option("scenario", a->scenario, "Scenario file (YAML); without one the LabMate UMBmark is run");
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<scenario name>");
  command->add_option("--set", a->settings, "Replace a value of the scenario: --set course.side_m=2 (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--junit", a->junit, "Write what the scenario's expectations say as JUnit XML");
  command->add_flag("--force", a->force, "Replace a finished result");
  command->add_option("-j,--jobs", a->jobs, "Runs driven at the same time; 0: one per core")
      ->check(CLI::Range(0, 1024));
  command->callback([a] { run(*a); });
}

}  // namespace umbsim

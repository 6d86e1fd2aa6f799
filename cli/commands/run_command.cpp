#include <fmt/format.h>

#include <memory>
#include <optional>

#include "batch/stop.h"
#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/help/help.h"
#include "cli/jobs.h"
#include "cli/output/answer.h"
#include "cli/output/pages.h"
#include "cli/output/tables.h"
#include "cli/shipped.h"
#include "core/text/text_file.h"
#include "experiment/output/figures.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"
#include "experiment/output/run_folder.h"
#include "experiment/output/run_size.h"
#include "experiment/run.h"
#include "experiment/sweep/junit.h"
#include "report/report.h"

namespace umbsim {
namespace {

struct RunArguments {
  std::string scenario = "umbmark";
  std::string out;
  std::string junit;
  std::vector<std::string> settings;
  bool force = false;
  bool open = false;
  Answer answer;
  int jobs = 0;
};

// The expectations of the scenario, held against its figures.
std::vector<Check> check(const ExperimentResult& result) {
  return umbsim::check(result.scenario.expect, {figure_names(), {{0, result.scenario.name, "", figures_of(result)}}});
}

// Rows are written while they are driven: what stands so far goes before the program does.
void stop_if_asked() {
  if (const int signal = StopRequests::received()) throw Exit(kSignalled + signal, "stopped; nothing was written");
}

void run(const RunArguments& a) {
  const StopRequests listen;  // before anything is written
  const Scenario scenario = read_scenario(shipped_path(ShippedKind::scenario, a.scenario), a.settings);
  std::optional<ResultFolder> out;
  if (a.answer.wants_folder(a.out)) out.emplace(a.out, scenario.name, a.force);
  if (!a.answer.quiet) {
    print_warnings(assumed_of_robot(scenario));
    print_warnings(silent_effects(scenario, load_scenario_robot(scenario)));
  }
  if (out) check_room(expected_size(scenario), out->path());
  const ThreadLimit limit(a.jobs);  // of writing, too
  ExperimentResult result;
  if (!out)
    result = run_experiment(scenario, a.jobs, true, {Rows::To::nowhere, {}}, stop_if_asked);
  else
    out->write([&](const std::filesystem::path& into) {
      result = run_experiment(scenario, a.jobs, true, {Rows::To::folder, into}, stop_if_asked);
      complete_run_folder(result, render_report(PageKind::run, report_json(result)), into);
    });
  const std::vector<Check> checks = check(result);
  if (!a.junit.empty()) replace_text_file(a.junit, junit_xml(scenario.name, checks, {}));
  const std::string where = out ? fmt::format("Result in {}: {}\n", out->said(), page_said(out->path())) : "";
  print_answer(a.answer, experiment_table(result) + checks_text(checks) + where, summary_json(result));
  if (out) finish_page(out->path(), a.open);
  if (!all_met(checks)) throw Exit(kUnmet, "an expectation was not met");
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto a = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "Drive a scenario's squares, measure, calibrate, drive again, report");
  command->add_option("scenario", a->scenario, "Scenario: a file (YAML) or a shipped one's name; default umbmark");
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<scenario name>");
  command->add_option("--set", a->settings, "Replace a value of the scenario: --set course.side_m=2 (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--junit", a->junit, "Write what the scenario's expectations say as JUnit XML");
  command->add_flag("--force", a->force, "Replace a finished result");
  add_answer_options(command, a->answer, "summary.json");
  add_open_option(command, a->open);
  command->add_option("-j,--jobs", a->jobs, "Runs driven at the same time; 0: one per core")
      ->check(CLI::Range(0, 1024));
  add_example(command, "umbsim run umbmark --set course.side_m=2");
  command->callback([a] { run(*a); });
}

}  // namespace umbsim

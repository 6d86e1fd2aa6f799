#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/help/help.h"
#include "cli/output/colour.h"
#include "cli/output/pages.h"
#include "cli/output/tables.h"
#include "cli/shipped.h"
#include "core/text/text_file.h"
#include "experiment/explain/explain.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"

namespace umbsim {
namespace {

struct ExplainArguments {
  std::string scenario;
  std::string out;
  std::vector<std::string> settings;
  bool force = false;
  bool open = false;
  int jobs = 0;
};

void explain_scenario(const ExplainArguments& a) {
  const Scenario scenario = read_scenario(shipped_path(ShippedKind::scenario, a.scenario), a.settings);
  std::optional<ResultFolder> out;
  if (!a.out.empty()) out.emplace(a.out, "", a.force);
  print_warnings(silent_effects(scenario, load_scenario_robot(scenario)));
  const Explanation explanation = explain(scenario, a.jobs);
  if (out) {
    out->write([&](const std::filesystem::path& into) {
      const Json json = explanation_json(scenario, explanation);
      write_text_file(into / "explain.json", json.dump(2) + "\n");
      Json page = explanation_page(json, page_provenance_json(scenario.file, scenario.seed));
      page.update(explained_runs_json(scenario, explanation));
      write_page(into, PageKind::explanation, page);
      write_scenario(scenario, into / "scenario.resolved.yaml");
      write_text_file(into / "provenance.json", provenance_json(scenario.file, scenario.seed).dump(2) + "\n");
    });
  }
  print_words(explanation_table(scenario, explanation));
  if (!out) return;
  print_words(fmt::format("Result in {}: explain.json; {}\n", out->path(), page_said(out->path())));
  finish_page(out->path(), a.open);
}

}  // namespace

void add_explain_command(CLI::App& app) {
  const auto a = std::make_shared<ExplainArguments>();
  CLI::App* command =
      app.add_subcommand("explain", "Say which effect of a scenario causes how much of its return error");
  command->add_option("scenario", a->scenario, "Scenario: a file (YAML) or a shipped one's name")->required();
  command->add_option("-o,--out", a->out, "Folder for explain.json; without it only the table is shown");
  command->add_option("--set", a->settings, "Replace a value of the scenario: --set course.side_m=2 (repeatable)")
      ->allow_extra_args(false);
  command->add_flag("--force", a->force, "Replace a finished result");
  add_open_option(command, a->open);
  command->add_option("-j,--jobs", a->jobs, "Runs driven at the same time; 0: one per core")
      ->check(CLI::Range(0, 1024));
  add_example(command, "umbsim explain unidirectional_trap");
  command->callback([a] { explain_scenario(*a); });
}

}  // namespace umbsim

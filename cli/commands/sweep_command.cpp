#include <fmt/format.h>

#include <memory>
#include <set>

#include "batch/store/store_export.h"
#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/help/help.h"
#include "cli/output/colour.h"
#include "cli/output/pages.h"
#include "cli/shipped.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "experiment/output/run_folder.h"
#include "experiment/sweep/run_sweep.h"
#include "experiment/sweep/sweep_result.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct SweepArguments {
  std::string sweep;
  std::string out;
  std::string shard;
  std::string junit;
  std::vector<std::string> settings;
  std::vector<std::string> axes;
  bool force = false;
  bool open = false;
  bool retry_failed = false;
  int jobs = 0;
};

struct ExportArguments {
  std::string sweep;
  std::string format = "csv";
  std::string out;
  std::vector<std::string> columns;
  std::vector<std::string> where;
};

Sweep read(const SweepArguments& a) {
  if (a.sweep.empty()) throw InputError("sweep: a sweep file is missing, as in `umbsim sweep friction`");
  return read_sweep(shipped_path(ShippedKind::sweep, a.sweep, {"merge", "export"}), a.settings, a.axes);
}

fs::path folder_of(const SweepArguments& a, const Sweep& sweep) {
  return a.out.empty() ? fs::path("results") / sweep.name : fs::path(a.out);
}

void write_results(const Sweep& sweep, Store& store, const SweepResult& result, const fs::path& folder) {
  replace_text_file(folder / "sweep.json", sweep_json(sweep, result).dump(2) + "\n");
  replace_text_file(folder / "provenance.json", provenance_json(sweep.file, 0).dump(2) + "\n");
  if (has_pages()) write_page(folder, PageKind::sweep, sweep_report_json(sweep, store, result));
}

void print_failed(const SweepResult& result) {
  constexpr std::size_t kMost = 20;
  for (std::size_t i = 0; i < std::min(kMost, result.failed.size()); ++i) {
    const FailedPoint& f = result.failed[i];
    fmt::print("{}", wrapped(fmt::format("  point {}, {}: {}", f.number, f.label, f.error), 4));
  }
  if (result.failed.size() > kMost) fmt::print("  and {} more, see sweep.json\n", result.failed.size() - kMost);
}

// A warning of many points says the same with other numbers: the first points that have one tell what it is.
void print_warned(const SweepResult& result) {
  constexpr std::size_t kMost = 3;
  if (result.warned.empty()) return;
  std::set<std::int64_t> points;
  for (const WarnedPoint& w : result.warned) points.insert(w.number);
  fmt::print("{} points with warnings\n", points.size());
  for (std::size_t i = 0; i < std::min(kMost, result.warned.size()); ++i) {
    const WarnedPoint& w = result.warned[i];
    fmt::print("{}", wrapped(fmt::format("  point {}, {}: {}", w.number, w.label, w.warning), 4));
  }
  if (result.warned.size() > kMost)
    fmt::print("  and {} more warnings, see sweep.json\n", result.warned.size() - kMost);
}

// Table, files, checks; the exit code.
void conclude(const Sweep& sweep, const SweepArguments& a, const fs::path& folder) {
  Store store = Store::open(store_file(folder, {}));
  const SweepResult result = measure_sweep(sweep, store);
  write_results(sweep, store, result, folder);
  if (!a.junit.empty()) replace_text_file(a.junit, junit_xml(sweep.name, result.checks, result.failed));
  fmt::print("{}", wrapped(fmt::format("{}: {} of {} points driven, {} failed", sweep.name, result.done, sweep.points,
                                       result.failed.size())));
  print_failed(result);
  print_warned(result);
  print_words(
      fmt::format("{}Result in {}: {}\n", checks_text(result.checks), folder.string(), page_said(folder.string())));
  finish_page(folder.string(), a.open);
  if (result.missing > 0) {
    throw Exit(kRunFailed,
               fmt::format("{} of {} points are missing: a shard has not finished", result.missing, sweep.points));
  }
  if (!result.failed.empty() && !result.failures_are_expected) {
    throw Exit(kRunFailed, fmt::format("{} points could not be driven", result.failed.size()));
  }
  if (!all_met(result.checks)) throw Exit(kUnmet, "an expectation was not met");
}

void stopped(int signal, const fs::path& folder) {
  throw Exit(
      kSignalled + signal,
      fmt::format("stopped; the finished points are kept in {}, the same command goes on from there", folder.string()));
}

void sweep_all(const SweepArguments& a) {
  const Sweep sweep = read(a);
  const fs::path folder = folder_of(a, sweep);
  const Shard shard = a.shard.empty() ? Shard{} : parse_shard(a.shard);
  if (const int signal = run_sweep(sweep, {folder, a.jobs, shard, a.force, a.retry_failed}); signal != 0) {
    stopped(signal, folder);
  }
  if (a.shard.empty()) return conclude(sweep, a, folder);
  fmt::print("{}: shard {} is done, in {}; `umbsim sweep merge` joins the shards\n", sweep.name, a.shard,
             store_file(folder, shard).string());
}

void merge(const SweepArguments& a) {
  const Sweep sweep = read(a);
  const fs::path folder = folder_of(a, sweep);
  merge_sweep(sweep, folder);
  conclude(sweep, a, folder);
}

void export_sweep(const ExportArguments& a) {
  const fs::path given = a.sweep;
  Store store = Store::open(fs::is_directory(given) ? store_file(given, {}) : given);
  ExportChoice choice;
  choice.json = a.format == "json";
  choice.columns = a.columns;
  choice.file = a.out;
  for (const std::string& text : a.where) choice.where.push_back(parse_condition(text, "--where"));
  const std::int64_t rows = export_store(store, choice);
  if (!a.out.empty()) fmt::print("{}: {} rows in {}\n", store.layout().name, rows, a.out);
}

void add_common_options(CLI::App* command, const std::shared_ptr<SweepArguments>& a) {
  command->add_option("sweep", a->sweep, "Sweep: a file (YAML) or a shipped one's name");
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<sweep name>");
  command->add_option("--set", a->settings, "Replace a value of the scenario at every point (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--axis", a->axes, "Replace or add an axis: --axis 'course.side_m=[2, 4]' (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--junit", a->junit, "Write what the expectations say as JUnit XML");
  add_open_option(command, a->open);
  command->add_option("-j,--jobs", a->jobs, "Points driven at the same time; 0: one per core")
      ->check(CLI::Range(0, 1024));
}

void add_merge(CLI::App* sweep) {
  const auto a = std::make_shared<SweepArguments>();
  CLI::App* command = sweep->add_subcommand("merge", "Join the shards of a sweep, check and report");
  add_common_options(command, a);
  add_example(command, "umbsim sweep merge friction");
  command->callback([a] { merge(*a); });
}

void add_export(CLI::App* sweep) {
  const auto a = std::make_shared<ExportArguments>();
  CLI::App* command = sweep->add_subcommand("export", "Write the points of a sweep as CSV or JSON");
  command->add_option("sweep", a->sweep, "Folder of a sweep, or its database")->required();
  command->add_option("--format", a->format, "csv or json")
      ->check(CLI::IsMember({"csv", "json"}))
      ->capture_default_str();
  command->add_option("-o,--out", a->out, "File; default standard output");
  command->add_option("--columns", a->columns, "Columns, with commas between; default all that hold anything")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--where", a->where, "Only points that fulfil it: 'course.side_m >= 2' (repeatable)")
      ->allow_extra_args(false);
  add_example(command, "umbsim sweep export results/friction --where 'floor.friction >= 0.4'");
  command->callback([a] { export_sweep(*a); });
}

}  // namespace

void add_sweep_command(CLI::App& app) {
  const auto a = std::make_shared<SweepArguments>();
  CLI::App* command = app.add_subcommand(
      "sweep", "Drive a scenario over axes of parameters; started again, it goes on where it was stopped");
  add_common_options(command, a);
  command->add_option("--shard", a->shard,
                      "Drive only part i of n, as in 2/4; `sweep merge` joins the parts and checks");
  command->add_flag("--force", a->force, "Begin anew, whatever is there");
  command->add_flag("--retry-failed", a->retry_failed, "Drive the points again that could not be driven");
  command->require_subcommand(0, 1);
  add_merge(command);
  add_export(command);
  add_example(command, "umbsim sweep friction");
  command->callback([a, command] {
    if (command->get_subcommands().empty()) sweep_all(*a);
  });
}

}  // namespace umbsim

#include "experiment/sweep/run_sweep.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <regex>

#include "batch/batch.h"
#include "batch/progress_log.h"
#include "batch/stop.h"
#include "experiment/output/build_info.h"
#include "experiment/output/figures.h"
#include "experiment/run.h"
#include "experiment/wheel_loads.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStoreName = "sweep.sqlite";

Provenance provenance() {
  const BuildInfo info = build_info();
  return {{"program", "umbsim"},        {"version", info.version},       {"commit", info.commit},
          {"compiler", info.compiler},  {"bullet_version", info.bullet}, {"build_type", info.build_type}};
}

StoreStart this_start(const Shard& shard) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  return {fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))), host, getpid(),
          shard.whole() ? "" : fmt::format("{}/{}", shard.index + 1, shard.count)};
}

void add_runs(StoredPoint& point, const DrivenRuns& driven, const char* stage) {
  for (std::size_t i = 0; i < driven.digests.size(); ++i) {
    const RecordedRun& run = driven.recording.runs[i];
    const bool bumped = !run.bumps.empty() || run.inner_wheel_bumps;
    const ReturnError& e = driven.digests[i].error;
    point.runs.push_back({run.id, run.direction, bumped ? "bumped" : stage, e.x_m, e.y_m, e.theta_rad});
  }
}

// A point that cannot be driven is a result, too.
StoredPoint drive_point(const Sweep& sweep, std::int64_t number) {
  const SweepPoint wanted = sweep_point(sweep, number);
  StoredPoint point;
  point.number = number;
  point.replicate = wanted.replicate;
  for (const AxisValue& value : wanted.values) point.axes.push_back(value.cell);
  const Scenario scenario = scenario_of(sweep, wanted);
  point.seed = std::int64_t(scenario.seed);
  try {
    const ExperimentResult result = run_experiment(scenario, 0, false, {Rows::To::nowhere, {}});
    point.figures = figures_of(result);
    point.warnings = run_warnings(result);
    add_runs(point, result, "before");
    if (!result.passes.empty()) add_runs(point, result.passes.back(), "after");
  } catch (const RunError& e) {
    point.error = e.what();
  } catch (const InputError& e) {
    point.error = e.what();
  }
  return point;
}

bool is_sweep_folder(const fs::path& folder) { return fs::exists(folder / kStoreName) || !shard_files(folder).empty(); }

// Refuses a folder that holds anything else.
void check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: is not a folder; give another one with --out", folder.string()));
  }
  if (fs::is_empty(folder, error) || is_sweep_folder(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    // Another shard of this sweep may be about to make its store.
    if (entry.path().extension() == ".lock") return;
  }
  throw InputError(fmt::format("{}: exists and is not a sweep; give another folder with --out", folder.string()));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw RunError(fmt::format("{}: cannot write the result: {}", folder.string(), error.message()));
}

fs::path lock_file(const fs::path& store) { return store.parent_path() / ("." + store.stem().string() + ".lock"); }

void remove_store(const fs::path& store) {
  for (const char* more : {"", "-wal", "-shm", "-journal"}) fs::remove(store.string() + more);
}

// With --force: what an older sweep left; of a shard only its own.
void begin_anew(const SweepOptions& options) {
  if (!fs::exists(options.folder)) return;
  remove_store(store_file(options.folder, options.shard));
  if (!options.shard.whole()) return;
  for (const fs::path& shard : shard_files(options.folder)) remove_store(shard);
  for (const char* name : {"report.html", "sweep.json", "provenance.json"}) fs::remove(options.folder / name);
}

// Whether the scenario takes these points. Millions of them take minutes.
void check(const Sweep& sweep, const std::vector<std::int64_t>& numbers) {
  ProgressLog progress(sweep.name + ": checked", 0, std::int64_t(numbers.size()), ProgressLog::on_standard_error());
  check_points(sweep, numbers, [&] { progress.step(); });
}

std::vector<std::int64_t> all_of(const Sweep& sweep, const Shard& shard) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = shard.index; i < sweep.points; i += shard.count) numbers.push_back(i);
  return numbers;
}

std::vector<std::int64_t> first_of(const std::vector<std::int64_t>& numbers) {
  return {numbers.begin(), numbers.begin() + std::ptrdiff_t(!numbers.empty())};
}

int drive_missing(const Sweep& sweep, Store& store, const SweepOptions& options,
                  const std::vector<std::int64_t>& open) {
  const StopRequests listen;
  Claims claims(lock_file(store.file()));
  const auto total = std::int64_t(all_of(sweep, options.shard).size());
  ProgressLog progress(sweep.name, total - std::int64_t(open.size()), total, ProgressLog::on_standard_error());
  Batch batch;
  batch.cases = open;
  batch.is_done = [&](std::int64_t number) { return store.has(number); };
  batch.work = [&](std::int64_t number) -> Batch::Commit {
    return [&store, point = drive_point(sweep, number)] { store.put(point); };
  };
  batch.after = [&](std::int64_t, bool ours) { progress.step(ours); };
  return run_batch(batch, claims, options.jobs) ? 0 : StopRequests::received();
}

}  // namespace

fs::path store_file(const fs::path& folder, const Shard& shard) {
  if (shard.whole()) return folder / kStoreName;
  return folder / fmt::format("shard-{}-of-{}.sqlite", shard.index + 1, shard.count);
}

std::vector<fs::path> shard_files(const fs::path& folder) {
  static const std::regex pattern(R"(shard-\d+-of-\d+\.sqlite)");
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (std::regex_match(entry.path().filename().string(), pattern)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

StoreLayout layout_of(const Sweep& sweep) {
  StoreLayout layout{sweep.name, sweep.definition, sweep.points, {}, figure_names()};
  for (const Axis& axis : sweep.axes) layout.axes.push_back(axis.key);
  return layout;
}

int run_sweep(const Sweep& sweep, const SweepOptions& options) {
  check_folder(options.folder);
  const fs::path file = store_file(options.folder, options.shard);
  const bool anew = options.force || !fs::exists(file);
  if (anew) check(sweep, all_of(sweep, options.shard));
  if (options.force) begin_anew(options);
  make_folder(options.folder);
  // A shard's store may lie on a network file system.
  const auto journal = options.shard.whole() ? Store::Journal::wal : Store::Journal::rollback;
  Store store = Store::open_for(file, layout_of(sweep), provenance(), journal);
  if (options.retry_failed) store.forget_failed();
  const std::vector<std::int64_t> open = store.missing(options.shard);
  // This program has checked them all when it began; its robot's file may have gone since.
  if (!anew) check(sweep, store.knows_program() ? first_of(open) : open);
  store.note_start(this_start(options.shard));
  const int signal = drive_missing(sweep, store, options, open);
  if (signal == 0) store.settle();
  return signal;
}

void merge_sweep(const Sweep& sweep, const fs::path& folder) {
  const std::vector<fs::path> shards = shard_files(folder);
  if (shards.empty()) {
    throw InputError(fmt::format("{}: holds no shard-i-of-n.sqlite; `umbsim sweep FILE --shard i/n` makes one",
                                 folder.string()));
  }
  Store store = Store::open_for(store_file(folder, {}), layout_of(sweep), provenance(), Store::Journal::wal);
  for (const fs::path& shard : shards) store.take_over(shard);
  store.settle();
}

}  // namespace umbsim

#include "gap/trial/diagnose/diagnose_cases.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <boost/process.hpp>
#include <chrono>
#include <thread>

#include "core/error.h"
#include "core/progress.h"
#include "core/text/text_file.h"
#include "gap/trial/write/seal.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;
namespace bp = boost::process;

constexpr std::size_t kMaxMessageBytes = 16 * 1024 * 1024;
constexpr std::size_t kKeptMessageBytes = 2000;
constexpr const char* kKept[] = {"diagnosis.json", "twin.yaml"};

struct Finished {
  int exit_code = -1;
  double wall_s = 0;
  std::string messages;
};

// The process sees `scratch` and the cache, and no name of the case.
Finished run_process(const DiagnoseOptions& options, const fs::path& scratch, const fs::path& cache,
                     const std::vector<std::string>& excluded, int threads) {
  std::vector<std::string> words{"gap", "diagnose", "recording", "--out", "diagnosis"};
  for (const std::string& effect : excluded) words.insert(words.end(), {"--exclude", effect});
  bp::environment environment;
  environment["PATH"] = "/usr/local/bin:/usr/bin:/bin";
  environment["LC_ALL"] = "C.UTF-8";
  environment["HOME"] = scratch.string();
  environment["TMPDIR"] = scratch.string();
  environment["XDG_CACHE_HOME"] = cache.string();
  environment["UMBSIM_JOBS"] = std::to_string(threads);
  const fs::path messages = scratch / "messages";
  const auto start = std::chrono::steady_clock::now();
  Finished finished;
  try {
    bp::child child(options.program.string(), bp::args(words), environment, bp::start_dir(scratch.string()),
                    bp::std_in<bp::null, bp::std_out> bp::null, bp::std_err > messages.string());
    child.wait();
    finished.exit_code = child.exit_code();
  } catch (const bp::process_error& e) {
    throw RunError(fmt::format("{}: cannot be started: {}", options.program.string(), e.what()));
  }
  finished.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  finished.messages = read_text_file(messages, kMaxMessageBytes);
  return finished;
}

void diagnose_case(const TrialFolder& folder, const DiagnoseOptions& options, const fs::path& cache,
                   const CaseEntry& entry, const std::optional<std::string>& seal, int threads) {
  const fs::path recording = folder.recordings() / entry.name;
  if (!fs::is_directory(recording)) {
    throw InputError(fmt::format("{}: no such recording; generate the trial first", recording.string()));
  }
  const ScratchFolder scratch;
  fs::copy(recording, scratch.path() / "recording", fs::copy_options::recursive);
  normalise_times(scratch.path() / "recording");
  const Finished finished = run_process(options, scratch.path(), cache, entry.excluded, threads);
  const bool ok = finished.exit_code == 0 && fs::exists(scratch.path() / "diagnosis" / "diagnosis.json");
  Json json{{"format", "umbsim-trial-process/1"},
            {"exit_code", finished.exit_code},
            {"wall_s", finished.wall_s},
            {"failed", !ok},
            {"answers_sha256", seal ? Json(*seal) : Json()}};
  if (!ok) {
    const std::string& m = finished.messages;
    json["messages"] = m.substr(m.size() - std::min(m.size(), kKeptMessageBytes));
  }
  write_whole(folder.diagnoses() / entry.name, [&](const fs::path& into) {
    for (const char* name : kKept) {
      const fs::path from = scratch.path() / "diagnosis" / name;
      if (ok && fs::exists(from)) fs::copy_file(from, into / name);
    }
    write_text_file(into / "process.json", json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  });
}

bool failed(const fs::path& diagnosis) { return read_json(diagnosis / "process.json").value("failed", true); }

}  // namespace

DiagnoseResult diagnose_cases(const TrialFolder& folder, const DiagnoseOptions& options) {
  const std::vector<CaseEntry> entries = read_case_entries(folder);
  const std::optional<std::string> seal = read_seal(folder);
  const fs::path cache = fs::absolute(options.cache.empty() ? folder.root / "cache" : options.cache);
  fs::create_directories(cache);
  std::vector<const CaseEntry*> open;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const fs::path place = folder.diagnoses() / entries[i].name;
    if (!options.shard.has(std::int64_t(i))) continue;
    if (options.retry && fs::exists(place) && failed(place)) fs::remove_all(place);
    if (!fs::exists(place)) open.push_back(&entries[i]);
  }
  Progress progress("diagnosing", int(open.size()));
  // Threads that wait for processes. Together these take no more cores than there are jobs.
  const int jobs = options.jobs > 0 ? options.jobs : int(std::max(1u, std::thread::hardware_concurrency()));
  const int threads = jobs / std::clamp(int(open.size()), 1, jobs);
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  tbb::task_arena arena(jobs);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, open.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            diagnose_case(folder, options, cache, *open[i], seal, threads);
            progress.step();
          }
        },
        tbb::simple_partitioner());
  });
  DiagnoseResult result;
  result.cases = entries.size();
  for (const CaseEntry& entry : entries) {
    const fs::path place = folder.diagnoses() / entry.name;
    if (!fs::exists(place)) continue;
    ++result.finished;
    result.failed += std::size_t(failed(place));
  }
  return result;
}

}  // namespace umbsim

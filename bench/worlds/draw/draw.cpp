#include "bench/worlds/draw/draw.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>

#include "core/error.h"
#include "core/first_failure.h"
#include "core/progress.h"
#include "core/text/text_file.h"
#include "gap/trial/write/even_tables.h"
#include "gap/trial/write/seal.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTextBytes = 16 * 1024 * 1024;

fs::path part_of(const TrialFolder& folder, const CaseEntry& c) { return folder.answer_parts() / (c.name + ".json"); }

void begin(const DrawSource& source, const TrialFolder& folder) {
  const fs::path file = folder.root / "worlds.yaml";
  if (fs::exists(file)) {
    if (read_text_file(file, kMaxTextBytes) != source.worlds_yaml)
      throw InputError(fmt::format("{}: holds other worlds; give another folder with --out", folder.root.string()));
  } else if (fs::exists(folder.root) && !fs::is_empty(folder.root)) {
    throw InputError(
        fmt::format("{}: exists and holds no worlds; give another folder with --out", folder.root.string()));
  }
  write_file_whole(file, source.worlds_yaml);
  write_file_whole(folder.cases(), case_entries_text(source.name, source.cases));
  fs::create_directories(folder.recordings());
}

// The answer first: a recording that stands has one.
void write_case(const TrialFolder& folder, const CaseEntry& c, const DrawnCase& drawn) {
  write_file_whole(part_of(folder, c), drawn.answer.dump());
  write_whole(folder.recordings() / c.name, [&](const fs::path& into) {
    write_recording(drawn.recording, into);
    write_even_tables(drawn.recording, into);
    write_text_file(into / "robot.urdf", drawn.world.robot.urdf);
    normalise_times(into);
  });
}

std::optional<std::string> seal_if_complete(const DrawSource& source, const TrialFolder& folder) {
  if (fs::exists(folder.seal())) return read_seal(folder);
  Json json{
      {"format", "umbsim-trial-answers/1"}, {"trial", source.name}, {"seed", source.seed}, {"cases", Json::object()}};
  for (const CaseEntry& c : source.cases) {
    if (!fs::exists(folder.recordings() / c.name) || !fs::exists(part_of(folder, c))) return read_seal(folder);
    json["cases"][c.name] = read_json(part_of(folder, c));
  }
  const std::string seal = seal_answers(folder, json.dump(1) + "\n");
  std::error_code ignored;
  fs::remove_all(folder.answer_parts(), ignored);
  return seal;
}

}  // namespace

DrawResult draw_all(const DrawSource& source, const TrialFolder& folder, Shard shard, int jobs) {
  std::optional<tbb::global_control> limit;
  if (jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  const auto start = std::chrono::steady_clock::now();
  const std::vector<CaseEntry>& cases = source.cases;
  begin(source, folder);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (shard.has(std::int64_t(i)) && !fs::exists(folder.recordings() / cases[i].name)) open.push_back(i);
  }
  Progress progress("drawing worlds", int(open.size()));
  std::atomic<int> worlds{0}, faults{0};
  FirstFailure failure;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, open.size(), 1),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          failure.attempt(i, [&] {
            const DrawnCase drawn = source.draw(open[i]);
            write_case(folder, cases[open[i]], drawn);
            worlds += drawn.worlds_redrawn;
            faults += drawn.faults_redrawn;
            progress.step();
          });
        }
      },
      tbb::simple_partitioner());
  failure.rethrow();
  DrawResult result;
  result.root = folder.root;
  result.cases = cases.size();
  for (const CaseEntry& c : cases) result.finished += std::size_t(fs::exists(folder.recordings() / c.name));
  result.seal = seal_if_complete(source, folder);
  result.worlds_redrawn = worlds;
  result.faults_redrawn = faults;
  result.drawn_now = open.size();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

DrawResult draw_worlds(const WorldsPlan& plan, const TrialFolder& folder, Shard shard, int jobs) {
  const std::vector<WorldCase> cases = world_cases(plan);
  DrawSource source{plan.name, plan.seed, resolved_worlds(plan), {}, {}};
  for (const WorldCase& c : cases) source.cases.push_back({c.name, c.excluded});
  source.draw = [&](std::size_t index) { return draw_case(plan, cases[index]); };
  return draw_all(source, folder, shard, jobs);
}

}  // namespace umbsim::worlds

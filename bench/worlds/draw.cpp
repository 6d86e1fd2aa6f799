#include "bench/worlds/draw.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>

#include "core/error.h"
#include "core/progress.h"
#include "core/text_file.h"
#include "gap/trial/even_tables.h"
#include "gap/trial/seal.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTextBytes = 16 * 1024 * 1024;

fs::path part_of(const TrialFolder& folder, const WorldCase& c) { return folder.answer_parts() / (c.name + ".json"); }

void begin(const WorldsPlan& plan, const TrialFolder& folder, const std::vector<WorldCase>& cases) {
  const fs::path file = folder.root / "worlds.yaml";
  const std::string text = resolved_worlds(plan);
  if (fs::exists(file)) {
    if (read_text_file(file, kMaxTextBytes) != text)
      throw InputError(fmt::format("{}: holds other worlds; give another folder with --out", folder.root.string()));
  } else if (fs::exists(folder.root) && !fs::is_empty(folder.root)) {
    throw InputError(
        fmt::format("{}: exists and holds no worlds; give another folder with --out", folder.root.string()));
  }
  write_file_whole(file, text);
  std::vector<CaseEntry> entries;
  for (const WorldCase& c : cases) entries.push_back({c.name, c.excluded});
  write_file_whole(folder.cases(), case_entries_text(plan.name, entries));
  fs::create_directories(folder.recordings());
}

// The answer first: a recording that stands has one.
void write_case(const TrialFolder& folder, const WorldCase& c, const DrawnCase& drawn) {
  write_file_whole(part_of(folder, c), drawn.answer.dump());
  write_whole(folder.recordings() / c.name, [&](const fs::path& into) {
    write_recording(drawn.recording, into);
    write_even_tables(drawn.recording, into);
    write_text_file(into / "robot.urdf", drawn.world.robot.urdf);
    normalise_times(into);
  });
}

std::optional<std::string> seal_if_complete(const WorldsPlan& plan, const TrialFolder& folder,
                                            const std::vector<WorldCase>& cases) {
  if (fs::exists(folder.seal())) return read_seal(folder);
  Json json{{"format", "umbsim-trial-answers/1"}, {"trial", plan.name}, {"seed", plan.seed}, {"cases", Json::object()}};
  for (const WorldCase& c : cases) {
    if (!fs::exists(folder.recordings() / c.name) || !fs::exists(part_of(folder, c))) return read_seal(folder);
    json["cases"][c.name] = read_json(part_of(folder, c));
  }
  const std::string seal = seal_answers(folder, json.dump(1) + "\n");
  std::error_code ignored;
  fs::remove_all(folder.answer_parts(), ignored);
  return seal;
}

}  // namespace

DrawResult draw_worlds(const WorldsPlan& plan, const TrialFolder& folder, Shard shard, int jobs) {
  std::optional<tbb::global_control> limit;
  if (jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  const auto start = std::chrono::steady_clock::now();
  const std::vector<WorldCase> cases = world_cases(plan);
  begin(plan, folder, cases);
  std::vector<const WorldCase*> open;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (shard.has(std::int64_t(i)) && !fs::exists(folder.recordings() / cases[i].name)) open.push_back(&cases[i]);
  }
  Progress progress("drawing worlds", int(open.size()));
  std::atomic<int> worlds{0}, faults{0};
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, open.size(), 1),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const DrawnCase drawn = draw_case(plan, *open[i]);
          write_case(folder, *open[i], drawn);
          worlds += drawn.worlds_redrawn;
          faults += drawn.faults_redrawn;
          progress.step();
        }
      },
      tbb::simple_partitioner());
  DrawResult result;
  result.cases = cases.size();
  for (const WorldCase& c : cases) result.finished += std::size_t(fs::exists(folder.recordings() / c.name));
  result.seal = seal_if_complete(plan, folder, cases);
  result.worlds_redrawn = worlds;
  result.faults_redrawn = faults;
  result.drawn_now = open.size();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace umbsim::worlds

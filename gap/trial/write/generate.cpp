#include "gap/trial/write/generate.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <stdexcept>

#include "core/error.h"
#include "core/first_failure.h"
#include "core/progress.h"
#include "core/text/text_file.h"
#include "gap/trial/write/even_tables.h"
#include "gap/trial/write/seal.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTextBytes = 256 * 1024 * 1024;
constexpr int kAttempts = 5;  // at drawing effects with which the robot can be driven

// The header of a case's recording.
Recording planned_for(const TrialPlan& plan, const TrialCase& c, const Platform& platform) {
  Recording planned = planned_recording(plan, platform, runs_of(plan, c.tier));
  planned.truth_position_sd_m *= c.noise_level;
  planned.truth_heading_sd_rad *= c.noise_level;
  if (c.tier == Tier::end_points) planned.truth_kind = "endpoints";
  return planned;
}

// Severity scales are costly, and shared by the cases of a platform with the same runs and poses.
class Scales {
 public:
  using Key = std::pair<int, Tier>;
  Scales(const TrialPlan& plan, const TrialSimulator& simulator) : plan_(plan), simulator_(simulator) {}

  void prepare(const std::vector<const TrialCase*>& cases) {
    for (const TrialCase* c : cases) {
      if (!c->effects.empty()) scales_[key(*c)];
    }
    std::vector<Key> keys;
    for (const auto& [k, scale] : scales_) keys.push_back(k);
    FirstFailure failure;
    tbb::parallel_for(std::size_t(0), keys.size(), [&](std::size_t i) {
      failure.attempt(i, [&] {
        TrialCase standard;
        standard.tier = keys[i].second;
        const Platform platform = draw_platform(plan_, keys[i].first);
        scales_.at(keys[i]) =
            std::make_unique<SeverityScale>(plan_, platform, planned_for(plan_, standard, platform), simulator_);
      });
    });
    failure.rethrow();
  }
  const SeverityScale& of(const TrialCase& c) const { return *scales_.at(key(c)); }

 private:
  static Key key(const TrialCase& c) {
    const bool special = c.tier == Tier::end_points || c.tier == Tier::poor_runs;
    return {c.platform, special ? c.tier : Tier::single};
  }

  const TrialPlan& plan_;
  const TrialSimulator& simulator_;
  std::map<Key, std::unique_ptr<SeverityScale>> scales_;
};

struct DrivenCase {
  Recording recording;
  std::vector<ScaledEffect> effects;
};

DrivenCase drive_case(const TrialPlan& plan, const TrialCase& c, const Platform& platform, const Scales& scales,
                      const TrialSimulator& simulator, int attempt) {
  RandomStream random(plan.seed, fmt::format("trial shape {}", attempt), c.index);
  DrivenCase driven;
  TrialDrive drive{platform.robot, planned_for(plan, c, platform), {}, 0, 0, 0, c.seed};
  drive.heading_walk_rad_per_sqrt_m = plan.noise.heading_walk_rad_per_sqrt_m * c.noise_level;
  drive.radius_scatter = plan.noise.radius_scatter * c.noise_level;
  drive.motor_scatter = plan.noise.motor_scatter * c.noise_level;
  for (std::size_t i = 0; i < c.effects.size(); ++i) {
    const DrawnEffect drawn = draw_effect(*c.effects[i], platform, runs_of(plan, c.tier), random);
    driven.effects.push_back(scale_effect(drawn, c.severities[i], plan.severity, c.noise_level, scales.of(c), random));
    drive.effects.push_back(driven.effects.back().effect);
  }
  driven.recording = simulator(drive);
  return driven;
}

DrivenCase drive_case(const TrialPlan& plan, const TrialCase& c, const Platform& platform, const Scales& scales,
                      const TrialSimulator& simulator) {
  for (int attempt = 0;; ++attempt) {
    try {
      return drive_case(plan, c, platform, scales, simulator, attempt);
    } catch (const std::runtime_error&) {  // RunError, or InputError: a robot that tips over
      if (attempt + 1 == kAttempts) throw;
    }
  }
}

void write_case(const TrialFolder& folder, const TrialCase& c, const DrivenCase& driven) {
  // The answer first: a recording that stands has one.
  write_file_whole(folder.answer_parts() / (c.name + ".json"), answer_json(c, driven.effects).dump());
  write_whole(folder.recordings() / c.name, [&](const fs::path& into) {
    write_recording(driven.recording, into);
    write_even_tables(driven.recording, into);
    normalise_times(into);
  });
}

// All answers in one file, once every case stands. Shards may try at the same time: the text is the same.
std::optional<std::string> seal_if_complete(const TrialPlan& plan, const TrialFolder& folder,
                                            const std::vector<TrialCase>& cases) {
  if (!fs::exists(folder.seal())) {
    Json json{
        {"format", "umbsim-trial-answers/1"}, {"trial", plan.name}, {"seed", plan.seed}, {"cases", Json::object()}};
    for (const TrialCase& c : cases) {
      const fs::path part = folder.answer_parts() / (c.name + ".json");
      if (!fs::exists(folder.recordings() / c.name) || !fs::exists(part)) return read_seal(folder);
      json["cases"][c.name] = read_json(part);
    }
    seal_answers(folder, json.dump(1) + "\n");
  }
  std::error_code ignored;
  fs::remove_all(folder.answer_parts(), ignored);
  return read_seal(folder);
}

bool holds_nothing(const fs::path& folder) {
  if (!fs::exists(folder)) return true;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().front() != '.') return false;  // hidden: another shard is just beginning
  }
  return true;
}

void begin(const TrialPlan& plan, const TrialFolder& folder, const std::vector<TrialCase>& cases) {
  const std::string text = resolved_trial(plan);
  if (fs::exists(folder.plan())) {
    if (read_text_file(folder.plan(), kMaxTextBytes) != text) {
      throw InputError(fmt::format("{}: holds another trial; give another folder with --out", folder.root.string()));
    }
  } else if (!holds_nothing(folder.root)) {
    throw InputError(
        fmt::format("{}: exists and is not a trial; give another folder with --out", folder.root.string()));
  }
  write_file_whole(folder.plan(), text);
  std::vector<CaseEntry> entries;
  for (const TrialCase& c : cases) entries.push_back({c.name, c.excluded});
  write_file_whole(folder.cases(), case_entries_text(plan.name, entries));
  fs::create_directories(folder.recordings());
}

}  // namespace

GenerateResult generate_trial(const TrialPlan& plan, const TrialFolder& folder, const TrialSimulator& simulator,
                              Shard shard, int jobs) {
  std::optional<tbb::global_control> limit;
  if (jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  const std::vector<TrialCase> cases = draw_cases(plan);
  begin(plan, folder, cases);
  std::vector<const TrialCase*> open;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (shard.has(std::int64_t(i)) && !fs::exists(folder.recordings() / cases[i].name)) open.push_back(&cases[i]);
  }
  Scales scales(plan, simulator);
  scales.prepare(open);
  Progress progress("driving cases", int(open.size()));
  FirstFailure failure;
  tbb::parallel_for(std::size_t(0), open.size(), [&](std::size_t i) {
    failure.attempt(i, [&] {
      const Platform platform = draw_platform(plan, open[i]->platform);
      write_case(folder, *open[i], drive_case(plan, *open[i], platform, scales, simulator));
      progress.step();
    });
  });
  failure.rethrow();
  GenerateResult result;
  result.cases = cases.size();
  for (const TrialCase& c : cases) result.finished += std::size_t(fs::exists(folder.recordings() / c.name));
  result.seal = seal_if_complete(plan, folder, cases);
  return result;
}

}  // namespace umbsim

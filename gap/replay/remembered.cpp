#include "gap/replay/remembered.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/recent.h"
#include "gap/traits/traits.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kMostKept = 1500;         // runs
constexpr std::size_t kPosesKept = 10'000'000;  // 240 MB: a search for a place is there for the next one

constexpr double kBeside_m = 0.5;  // from the tracked point to whatever of the robot meets the floor, and a little more

double number(const Effect& effect, const char* name) {
  const auto& parameters = effect.info->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == name) return effect.values.numbers[i];
  }
  return 0;
}

// Whether a run can feel an effect. Cables reach across the floor, so only discs are looked at.
bool felt(const RecordedRun& run, double wheelbase_m, bool tracked, const Effect& effect) {
  if (effect.info->one_run && !effect.values.run.empty()) return effect.values.run == run.id;
  if (!tracked || !is(effect.info->name, kDisc)) return true;
  const double reach_m = number(effect, "radius_m") + number(effect, "length_m") + wheelbase_m + kBeside_m;
  for (const TruthSample& s : run.truth) {
    if (std::hypot(s.X_WB.x_m - number(effect, "x_m"), s.X_WB.y_m - number(effect, "y_m")) < reach_m) return true;
  }
  return false;
}

template <class Call, class Felt>
auto with_memory(const Call& call, const Felt& felt_in, std::size_t most_kept) {
  using Result = typename Call::result_type;
  const auto memory = std::make_shared<Recent<Result>>(most_kept);
  return [call, felt_in, memory](std::size_t run, const std::vector<Effect>& all, auto... roughness) {
    std::vector<Effect> effects;
    for (const Effect& e : all) {
      if (felt_in(run, e)) effects.push_back(e);
    }
    std::string key = std::to_string(run) + '\n' + bytes_of(effects);
    (key.append(reinterpret_cast<const char*>(&roughness), sizeof roughness), ...);
    return memory->get(key, [&] { return call(run, effects, roughness...); });
  };
}

}  // namespace

Simulator remembered(Simulator simulator, const Recording& recording) {
  const auto felt_in = [&recording](std::size_t run, const Effect& effect) {
    return felt(recording.runs[run], recording.robot.wheelbase_m, recording.truth_kind == "track", effect);
  };
  std::size_t poses = 1;
  for (const RecordedRun& run : recording.runs) poses += run.truth.size();
  const std::size_t tracks = std::max(kMostKept, kPosesKept * recording.runs.size() / poses);
  simulator.ticks = with_memory(simulator.ticks, felt_in, tracks);
  if (simulator.commands) simulator.commands = with_memory(simulator.commands, felt_in, kMostKept);
  return simulator;
}

}  // namespace umbsim::gap

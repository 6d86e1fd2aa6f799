#include "gap/replay/remembered.h"

#include <cmath>
#include <memory>
#include <string>

#include "core/recent.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kMostKept = 1500;  // runs: some 100 MB of tracks and counts

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
  const std::string& name = effect.info->name;
  if (!tracked || (name != "slippery_patch" && name != "wheel_lift")) return true;
  const double reach_m = number(effect, "radius_m") + number(effect, "length_m") + wheelbase_m + kBeside_m;
  for (const TruthSample& s : run.truth) {
    if (std::hypot(s.X_WB.x_m - number(effect, "x_m"), s.X_WB.y_m - number(effect, "y_m")) < reach_m) return true;
  }
  return false;
}

template <class Call, class Felt>
auto with_memory(const Call& call, const Felt& felt_in) {
  using Result = typename Call::result_type;
  const auto memory = std::make_shared<Recent<Result>>(kMostKept);
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
  simulator.ticks = with_memory(simulator.ticks, felt_in);
  if (simulator.commands) simulator.commands = with_memory(simulator.commands, felt_in);
  return simulator;
}

}  // namespace umbsim::gap

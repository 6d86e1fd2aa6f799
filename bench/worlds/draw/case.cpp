#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/worlds/draw/answer.h"
#include "bench/worlds/draw/draw.h"
#include "bench/worlds/run/fault.h"
#include "core/error.h"

namespace umbsim::worlds {
namespace {

constexpr int kAttempts = 40;      // at a world whose nominal robot drives its runs
constexpr int kFaultAttempts = 6;  // at faults with which it still drives

struct ReadyWorld {
  World world;
  std::unique_ptr<World> guide;
  std::unique_ptr<WorldScale> scale;        // in the world's own engine
  std::unique_ptr<WorldScale> guide_scale;  // in the guide
};

// Throws RunError, InputError where the nominal robot cannot be driven.
void make_ready(ReadyWorld& ready, bool faults, std::uint64_t seed) {
  ready.guide = std::make_unique<World>(guide_of(ready.world));
  ready.scale = std::make_unique<WorldScale>(ready.world, *ready.guide, seed);
  if (!drives(ready.world, ready.scale->nominal())) throw RunError("the nominal robot does not drive its runs");
  if (faults) ready.guide_scale = std::make_unique<WorldScale>(*ready.guide, *ready.guide, seed);
}

double draw_severity(const WorldsPlan& plan, RandomStream& random) {
  return plan.severity.min * std::pow(plan.severity.max / plan.severity.min, random.uniform());
}

std::vector<ScaledFault> draw_faults(const WorldsPlan& plan, const WorldCase& c, const ReadyWorld& ready, int attempt) {
  RandomStream random(plan.seed, fmt::format("worlds faults {}", attempt), c.index);
  std::vector<ScaledFault> faults;
  for (const std::string& fault : fault_names(plan, c)) {
    const DrawnFault drawn = draw_fault(fault, ready.world, random);
    const double wanted = draw_severity(plan, random);
    ScaledFault scaled = scale_fault(drawn, wanted, *ready.guide_scale);
    scaled.seen = ready.scale->severity(scaled.faults);
    if (!std::isfinite(scaled.seen.severity)) throw RunError("the robot cannot be driven with " + fault);
    faults.push_back(scaled);
  }
  return faults;
}

std::uint64_t drive_seed(const WorldsPlan& plan, const WorldCase& c) {
  return RandomStream(plan.seed, "worlds drives", c.index).bits() >> 1;
}

void drive_case(const WorldsPlan& plan, const WorldCase& c, const ReadyWorld& ready, DrawnCase& drawn) {
  const std::uint64_t seed = drive_seed(plan, c);
  for (int attempt = 0;; ++attempt) {
    try {
      const std::vector<ScaledFault> faults = draw_faults(plan, c, ready, attempt);
      const DrivenWorld driven = drive_world(ready.world, {all_of(faults), ready.world.noise, seed, 1});
      drawn.recording = record(ready.world, driven, seed);
      drawn.answer = answer_of(ready.world, *ready.scale, c.kind, c.excluded, faults);
      drawn.answer["world"]["steps"] = driven.steps;
      return;
    } catch (const std::runtime_error&) {  // it tips over, or is driven out of all bounds
      if (attempt + 1 == kFaultAttempts) throw;
      ++drawn.faults_redrawn;
    }
  }
}

}  // namespace

DrawnCase draw_case(const WorldsPlan& plan, const WorldCase& c) {
  DrawnCase drawn;
  std::string why;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    RandomStream random(plan.seed, fmt::format("worlds world {}", attempt), c.index);
    ReadyWorld ready;
    ready.world = draw_world(find_engine(c.engine), plan.choices, random);
    try {
      make_ready(ready, c.kind != CaseKind::none, drive_seed(plan, c));
      drive_case(plan, c, ready, drawn);
      drawn.world = ready.world;
      drawn.answer["world"]["worlds_redrawn"] = drawn.worlds_redrawn;
      drawn.answer["world"]["faults_redrawn"] = drawn.faults_redrawn;
      return drawn;
    } catch (const std::runtime_error& e) {
      why = e.what();
      ++drawn.worlds_redrawn;
    }
  }
  throw RunError(fmt::format("case {} ({}): {} worlds were drawn and none can be driven; the last: {}", c.name,
                             c.engine, kAttempts, why));
}

}  // namespace umbsim::worlds

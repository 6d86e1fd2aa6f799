#include "bench/worlds/run/compare.h"

#include <cmath>
#include <stdexcept>

namespace umbsim::worlds {
namespace {

constexpr double kCreep = 0.005;  // what slopes, drag, toe and casters act through
constexpr double kTicks = 20000;
constexpr std::uint64_t kRunsSeed = 7;

// Scaled by the signal's noise; all moments of all runs.
double product(const SignalTrack& a, const SignalTrack& b, const SignalSize& noise) {
  double sum = 0;
  for (std::size_t run = 0; run < a.size(); ++run) {
    for (std::size_t k = 0; k < a[run].size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (noise.whole[i] > 0) sum += a[run][k][i] * b[run][k][i] / (noise.whole[i] * noise.whole[i]);
      }
    }
  }
  return sum;
}

}  // namespace

World plain_world(const std::string& engine) {
  World w;
  w.engine = &find_engine(engine);
  w.options = middle_options(*w.engine);
  w.robot = make_robot("plain", robot_urdf({}), kTicks);
  w.physics.creep_along = w.physics.creep_across = kCreep;
  w.driver.kind = "own";
  w.tracker.kind = "mocap";
  RandomStream random(kRunsSeed, "plain world");
  w.tracker = draw_tracker("mocap", random);
  w.runs = plan_runs("plain_2", w.robot, w.driver.rate_hz, random);
  return w;
}

ComparedEffect compare(const std::string& effect, double wanted, std::uint64_t seed) {
  const World own = plain_world("ours");
  const WorldScale guide(own, own, seed);
  RandomStream random(seed, "compare " + effect);
  const ScaledFault fault = scale_fault(draw_fault(effect, own, random), wanted, guide);
  ComparedEffect result{effect, fault.seen.signal, fault.seen.severity, fault_json(fault, {}), {}};
  const SignalSize& noise = guide.noise(result.signal);
  const SignalTrack here = guide.change(fault.faults, result.signal);
  const double size = product(here, here, noise);
  for (const EngineKind& kind : engines()) {
    if (kind.name == own.engine->name || kind.expresses.count(effect) == 0) continue;
    Compared c;
    c.engine = kind.name;
    try {
      const World world = plain_world(kind.name);
      const SignalTrack there = WorldScale(world, own, seed).change(fault.faults, result.signal);
      c.ratio = product(here, there, noise) / size;
      c.alike = product(here, there, noise) / std::sqrt(size * product(there, there, noise));
    } catch (const std::runtime_error& e) {  // RunError, InputError
      c.error = e.what();
    }
    result.engines.push_back(c);
  }
  return result;
}

}  // namespace umbsim::worlds

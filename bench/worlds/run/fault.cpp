#include "bench/worlds/run/fault.h"

#include <algorithm>
#include <cmath>

namespace umbsim::worlds {
namespace {

constexpr int kMostDrives = 4;  // of the guide, for one fault
constexpr double kNear = 0.15;  // the answers hold the severity that it has

double parameter_of(const Effect& effect, const char* name) {
  const auto& all = effect.info->parameters;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == name) return effect.values.numbers[i];
  }
  return 0;
}

void set(Effect& effect, const char* name, double value) {
  const auto& all = effect.info->parameters;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == name) effect.values.numbers[i] = value;
  }
}

bool has(const Effect& effect, const char* name) {
  const auto& all = effect.info->parameters;
  return std::any_of(all.begin(), all.end(), [&](const EffectParameter& p) { return p.name == name; });
}

std::size_t pick(RandomStream& random, std::size_t count) {
  return std::min(count - 1, std::size_t(random.uniform() * double(count)));
}

// Somewhere on the way of some run, in the floor frame: the middle of the axle.
Pose2 somewhere(const World& w, RandomStream& random) {
  const std::size_t number = pick(random, w.runs.ways.size());
  const Way& way = w.runs.ways[number];
  const std::vector<Segment> segments = Plan(way.limits, way.segments).segments();
  double whole_m = 0;
  for (const Segment& s : segments) whole_m += s.length_m;
  double at_m = random.uniform(0.1, 0.9) * whole_m;
  const Pose2 X_WS{0, 0, w.runs.recording.runs[number].start_heading_rad.value_or(0)};
  for (const Segment& s : segments) {
    if (at_m < s.length_m) {
      const double part = at_m / s.length_m;
      return X_WS * s.X_SB_start * arc(part * s.length_m, part * s.angle_rad);
    }
    at_m -= s.length_m;
  }
  return X_WS;
}

Platform platform_of(const World& w) {
  Platform p;
  p.robot.wheelbase_m = w.robot.model.wheelbase_m();
  p.robot.wheel_radius_m = w.robot.model.wheels[0].radius_m;
  p.ticks_per_revolution = w.robot.ticks_per_revolution;
  p.side_m = w.runs.recording.path.side_m;
  p.linear_speed_mps = *w.runs.recording.path.linear_speed_mps;
  return p;
}

std::vector<PlannedRun> runs_of(const World& w) {
  std::vector<PlannedRun> runs;
  for (const RecordedRun& r : w.runs.recording.runs) {
    PlannedRun run;
    run.id = r.id;
    run.direction = r.direction;
    if (r.linear_speed_mps) run.speed_factor = *r.linear_speed_mps / *w.runs.recording.path.linear_speed_mps;
    runs.push_back(run);
  }
  return runs;
}

// What draw_effect lays on a plain square, laid on the way that this world's robot takes.
void move_to_way(const World& w, Effect& effect, RandomStream& random) {
  const Pose2 X_WB = somewhere(w, random);
  const double side = random.uniform() < 0.5 ? -0.5 : 0.5;
  if (has(effect, "leg")) {
    const int legs = w.runs.ways.front().segments.back().leg;
    set(effect, "leg", double(1 + (int(parameter_of(effect, "leg")) - 1) % legs));
  }
  if (!has(effect, "x_m") || w.runs.recording.path.shape == "square") return;
  const Pose2 at = X_WB * Pose2{0, side * w.robot.model.wheelbase_m(), 0};
  set(effect, "x_m", at.x_m);
  set(effect, "y_m", at.y_m);
  if (has(effect, "direction_rad")) set(effect, "direction_rad", wrap_angle(X_WB.theta_rad + M_PI / 2));
}

OutsideEffect draw_outside(const OutsideInfo& info, const World& w, RandomStream& random) {
  const Pose2 X_WB = somewhere(w, random);
  OutsideEffect e{&info, {}};
  e.values["wheel"] = double(pick(random, 2));
  e.values["sign"] = random.uniform() < 0.5 ? -1 : 1;
  e.values["direction_rad"] = random.uniform(-M_PI, M_PI);
  e.values["phase_rad"] = random.uniform(-M_PI, M_PI);
  e.values["hertz"] = random.uniform(0.3, 2);
  const double size = random.uniform(0.15, 0.3);
  if (info.place) {
    e.values["x_m"] = X_WB.x_m;
    e.values["y_m"] = X_WB.y_m;
    e.values["radius_m"] = size * w.runs.recording.path.side_m;
  }
  return e;
}

// A reading is the newest one that is old enough: late by whole control periods.
Effect as_it_acts(Effect effect, double period_s) {
  constexpr double kRoundOff = 1e-6;
  if (has(effect, "seconds"))
    set(effect, "seconds", period_s * std::ceil(parameter_of(effect, "seconds") / period_s - kRoundOff));
  return effect;
}

}  // namespace

Faults DrawnFault::at(double amplitude) const {
  if (of_catalogue) return {{as_it_acts(effect.at(amplitude), period_s)}, {}};
  OutsideEffect e = outside;
  e.values[e.info->parameter] = amplitude;
  return {{}, {e}};
}

DrawnFault draw_fault(const std::string& name, const World& world, RandomStream& random) {
  DrawnFault d;
  d.name = name;
  d.period_s = 1 / world.driver.rate_hz;
  for (const OutsideInfo& info : outside_effects()) {
    if (info.name != name) continue;
    d.of_catalogue = false;
    d.outside = draw_outside(info, world, random);
    d.range = info.plausible;
    return d;
  }
  d.effect = draw_effect(find_effect(name), platform_of(world), runs_of(world), random);
  move_to_way(world, d.effect.effect, random);
  d.range = d.effect.range;
  if (name == "contact_patch") d.range.max = std::min(d.range.max, world.robot.model.wheels[0].width_m);
  d.range.min = std::min(d.range.min, d.range.max / 2);
  return d;
}

// Secant on the logarithms, from the middle of the range.
ScaledFault scale_fault(const DrawnFault& drawn, double wanted, const WorldScale& guide) {
  const double low = std::log(drawn.range.min), high = std::log(drawn.range.max);
  double at = (low + 3 * high) / 4, last_at = 0, last_miss = 0;
  ScaledFault best{drawn.name, {}, wanted, {}};
  double best_miss = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostDrives; ++k) {
    const Faults faults = drawn.at(std::exp(at));
    const WorldScale::Seen seen = guide.severity(faults);
    const double miss = std::log(std::clamp(seen.severity, 1e-6, 1e6) / wanted);
    if (std::abs(miss) < best_miss) {
      best_miss = std::abs(miss);
      best.faults = faults;
      best.seen = seen;
    }
    if (best_miss < kNear || (at == high && miss < 0) || (at == low && miss > 0)) break;
    double slope = k == 0 ? 1 : (miss - last_miss) / (at - last_at);
    if (!(slope > 0.25)) slope = 0.25;
    last_at = at;
    last_miss = miss;
    at = std::clamp(at - miss / std::min(slope, 4.0), low, high);
    if (at == last_at) break;
  }
  return best;
}

Faults all_of(const std::vector<ScaledFault>& faults) {
  Faults all;
  for (const ScaledFault& f : faults) {
    all.effects.insert(all.effects.end(), f.faults.effects.begin(), f.faults.effects.end());
    all.outside.insert(all.outside.end(), f.faults.outside.begin(), f.faults.outside.end());
  }
  return all;
}

Json fault_json(const ScaledFault& fault, const Pose2& X_TW) {
  Json json = Json::object();
  if (!fault.faults.effects.empty())
    json = effect_json(fault.faults.effects.front());
  else
    for (const auto& [key, value] : fault.faults.outside.front().values) json[key] = value;
  const auto number = [&](const char* key) { return json.contains(key) ? json[key].get<double>() : 0.0; };
  if (json.contains("x_m") || json.contains("y_m")) {
    const Pose2 at = X_TW * Pose2{number("x_m"), number("y_m"), 0};
    json["x_m"] = at.x_m;
    json["y_m"] = at.y_m;
  }
  if (fault.name == "push") return json;  // its direction is the robot's own
  for (const char* key : {"direction_rad", "downhill_rad"}) {
    if (json.contains(key)) json[key] = wrap_angle(number(key) + X_TW.theta_rad);
  }
  return json;
}

}  // namespace umbsim::worlds

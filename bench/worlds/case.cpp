#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/worlds/draw.h"
#include "bench/worlds/fault.h"
#include "core/error.h"

namespace umbsim::worlds {
namespace {

constexpr int kAttempts = 40;      // at a world whose nominal robot drives its runs
constexpr int kFaultAttempts = 6;  // at faults with which it still drives
constexpr double kFarOff = 0.25;   // of the way: a nominal robot that is so far from its counts does not roll
constexpr double kFarTurned_rad = 0.7;

Json options_json(const EngineOptions& o) {
  Json json = Json::object();
  for (const auto& [key, value] : o.numbers) json[key] = value;
  for (const auto& [key, value] : o.choices) json[key] = value;
  return json;
}

Json world_json(const World& w) {
  const DriverChoice& d = w.driver;
  const TrackerChoice& t = w.tracker;
  const Physics& p = w.physics;
  const RobotModel& m = w.robot.model;
  return {{"engine", w.engine->name},
          {"options", options_json(w.options)},
          {"driver", d.kind + (d.open_loop ? " open loop" : "")},
          {"control_rate_hz", d.rate_hz},
          {"tracker", t.kind},
          {"tracker_rate_hz", t.rate_hz},
          {"tracker_delay_s", t.delay_s},
          {"tracker_clock_drift", t.clock_drift},
          {"tracker_dropout", t.dropout},
          {"frame", {t.X_TW.x_m, t.X_TW.y_m, t.X_TW.theta_rad}},
          {"marker", {t.X_BM.x_m, t.X_BM.y_m, t.X_BM.theta_rad}},
          {"runs", w.runs.set},
          {"robot", w.robot.name},
          {"mass_kg", m.total_mass_kg()},
          {"wheel_radius_m", m.wheels[0].radius_m},
          {"wheelbase_m", m.wheelbase_m()},
          {"friction", p.friction},
          {"creep_along", p.creep_along},
          {"creep_across", p.creep_across},
          {"patch_width_m", p.patch_width_m},
          {"motor_lag_s", p.motor_lag_s},
          {"caster_friction", p.caster_friction}};
}

double length_m(const Way& way) {
  double sum = 0;
  for (const Segment& s : way.segments) sum += s.length_m;
  return sum;
}

// Whether every run was driven to its end by a robot that stands on its wheels and rolls.
bool drives(const World& w, const DrivenWorld& driven) {
  for (std::size_t i = 0; i < driven.runs.size(); ++i) {
    if (!driven.arrived[i]) return false;
    const RecordedRun& run = driven.runs[i];
    const Segment& last = Plan(w.runs.ways[i].limits, w.runs.ways[i].segments).segments().back();
    const Pose2 X_SE = last.X_SB_start * arc(last.length_m, last.angle_rad);
    const Pose2 miss = inverse(run.truth.front().X_WB * X_SE) * run.truth.back().X_WB;
    if (!(std::hypot(miss.x_m, miss.y_m) < kFarOff * length_m(w.runs.ways[i]))) return false;
    if (!(std::abs(miss.theta_rad) < kFarTurned_rad)) return false;
  }
  return true;
}

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

std::string tier_of(const World& w, CaseKind kind) {
  if (kind == CaseKind::none) return "no_effect";
  if (kind == CaseKind::outside || kind == CaseKind::excluded) return "outside";
  if (kind != CaseKind::single) return "pairs";
  return w.tracker.end_points ? "end_points" : "single";
}

Json answer_of(const WorldCase& c, const ReadyWorld& ready, const std::vector<ScaledFault>& faults) {
  Json json{{"tier", tier_of(ready.world, c.kind)},
            {"effects", Json::object()},
            {"excluded", c.excluded},
            {"severities", Json::object()}};
  bool undetectable = !faults.empty();
  for (const ScaledFault& f : faults) {
    json["effects"][f.name] = fault_json(f, ready.world.tracker.X_TW);
    json["severities"][f.name] = {{"drawn", f.drawn}, {"severity", f.seen.severity}, {"signal", name(f.seen.signal)}};
    undetectable = undetectable && f.seen.severity < kLeastSeverity;
  }
  json["undetectable_expected"] = undetectable;
  json["noise_level"] = ready.world.noise_level;
  json["world"] = world_json(ready.world);
  json["world"]["kind"] = name(c.kind);
  json["world"]["of_the_world"] = ready.scale->of_the_world();
  return json;
}

std::uint64_t drive_seed(const WorldsPlan& plan, const WorldCase& c) {
  return RandomStream(plan.seed, "worlds drives", c.index).bits() >> 1;
}

void drive_case(const WorldsPlan& plan, const WorldCase& c, const ReadyWorld& ready, DrawnCase& drawn) {
  const std::uint64_t seed = drive_seed(plan, c);
  for (int attempt = 0;; ++attempt) {
    try {
      const std::vector<ScaledFault> faults = draw_faults(plan, c, ready, attempt);
      Drive drive{{}, usual_noise(ready.world.noise_level), seed, 1};
      for (const ScaledFault& f : faults) {
        drive.faults.effects.insert(drive.faults.effects.end(), f.faults.effects.begin(), f.faults.effects.end());
        drive.faults.outside.insert(drive.faults.outside.end(), f.faults.outside.begin(), f.faults.outside.end());
      }
      const DrivenWorld driven = drive_world(ready.world, drive);
      drawn.recording = record(ready.world, driven, seed);
      drawn.answer = answer_of(c, ready, faults);
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

#include "bench/worlds/draw/answer.h"

namespace umbsim::worlds {
namespace {

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

std::string tier_of(const World& w, CaseKind kind) {
  if (kind == CaseKind::none) return "no_effect";
  if (kind == CaseKind::outside || kind == CaseKind::excluded) return "outside";
  if (kind != CaseKind::single) return "pairs";
  return w.tracker.end_points ? "end_points" : "single";
}

}  // namespace

Json answer_of(const World& world, const WorldScale& scale, CaseKind kind, const std::vector<std::string>& excluded,
               const std::vector<ScaledFault>& faults) {
  Json json{{"tier", tier_of(world, kind)},
            {"effects", Json::object()},
            {"excluded", excluded},
            {"severities", Json::object()}};
  bool undetectable = !faults.empty();
  for (const ScaledFault& f : faults) {
    json["effects"][f.name] = fault_json(f, world.tracker.X_TW);
    if (f.drawn) json["severities"][f.name]["drawn"] = *f.drawn;
    json["severities"][f.name]["severity"] = f.seen.severity;
    json["severities"][f.name]["signal"] = name(f.seen.signal);
    undetectable = undetectable && f.seen.severity < kLeastSeverity;
  }
  json["undetectable_expected"] = undetectable;
  json["noise_level"] = world.noise_level;
  json["world"] = world_json(world);
  json["world"]["kind"] = name(kind);
  json["world"]["of_the_world"] = scale.of_the_world();
  return json;
}

}  // namespace umbsim::worlds

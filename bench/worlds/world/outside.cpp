// Effects outside the catalogue: one line each.
#include "bench/worlds/world/outside.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace umbsim::worlds {
namespace {

using Values = std::map<std::string, double>;

constexpr double kStanding_mps = 0.005, kStanding_radps = 0.02;
constexpr double kBraking_mps2 = 0.02;  // a speed that falls by more than this is being braked
constexpr double kHeating_s = 30;
constexpr double kLump_rad = 0.4;
constexpr double kFlatSpot_m = 0.15;  // of way after which a tyre that stood is round again

std::size_t wheel(const Values& v) { return v.at("wheel") < 0.5 ? 0 : 1; }

bool inside(const Values& v, const Pose2& at) {
  return std::hypot(at.x_m - v.at("x_m"), at.y_m - v.at("y_m")) <= v.at("radius_m");
}

// A brake that grabs: the tyre of one wheel slips while the robot slows down, which yaws it at every stop.
void grabbing_brake(const Values& v, const Moment& now, Memory& m, Acts& acts) {
  const double speed = std::abs(now.speed_mps());
  const double slowing = (m.value[0] - speed) / now.slice_s;
  m.value[0] = speed;
  if (speed > kStanding_mps && slowing > kBraking_mps2) acts.rolling[wheel(v)] *= 1 + v.at("sign") * v.at("slip");
}

// A carpet runner in one area.
void local_drift(const Values& v, const Moment& now, Memory&, Acts& acts) {
  if (!inside(v, now.X_WB)) return;
  acts.drift_x += v.at("metres_per_metre") * std::cos(v.at("direction_rad"));
  acts.drift_y += v.at("metres_per_metre") * std::sin(v.at("direction_rad"));
}

void oscillating_motor(const Values& v, const Moment& now, Memory&, Acts& acts) {
  acts.command[wheel(v)] *= 1 + v.at("relative") * std::sin(2 * M_PI * v.at("hertz") * now.time_s + v.at("phase_rad"));
}

void bent_axle(const Values& v, const Moment& now, Memory&, Acts& acts) {
  const std::size_t i = wheel(v);
  acts.rolling[i] *= 1 + v.at("relative") * std::cos(2 * now.wheel_rad[i] + v.at("phase_rad"));
}

void wind(const Values& v, const Moment& now, Memory&, Acts& acts) {
  if (!now.moving()) return;
  const double force = v.at("of_weight") * now.weight_n;
  acts.pull.force_x_n += force * std::cos(v.at("direction_rad"));
  acts.pull.force_y_n += force * std::sin(v.at("direction_rad"));
  acts.pull.height_m = now.radius_m[0];
}

void heating_wheel(const Values& v, const Moment& now, Memory&, Acts& acts) {
  acts.rolling[wheel(v)] *= 1 + v.at("sign") * v.at("relative") * (1 - std::exp(-now.time_s / kHeating_s));
}

// A cable dragged along behind: it pulls at the tail against the way that the tail goes.
void dragged_cable(const Values& v, const Moment& now, Memory&, Acts& acts) {
  const double tail_m = now.wheelbase_m / 2;
  const double c = std::cos(now.X_WB.theta_rad), s = std::sin(now.X_WB.theta_rad);
  const double along = now.speed_mps(), across = -now.yaw_radps() * tail_m;
  const double vx = c * along - s * across, vy = s * along + c * across, speed = std::hypot(vx, vy);
  if (speed < kStanding_mps) return;
  const double force = v.at("of_weight") * now.weight_n;
  acts.pull.force_x_n -= force * vx / speed;
  acts.pull.force_y_n -= force * vy / speed;
  acts.pull.ahead_m = -tail_m;
}

// Now and then the counts of a moment count double.
void doubled_counts(const Values& v, const Moment& now, Memory& m, Acts& acts) {
  const double turned_rad = std::abs(now.wheel_radps[wheel(v)]) * now.slice_s;
  if (m.random.uniform() < v.at("per_revolution") * turned_rad / (2 * M_PI)) acts.counted[wheel(v)] *= 2;
}

void lump(const Values& v, const Moment& now, Memory&, Acts& acts) {
  const std::size_t i = wheel(v);
  if (std::abs(wrap_angle(now.wheel_rad[i] - v.at("phase_rad"))) < kLump_rad / 2)
    acts.rolling[i] *= 1 + v.at("relative");
}

// A tyre that grows with speed.
void fast_tyre(const Values& v, const Moment& now, Memory&, Acts& acts) {
  const std::size_t i = wheel(v);
  acts.rolling[i] *= 1 + v.at("sign") * v.at("per_mps") * std::abs(now.wheel_radps[i]) * now.radius_m[i];
}

// A chassis that twists: the outer wheel's way counts differently in turns to one side alone.
void one_sided_turns(const Values& v, const Moment& now, Memory&, Acts& acts) {
  if (v.at("sign") * now.yaw_radps() < kStanding_radps) return;
  for (std::size_t i = 0; i < 2; ++i) acts.rolling[i] *= 1 + v.at("relative");
}

// Vibration on one stretch of the floor: a loose plug loses counts there.
void rattling_encoder(const Values& v, const Moment& now, Memory&, Acts& acts) {
  if (inside(v, now.X_WB)) acts.counted[wheel(v)] *= 1 - v.at("lost");
}

// A soft tyre that stood has a flat spot, for a short way.
void flat_spot(const Values& v, const Moment& now, Memory& m, Acts& acts) {
  const std::size_t i = wheel(v);
  m.value[0] = now.moving() ? m.value[0] + std::abs(now.wheel_radps[i]) * now.radius_m[i] * now.slice_s : 0;
  acts.rolling[i] *= 1 - v.at("relative") * std::exp(-m.value[0] / kFlatSpot_m);
}

}  // namespace

bool Moment::moving() const { return std::abs(speed_mps()) > kStanding_mps || std::abs(yaw_radps()) > kStanding_radps; }

const std::vector<OutsideInfo>& outside_effects() {
  static const std::vector<OutsideInfo> table = {
      {"grabbing_brake",
       "one tyre slips at every braking: yaw at every stop",
       "slip",
       "1",
       {0.005, 0.2},
       false,
       grabbing_brake},
      {"local_drift", "carpet drift in one area", "metres_per_metre", "1", {0.005, 0.2}, true, local_drift},
      {"oscillating_motor",
       "a motor's speed swings about its set-point",
       "relative",
       "1",
       {0.01, 0.2},
       false,
       oscillating_motor},
      {"bent_axle", "a wheel wobbles with its double angle", "relative", "1", {0.002, 0.06}, false, bent_axle},
      {"wind", "a force in one direction while the robot moves", "of_weight", "1", {0.005, 0.15}, false, wind},
      {"heating_wheel", "a wheel's radius grows within a run", "relative", "1", {0.0005, 0.02}, false, heating_wheel},
      {"dragged_cable", "a cable drags behind the robot", "of_weight", "1", {0.005, 0.15}, false, dragged_cable},
      {"doubled_counts",
       "now and then counts count double",
       "per_revolution",
       "1",
       {0.002, 0.3},
       false,
       doubled_counts},
      {"lump", "a lump on a tyre at one angle", "relative", "1", {0.005, 0.1}, false, lump},
      {"fast_tyre", "a tyre grows with speed", "per_mps", "s/m", {0.001, 0.1}, false, fast_tyre},
      {"one_sided_turns",
       "turns to one side come out wider than to the other",
       "relative",
       "1",
       {0.001, 0.05},
       false,
       one_sided_turns},
      {"rattling_encoder", "counts are lost in one area", "lost", "1", {0.005, 0.3}, true, rattling_encoder},
      {"flat_spot", "a tyre is flat where it stood, for a short way", "relative", "1", {0.005, 0.1}, false, flat_spot},
  };
  return table;
}

const OutsideInfo& find_outside(const std::string& name) {
  for (const OutsideInfo& info : outside_effects()) {
    if (info.name == name) return info;
  }
  throw InputError("no effect '" + name + "' outside the catalogue");
}

}  // namespace umbsim::worlds

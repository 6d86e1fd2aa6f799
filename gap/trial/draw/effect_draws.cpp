#include "gap/trial/draw/effect_draws.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace umbsim {
namespace {

// Half to ten noise floors may lie below what real robots show.
constexpr double kBelowPlausible = 100;

// Encoders are read once in it; what comes later than a reading waits for the next.
constexpr double kControlPeriod_s = 0.02;

double log_uniform(RandomStream& random, double min, double max) {
  return min * std::pow(max / min, random.uniform());
}

/// What the lines of the table draw with.
class Draw {
 public:
  Draw(const EffectInfo& info, const Platform& on, const std::vector<PlannedRun>& in, RandomStream& stream)
      : drawn{neutral_effect(info), {}, {}, {}}, platform(on), runs(in), random(stream) {}

  double sign() { return random.uniform() < 0.5 ? -1 : 1; }
  double angle() { return random.uniform(-M_PI, M_PI); }
  std::size_t pick(std::size_t count) { return std::min(count - 1, std::size_t(random.uniform(0, double(count)))); }

  void set(const char* name, double value) { drawn.effect.values.numbers[index(name)] = value; }
  void set_within_plausible(const char* name) {
    const EffectParameter& p = parameter(name);
    set(name, random.uniform(p.plausible_min, p.plausible_max));
  }

  /// value = weight * amplitude.
  void grow(const char* name, double weight = 1) {
    use_range(parameter(name).plausible_min, parameter(name).plausible_max);
    drawn.amplitude.push_back({index(name), weight});
  }
  /// The same from `least` on, below which all values do the same.
  void grow_from(const char* name, double least) {
    grow(name);
    drawn.range.min = drawn.plausible.min = least;
  }
  /// value = neutral + amplitude.
  void grow_above_neutral(const char* name) {
    const EffectParameter& p = parameter(name);
    use_range(p.plausible_min - p.neutral, p.plausible_max - p.neutral);
    drawn.amplitude.push_back({index(name), 1, p.neutral});
  }
  /// value = weight / amplitude, with the amplitude at least `weakest`.
  void shrink(const char* name, double weight, double smallest, double weakest) {
    drawn.amplitude.push_back({index(name), weight, 0, true});
    drawn.range = drawn.plausible = {weakest, weight / smallest};
  }
  /// One wheel or, as often, both.
  void grow_wheels(const char* left, const char* right, bool signs) {
    const std::size_t which = pick(4);
    if (which != 0) grow(left, signs ? sign() : 1);
    if (which != 1) grow(right, signs ? sign() : 1);
  }

  /// A place on a wheel's track along a leg of the plain square; returns the heading of that leg.
  double place_on_leg() {
    const Pose2 at = leg_start(turn_angle()) * Pose2{random.uniform(0.15, 0.85) * platform.side_m, half_track(), 0};
    set("x_m", at.x_m);
    set("y_m", at.y_m);
    return at.theta_rad;
  }

  /// A place on a wheel's track during a turn at a corner of the plain square: where wheels turn against each other,
  /// start and stop.
  void place_on_turn() {
    const double turn = turn_angle();
    const Pose2 corner = leg_start(turn) * Pose2{platform.side_m, 0, random.uniform() * turn};
    const Pose2 at = corner * Pose2{0, half_track(), 0};
    set("x_m", at.x_m);
    set("y_m", at.y_m);
  }

  const EffectParameter& parameter(const char* name) const { return drawn.effect.info->parameters[index(name)]; }

  DrawnEffect drawn;
  const Platform& platform;
  const std::vector<PlannedRun>& runs;
  RandomStream& random;

 private:
  double half_track() { return sign() * platform.robot.wheelbase_m / 2; }
  double turn_angle() { return runs[pick(runs.size())].direction == "cw" ? -M_PI / 2 : M_PI / 2; }
  Pose2 leg_start(double turn) {
    Pose2 X_WB;
    for (std::size_t leg = pick(4); leg > 0; --leg) X_WB = X_WB * Pose2{platform.side_m, 0, turn};
    return X_WB;
  }
  std::size_t index(const char* name) const {
    const std::vector<EffectParameter>& all = drawn.effect.info->parameters;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].name == name) return i;
    }
    throw std::logic_error(drawn.effect.info->name + " has no parameter " + name);
  }
  void use_range(double min, double max) {
    if (min <= 0) min = max / kBelowPlausible;
    drawn.plausible = {min, max};
    drawn.range = {min / kBelowPlausible, max};
  }
};

struct DrawLine {
  const char* effect;
  void (*draw)(Draw& d);
};

// One line for each effect of the catalogue.
const DrawLine kDraws[] = {
    {"wheel_radius_scale", [](Draw& d) { d.grow("relative", d.sign()); }},
    {"wheel_radius_difference", [](Draw& d) { d.grow("relative", d.sign()); }},
    {"wheelbase", [](Draw& d) { d.grow("relative", d.sign()); }},
    {"wheel_misalignment", [](Draw& d) { d.grow_wheels("left_toe_rad", "right_toe_rad", true); }},
    {"wheel_eccentricity",
     [](Draw& d) {
       d.grow_wheels("left_m", "right_m", false);
       d.set("left_phase_rad", d.angle());
       d.set("right_phase_rad", d.angle());
     }},
    {"load_shift",
     [](Draw& d) {
       d.grow("payload_kg");
       d.set_within_plausible("ahead_m");
       d.set("left_m", d.random.uniform(-1, 1) * d.parameter("left_m").plausible_max);
       d.set_within_plausible("height_m");
     }},
    {"wear", [](Draw& d) { d.grow_wheels("left_relative_per_run", "right_relative_per_run", true); }},
    {"backlash", [](Draw& d) { d.grow_wheels("left_rad", "right_rad", false); }},
    {"motor_response",
     [](Draw& d) {
       switch (d.pick(3)) {
         case 0: return d.grow("lag_s");
         case 1: return d.grow("deadband_radps");
         default: return d.grow("gain_asymmetry", d.sign());
       }
     }},
    {"over_acceleration", [](Draw& d) { d.grow_above_neutral("factor"); }},
    {"fast_turning", [](Draw& d) { d.grow_above_neutral("factor"); }},
    {"encoder_resolution",
     [](Draw& d) {
       d.shrink("ticks_per_revolution", d.platform.ticks_per_revolution,
                d.parameter("ticks_per_revolution").plausible_min, 1);
     }},
    {"encoder_sampling", [](Draw& d) { d.grow_from("interval_s", kControlPeriod_s); }},
    {"encoder_missed_counts", [](Draw& d) { d.grow_wheels("left_probability", "right_probability", false); }},
    {"encoder_latency",
     [](Draw& d) {
       d.grow_from("seconds", kControlPeriod_s);
       d.drawn.amplitude.back().grain = kControlPeriod_s;
     }},
    {"tyre_compliance", [](Draw& d) { d.grow("metres_per_newton"); }},
    {"contact_patch",
     [](Draw& d) {
       d.grow("width_m");
       d.drawn.range.max = d.drawn.plausible.max = std::min(d.drawn.range.max, kTrialWheelWidth_m);
     }},
    {"tyre_creep",
     [](Draw& d) {
       const std::size_t which = d.pick(3);
       if (which != 0) d.grow("along");
       if (which != 1) d.grow("across");
     }},
    {"caster_swivel",
     [](Draw& d) {
       d.grow("friction_nm");
       d.set_within_plausible("trail_m");
       d.set("initial_angle_rad", d.angle());
     }},
    {"caster_drag",
     [](Draw& d) {
       d.grow("coefficient");
       d.set("left_m", d.sign() * d.random.uniform(0, d.parameter("left_m").plausible_max));
     }},
    {"slippery_floor",
     [](Draw& d) {
       d.shrink("friction", 1, d.parameter("friction").plausible_min, 1 / d.parameter("friction").plausible_max);
     }},
    {"slippery_patch",
     [](Draw& d) {
       d.place_on_turn();
       d.set_within_plausible("radius_m");
       d.shrink("friction", 1, d.parameter("friction").plausible_min, 1 / d.parameter("friction").plausible_max);
     }},
    {"bump",
     [](Draw& d) {
       const double heading = d.place_on_leg();
       d.set("direction_rad", wrap_angle(heading + M_PI / 2));
       d.grow("height_m");
     }},
    {"uneven_floor",
     [](Draw& d) {
       const EffectParameter& wavelength = d.parameter("wavelength_m");
       d.set("wavelength_m", log_uniform(d.random, wavelength.plausible_min, wavelength.plausible_max));
       d.set("seed", double(1 + d.pick(1000)));
       d.grow("rms_m");
     }},
    {"floor_slope",
     [](Draw& d) {
       d.grow("slope_rad");
       d.set("downhill_rad", d.angle());
     }},
    {"carpet_drift",
     [](Draw& d) {
       d.grow("metres_per_metre");
       d.set("direction_rad", d.angle());
     }},
    {"push",
     [](Draw& d) {
       const PlannedRun& run = d.runs[d.pick(d.runs.size())];
       const double leg_s = d.platform.side_m / (d.platform.linear_speed_mps * run.speed_factor);
       d.drawn.effect.values.run = run.id;
       d.set("leg", double(1 + d.pick(4)));
       d.set("seconds_into_leg", d.random.uniform(0.15, 0.7) * leg_s);
       // From the side, where the catalogue has it: direction and lever can be told from the impulse in no data.
       d.grow("impulse_newton_seconds", d.sign());
     }},
    {"wheel_lift",
     [](Draw& d) {
       d.place_on_turn();
       d.grow("length_m");
     }},
};

}  // namespace

Effect DrawnEffect::at(double a) const {
  Effect result = effect;
  for (const AmplitudeParameter& p : amplitude) {
    double& value = result.values.numbers[p.index];
    value = p.reciprocal ? p.weight / a : p.offset + p.weight * a;
    if (p.grain > 0) value = p.grain * std::round(value / p.grain);
  }
  return result;
}

DrawnEffect draw_effect(const EffectInfo& info, const Platform& platform, const std::vector<PlannedRun>& runs,
                        RandomStream& random) {
  for (const DrawLine& line : kDraws) {
    if (info.name != line.effect) continue;
    Draw draw(info, platform, runs, random);
    line.draw(draw);
    return std::move(draw.drawn);
  }
  throw std::logic_error("no line in the table of draws for " + info.name);
}

std::vector<std::string> strength_parameters(const std::string& effect) {
  static const std::map<std::string, std::vector<std::string>> kStrength = {
      {"wheel_radius_scale", {"relative"}},
      {"wheel_radius_difference", {"relative"}},
      {"wheelbase", {"relative"}},
      {"wheel_misalignment", {"left_toe_rad", "right_toe_rad"}},
      {"wheel_eccentricity", {"left_m", "right_m"}},
      {"load_shift", {"payload_kg"}},
      {"wear", {"left_relative_per_run", "right_relative_per_run"}},
      {"backlash", {"left_rad", "right_rad"}},
      {"motor_response", {"lag_s", "deadband_radps", "gain_asymmetry", "torque_limit_nm", "droop_radps_per_nm"}},
      {"over_acceleration", {"factor"}},
      {"fast_turning", {"factor"}},
      {"encoder_resolution", {"ticks_per_revolution"}},
      {"encoder_sampling", {"interval_s"}},
      {"encoder_missed_counts", {"left_probability", "right_probability", "probability_per_radps"}},
      {"encoder_latency", {"seconds"}},
      {"tyre_compliance", {"metres_per_newton"}},
      {"contact_patch", {"width_m"}},
      {"tyre_creep", {"along", "across"}},
      {"caster_swivel", {"friction_nm"}},
      {"caster_drag", {"coefficient"}},
      {"slippery_floor", {"friction"}},
      {"slippery_patch", {"friction"}},
      {"bump", {"height_m"}},
      {"uneven_floor", {"rms_m"}},
      {"floor_slope", {"slope_rad"}},
      {"carpet_drift", {"metres_per_metre"}},
      {"push", {"impulse_newton_seconds"}},
      {"wheel_lift", {"length_m"}},
  };
  const auto found = kStrength.find(effect);
  return found == kStrength.end() ? std::vector<std::string>{} : found->second;
}

}  // namespace umbsim

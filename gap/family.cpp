#include "gap/family.h"

#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

std::size_t index_of(const EffectInfo& info, const std::string& parameter) {
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    if (info.parameters[i].name == parameter) return i;
  }
  return 0;
}

// A family whose free numbers are parameters of the effect as they are.
Family direct(const std::string& effect, const std::string& variant, std::vector<FreeParameter> parameters,
              std::vector<std::pair<std::string, double>> fixed = {}) {
  Family family{effect, variant, parameters, {}, {}, true, 0};
  const EffectInfo& info = find_effect(effect);
  EffectValues base = neutral_effect(info).values;
  for (const auto& [name, value] : fixed) base.numbers[index_of(info, name)] = value;
  std::vector<std::size_t> where;
  for (FreeParameter& p : family.parameters) {
    where.push_back(index_of(info, p.name));
    const Bounds& bounds = info.parameters[where.back()].bounds;
    p.min = std::max(p.min, bounds.min);
    p.max = std::min(p.max, bounds.max);
  }
  family.values = [base, where](const Eigen::VectorXd& p) {
    EffectValues values = base;
    for (std::size_t i = 0; i < where.size(); ++i) values.numbers[where[i]] = p[Eigen::Index(i)];
    return values;
  };
  return family;
}

// A size and a direction, fitted as two components.
Family vector_family(const std::string& effect, const std::string& size, const std::string& angle, double step,
                     double prior_sd, double limit) {
  const EffectInfo& info = find_effect(effect);
  const EffectValues base = neutral_effect(info).values;
  const std::size_t i = index_of(info, size);
  const std::size_t j = index_of(info, angle);
  Family family{effect, size,
                {{size + " cos", 0, step, prior_sd, -limit, limit}, {size + " sin", 0, step, prior_sd, -limit, limit}},
                {}, {}, true, 0};
  family.values = [base, i, j](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[i] = std::hypot(p[0], p[1]);
    values.numbers[j] = values.numbers[i] > 0 ? std::atan2(p[1], p[0]) : 0;
    return values;
  };
  return family;
}

// A number that counts in proportion: fitted as the logarithm of its ratio to `unit`.
Family logarithmic(const std::string& effect, const std::string& parameter, double unit, double prior_sd, double min,
                   double max) {
  const EffectInfo& info = find_effect(effect);
  const EffectValues base = neutral_effect(info).values;
  const std::size_t i = index_of(info, parameter);
  Family family{effect, parameter, {{"log " + parameter, 0, 0.05, prior_sd, min, max}}, {}, {}, true, 0};
  family.values = [base, i, unit](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[i] = unit * std::exp(p[0]);
    return values;
  };
  return family;
}

constexpr double kFree = 1e9;

FreeParameter signed_one(const char* name, double step, double prior_sd) {
  return {name, 0, step, prior_sd, -kFree, kFree};
}

FreeParameter positive(const char* name, double step, double prior_sd) { return {name, 0, step, prior_sd, 0, kFree}; }

// Logarithms of how many places on the path, and moments of the runs, were tried.
constexpr double kPlaces = 7;
constexpr double kMoments = 9;
constexpr double kPlacesApart = 4;  // places so far apart that none is in reach of another's fit

Family searched(Family family, double cost) {
  family.search_cost = cost;
  return family;
}

Family from_start(Family family, double start) {
  family.parameters.front().start = start;
  family.from_zero = false;
  return family;
}

}  // namespace

bool shows_in_counts(const EffectInfo& info) {
  return info.stage == Stage::drivetrain || info.stage == Stage::encoder || info.name == "over_acceleration" ||
         info.name == "fast_turning";
}

Effect effect_of(const Family& family, const Eigen::VectorXd& p) {
  return {&find_effect(family.effect), family.values(p)};
}

std::vector<Effect> effects_of(const Family& family, const Eigen::VectorXd& p) {
  std::vector<Effect> effects{effect_of(family, p)};
  if (family.with) {
    for (Effect& e : family.with(p)) effects.push_back(std::move(e));
  }
  return effects;
}

namespace {

// Both encoders lose the same share.
Family both_miss() {
  const EffectInfo& info = find_effect("encoder_missed_counts");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t left = index_of(info, "left_probability");
  const std::size_t right = index_of(info, "right_probability");
  Family family{"encoder_missed_counts", "both", {{"probability", 0, 1e-3, 0.005, 0, 0.9}}, {}, {}, true, 0};
  family.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[left] = values.numbers[right] = p[0];
    return values;
  };
  return family;
}

// Both wheels off their centres, each by its own two components.
Family both_eccentric() {
  const Family left = vector_family("wheel_eccentricity", "left_m", "left_phase_rad", 5e-4, 1e-3, 0.02);
  const Family right = vector_family("wheel_eccentricity", "right_m", "right_phase_rad", 5e-4, 1e-3, 0.02);
  Family both = left;
  both.variant = "both";
  both.parameters.insert(both.parameters.end(), right.parameters.begin(), right.parameters.end());
  both.values = [left, right](const Eigen::VectorXd& p) {
    EffectValues values = left.values(p.head(2));
    const EffectValues other = right.values(p.tail(2));
    for (std::size_t i = 0; i < values.numbers.size(); ++i) values.numbers[i] += other.numbers[i];
    return values;
  };
  return both;
}

// Toed wheels scrub, and how that slows and turns the robot depends on how softly the tyres grip.
Family on_soft_tyres(Family family) {
  family.variant += ", soft tyres";
  const Eigen::Index own = Eigen::Index(family.parameters.size());
  // Shares of slip per traction ratio; their logarithms, for scrub depends on their order of magnitude.
  constexpr double kAlong = 0.1;
  constexpr double kAcross = 0.01;
  family.parameters.push_back({"log tyre_creep.along", 0, 0.2, 1.5, -5, 1.6});
  family.parameters.push_back({"log tyre_creep.across", 0, 0.2, 1.5, -5, 3.9});
  family.from_zero = false;
  family.parameters.front().start = family.parameters.front().step * 2;
  family.with = [own](const Eigen::VectorXd& p) {
    Effect creep = neutral_effect(find_effect("tyre_creep"));
    creep.values.numbers = {kAlong * std::exp(p[own]), kAcross * std::exp(p[own + 1])};
    return std::vector<Effect>{creep};
  };
  return family;
}

}  // namespace

std::vector<Family> plain_families(double period_s, double ticks_per_revolution) {
  std::vector<Family> all = {
      logarithmic("over_acceleration", "factor", 1, 2, -3, 6),
      logarithmic("fast_turning", "factor", 1, 1.5, -3, 4),
      logarithmic("encoder_sampling", "interval_s", period_s, 1, 0, 4),
      logarithmic("encoder_resolution", "ticks_per_revolution", ticks_per_revolution, 2, -7, 0),
      direct("wheel_radius_scale", "both", {signed_one("relative", 2e-4, 0.01)}),
      direct("wheel_radius_difference", "right over left", {signed_one("relative", 2e-4, 0.004)}),
      direct("wheelbase", "relative", {signed_one("relative", 5e-4, 0.015)}),
      direct("wheel_misalignment", "right", {signed_one("right_toe_rad", 2e-3, 0.008)}),
      direct("wheel_misalignment", "left", {signed_one("left_toe_rad", 2e-3, 0.008)}),
      direct("wheel_misalignment", "both", {signed_one("left_toe_rad", 2e-3, 0.008), signed_one("right_toe_rad", 2e-3, 0.008)}),
      on_soft_tyres(direct("wheel_misalignment", "right", {signed_one("right_toe_rad", 2e-3, 0.008)})),
      on_soft_tyres(direct("wheel_misalignment", "left", {signed_one("left_toe_rad", 2e-3, 0.008)})),
      vector_family("wheel_eccentricity", "right_m", "right_phase_rad", 5e-4, 1e-3, 0.02),
      vector_family("wheel_eccentricity", "left_m", "left_phase_rad", 5e-4, 1e-3, 0.02),
      both_eccentric(),
      direct("wear", "right", {signed_one("right_relative_per_run", 2e-5, 1e-3)}),
      direct("wear", "left", {signed_one("left_relative_per_run", 2e-5, 1e-3)}),
      direct("wear", "both", {signed_one("left_relative_per_run", 2e-5, 1e-3), signed_one("right_relative_per_run", 2e-5, 1e-3)}),
      direct("backlash", "both", {positive("left_rad", 0.01, 0.03), positive("right_rad", 0.01, 0.03)}),
      direct("motor_response", "lag", {positive("lag_s", 0.05, 0.1)}),
      direct("motor_response", "gain", {signed_one("gain_asymmetry", 0.01, 0.05)}),
      direct("motor_response", "deadband", {positive("deadband_radps", 0.02, 0.05)}),
      direct("encoder_missed_counts", "right", {positive("right_probability", 1e-3, 0.005)}),
      direct("encoder_missed_counts", "left", {positive("left_probability", 1e-3, 0.005)}),
      both_miss(),
      direct("encoder_missed_counts", "speed", {positive("probability_per_radps", 3e-4, 1e-3)}),
      direct("encoder_latency", "delay", {positive("seconds", 0.02, 0.1)}),
      direct("tyre_compliance", "both", {positive("metres_per_newton", 5e-7, 3e-6)}),
      direct("contact_patch", "width", {positive("width_m", 0.01, 0.03)}),
      direct("tyre_creep", "along and across", {{"along", 0, 5e-3, 0.02, 0, 0.1}, {"across", 0, 5e-3, 0.02, 0, 0.1}}),
      from_start(direct("caster_swivel", "friction", {positive("friction_nm", 0.1, 0.5)}, {{"trail_m", 0.03}}), 0.3),
      from_start(direct("caster_swivel", "askew",
                        {{"initial_angle_rad", 0, 0.3, 2, -3.14, 3.14}}, {{"trail_m", 0.03}, {"friction_nm", 0.1}}), 1.5),
      direct("caster_drag", "coefficient", {positive("coefficient", 0.02, 0.04)}),
      from_start(direct("slippery_floor", "friction", {{"friction", 0, 0.005, 0.2, 0.01, 0.8}}), 0.06),
      vector_family("floor_slope", "slope_rad", "downhill_rad", 0.01, 0.02, 0.5),
      vector_family("carpet_drift", "metres_per_metre", "direction_rad", 1e-3, 0.008, 0.5),
  };
  for (Family& f : all) {
    const auto same = [&](const Family& g) { return g.effect == f.effect; };
    f.variant_cost = std::log(double(std::count_if(all.begin(), all.end(), same)));
  }
  return all;
}

Family bump_family(double x_m, double y_m, double heading_rad) {
  const EffectInfo& info = find_effect("bump");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t h = index_of(info, "height_m");
  const std::size_t x = index_of(info, "x_m");
  const std::size_t y = index_of(info, "y_m");
  const std::size_t d = index_of(info, "direction_rad");
  Family family{"bump", "height and place",
                {{"height_m", 0.005, 5e-4, 0.008, 5e-4, 0.02}, {"further along m", 0, 0.004, 0.03, -0.1, 0.1}},
                {}, {}, false, kPlaces};
  family.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[h] = p[0];
    values.numbers[x] = x_m + p[1] * std::cos(heading_rad);
    values.numbers[y] = y_m + p[1] * std::sin(heading_rad);
    values.numbers[d] = std::remainder(heading_rad + M_PI / 2, M_PI);
    return values;
  };
  return family;
}

namespace {

// A coordinate of the place, seen from where the search begins.
FreeParameter coordinate(const char* name) { return {name, 0, 0.005, 0.15, -0.6, 0.6}; }

// The last two numbers are a place.
Family placed(Family family, double x_m, double y_m) {
  const Eigen::Index own = Eigen::Index(family.parameters.size()) - 2;
  const auto values = family.values;
  family.values = [values, own, x_m, y_m](const Eigen::VectorXd& p) {
    Eigen::VectorXd at = p;
    at[own] += x_m;
    at[own + 1] += y_m;
    return values(at);
  };
  family.from_zero = false;
  return searched(std::move(family), kPlacesApart);
}

}  // namespace

Family lift_family(double x_m, double y_m) {
  return placed(direct("wheel_lift", "length and place",
                       {{"length_m", 0.06, 0.005, 0.1, 0.002, 0.4}, coordinate("x_m"), coordinate("y_m")}),
                x_m, y_m);
}

Family patch_family(double x_m, double y_m) {
  return placed(direct("slippery_patch", "friction, radius and place",
                       {{"friction", 0.03, 0.002, 0.2, 0.01, 0.8},
                        {"radius_m", 0.3, 0.02, 0.4, 0.03, 1.5},
                        coordinate("x_m"),
                        coordinate("y_m")}),
                x_m, y_m);
}

Family push_family(const std::string& run, int leg, double seconds_into_leg) {
  const EffectInfo& info = find_effect("push");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t l = index_of(info, "leg");
  const std::size_t t = index_of(info, "seconds_into_leg");
  const std::size_t i = index_of(info, "impulse_newton_seconds");
  Family family{"push", run,
                {{"impulse_newton_seconds", 30, 1, 60, -1000, 1000}, {"later s", 0, 0.02, 0.2, -0.6, 0.6}},
                {}, {}, false, kMoments};
  family.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.run = run;
    values.numbers[l] = leg;
    values.numbers[t] = std::max(0.0, seconds_into_leg + p[1]);
    values.numbers[i] = p[0];
    return values;
  };
  return family;
}

}  // namespace umbsim::gap

#include "gap/hypotheses/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "gap/hypotheses/felt_through.h"
#include "gap/hypotheses/parametrisations.h"

namespace umbsim::gap {
namespace {

constexpr double kFree = 1e9;
// Log of how much wider a wheelbase's prior is than a contact's width, which only takes from turns: of two that do
// nearly the same that must not decide.
constexpr double kNarrowContact = 2;

FreeParameter signed_one(const char* name, double step, double prior_sd) {
  return {name, 0, step, prior_sd, -kFree, kFree};
}

FreeParameter positive(const char* name, double step, double prior_sd) { return {name, 0, step, prior_sd, 0, kFree}; }

Hypothesis costing(double cost, Hypothesis hypothesis) {
  hypothesis.variant_cost = cost;
  return hypothesis;
}

Hypothesis from_start(Hypothesis hypothesis, double start) {
  hypothesis.parameters.front().start = start;
  hypothesis.from_zero = false;
  return hypothesis;
}

}  // namespace

Eigen::VectorXd start_of(const Hypothesis& hypothesis) {
  Eigen::VectorXd p(Eigen::Index(hypothesis.parameters.size()));
  for (Eigen::Index i = 0; i < p.size(); ++i) p[i] = hypothesis.parameters[std::size_t(i)].start;
  return p;
}

std::vector<FreeParameter> free_parameters(const std::vector<Hypothesis>& hypotheses) {
  std::vector<FreeParameter> free;
  for (const Hypothesis& f : hypotheses) free.insert(free.end(), f.parameters.begin(), f.parameters.end());
  return free;
}

Eigen::VectorXd prior_sd_of(const std::vector<Hypothesis>& hypotheses) {
  const std::vector<FreeParameter> free = free_parameters(hypotheses);
  Eigen::VectorXd sd(Eigen::Index(free.size()));
  for (Eigen::Index i = 0; i < sd.size(); ++i) sd[i] = free[std::size_t(i)].prior_sd;
  return sd;
}

Effect effect_of(const Hypothesis& hypothesis, const Eigen::VectorXd& p) {
  return {&find_effect(hypothesis.effect), hypothesis.values(p)};
}

std::vector<Effect> effects_of(const Hypothesis& hypothesis, const Eigen::VectorXd& p) {
  std::vector<Effect> effects{effect_of(hypothesis, p)};
  if (hypothesis.with) {
    for (Effect& e : hypothesis.with(p)) effects.push_back(std::move(e));
  }
  return effects;
}

bool shows_in_counts(const Hypothesis& hypothesis) {
  const std::vector<Effect> all = effects_of(hypothesis, start_of(hypothesis));
  return std::any_of(all.begin(), all.end(), [](const Effect& e) { return shows_in_counts(*e.info); });
}

namespace {

// Both wheels toed by the same angle against each other: the robot goes straight, scrubs, and makes less way, by the
// square of the angle.
Hypothesis toed_alike() {
  constexpr double kToeStep_rad = 0.03, kToePrior_rad = 0.02, kToeMost_rad = 0.2;
  const EffectInfo& info = find_effect("wheel_misalignment");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t left = index_of(info, "left_toe_rad");
  const std::size_t right = index_of(info, "right_toe_rad");
  const auto square = [](double rad) { return rad * rad; };
  Hypothesis hypothesis{"wheel_misalignment",
                        "alike",
                        {{"toe_rad squared", 0, square(kToeStep_rad), square(kToePrior_rad), 0, square(kToeMost_rad)}},
                        {},
                        {},
                        true,
                        0};
  hypothesis.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[left] = std::sqrt(std::max(p[0], 0.0));
    values.numbers[right] = -values.numbers[left];
    return values;
  };
  return hypothesis;
}

// Both encoders lose the same share.
Hypothesis both_miss() {
  const EffectInfo& info = find_effect("encoder_missed_counts");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t left = index_of(info, "left_probability");
  const std::size_t right = index_of(info, "right_probability");
  Hypothesis hypothesis{"encoder_missed_counts", "both", {{"probability", 0, 1e-3, 0.005, 0, 0.9}}, {}, {}, true, 0};
  hypothesis.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[left] = values.numbers[right] = p[0];
    return values;
  };
  return hypothesis;
}

// A payload that nobody told of, by its moments about the axle's middle; the rest of its mass lies over that.
Hypothesis load(double mass_kg) {
  const double sd_kg = mass_kg / 8, sd_kgm = 0.025 * mass_kg;
  const EffectInfo& info = find_effect("load_shift");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t mass = index_of(info, "payload_kg");
  const std::size_t ahead = index_of(info, "ahead_m");
  const std::size_t left = index_of(info, "left_m");
  Hypothesis hypothesis{"load_shift",
                        "payload",
                        {positive("payload_kg", sd_kg / 5, sd_kg), signed_one("ahead_kgm", sd_kgm / 5, sd_kgm),
                         signed_one("left_kgm", sd_kgm / 5, sd_kgm)},
                        {},
                        {},
                        true,
                        0};
  constexpr double kArm_m = 0.15;
  hypothesis.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    const double m = p[0] + std::hypot(p[1], p[2]) / kArm_m;
    values.numbers[mass] = m;
    values.numbers[ahead] = m > 0 ? p[1] / m : 0;
    values.numbers[left] = m > 0 ? p[2] / m : 0;
    return values;
  };
  return hypothesis;
}

// A caster that drags beside the middle also turns the robot: as much as drags to its left, less what drags to its
// right.
Hypothesis drag_of_sides(double prior_sd) {
  const EffectInfo& info = find_effect("caster_drag");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t coefficient = index_of(info, "coefficient");
  const std::size_t left = index_of(info, "left_m");
  constexpr double kBeside_m = 0.1;
  Hypothesis hypothesis{"caster_drag",
                        "both sides",
                        {positive("left", 0.02, prior_sd), positive("right", 0.02, prior_sd)},
                        {},
                        {},
                        true,
                        0};
  hypothesis.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    const double sum = p[0] + p[1];
    values.numbers[coefficient] = sum;
    values.numbers[left] = sum > 0 ? kBeside_m * (p[0] - p[1]) / sum : 0;
    return values;
  };
  return hypothesis;
}

// A bearing that hardly creeps: it pushes as long as its fork swings, however slowly that becomes.
Hypothesis dry_swivel() {
  return direct("caster_swivel", "dry bearing", {positive("friction_nm", 0.1, 2)},
                {{"trail_m", 0.03}, {"bearing_creep", 0.001}});
}

// Both wheels off their centres, each by its own two components.
Hypothesis both_eccentric() {
  const Hypothesis left = vector_hypothesis("wheel_eccentricity", "left_m", "left_phase_rad", 5e-4, 1e-3, 0.02);
  const Hypothesis right = vector_hypothesis("wheel_eccentricity", "right_m", "right_phase_rad", 5e-4, 1e-3, 0.02);
  Hypothesis both = left;
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

}  // namespace

Hypothesis scrub_hypothesis() {
  constexpr double kFriction = 0.15;  // friction of a ball in its socket, or of a swivel
  constexpr double kRubber = 0.05;    // of rubber along its way: a stiffness of twenty times the load
  Hypothesis hypothesis = direct("caster_drag", "on creeping tyres", {positive("coefficient", 0.05, kFriction)});
  hypothesis.with = [](const Eigen::VectorXd&) { return std::vector<Effect>{creeping(kRubber, 0)}; };
  return hypothesis;
}

std::vector<Hypothesis> plain_hypotheses(double period_s, double ticks_per_revolution, double wheel_width_m,
                                         double motor_inertia_kgm2, double mass_kg) {
  const GivesWay motor = motors(motor_inertia_kgm2);
  std::vector<Hypothesis> all = {
      logarithmic("over_acceleration", "factor", 1, 2, -3, 6),
      logarithmic("fast_turning", "factor", 1, 1.5, -3, 4),
      logarithmic("encoder_sampling", "interval_s", period_s, 1, 0, 4),
      // Down to one tick a revolution.
      logarithmic("encoder_resolution", "ticks_per_revolution", ticks_per_revolution, 2,
                  -std::log(ticks_per_revolution), 0),
      direct("wheel_radius_scale", "both", {signed_one("relative", 2e-4, 0.01)}),
      direct("wheel_radius_difference", "right over left", {signed_one("relative", 2e-4, 0.004)}),
      direct("wheelbase", "relative", {signed_one("relative", 5e-4, 0.015)}),
      direct("wheel_misalignment", "right", {signed_one("right_toe_rad", 2e-3, 0.008)}),
      direct("wheel_misalignment", "left", {signed_one("left_toe_rad", 2e-3, 0.008)}),
      direct("wheel_misalignment", "both",
             {signed_one("left_toe_rad", 2e-3, 0.008), signed_one("right_toe_rad", 2e-3, 0.008)}),
      toed_alike(),
      on_soft_tyres(direct("wheel_misalignment", "right", {signed_one("right_toe_rad", 2e-3, 0.008)})),
      on_soft_tyres(direct("wheel_misalignment", "left", {signed_one("left_toe_rad", 2e-3, 0.008)})),
      vector_hypothesis("wheel_eccentricity", "right_m", "right_phase_rad", 5e-4, 1e-3, 0.02),
      vector_hypothesis("wheel_eccentricity", "left_m", "left_phase_rad", 5e-4, 1e-3, 0.02),
      both_eccentric(),
      direct("wear", "right", {signed_one("right_relative_per_run", 2e-5, 1e-3)}),
      direct("wear", "left", {signed_one("left_relative_per_run", 2e-5, 1e-3)}),
      direct("wear", "both",
             {signed_one("left_relative_per_run", 2e-5, 1e-3), signed_one("right_relative_per_run", 2e-5, 1e-3)}),
      direct("backlash", "both", {positive("left_rad", 0.01, 0.03), positive("right_rad", 0.01, 0.03)}),
      direct("motor_response", "lag", {positive("lag_s", 0.05, 0.1)}),
      direct("motor_response", "gain", {signed_one("gain_asymmetry", 0.01, 0.05)}),
      direct("motor_response", "deadband", {positive("deadband_radps", 0.02, 0.05)}),
      direct("motor_response", "droop",
             {positive("droop_radps_per_nm", kGivesWay_s / motor_inertia_kgm2, 2 * kGivesWay_s / motor_inertia_kgm2)}),
      direct("encoder_missed_counts", "right", {positive("right_probability", 1e-3, 0.005)}),
      direct("encoder_missed_counts", "left", {positive("left_probability", 1e-3, 0.005)}),
      both_miss(),
      direct("encoder_missed_counts", "left and right",
             {positive("left_probability", 1e-3, 0.005), positive("right_probability", 1e-3, 0.005)}),
      direct("encoder_missed_counts", "speed", {positive("probability_per_radps", 3e-4, 1e-3)}),
      direct("encoder_latency", "delay", {positive("seconds", 0.02, 0.1)}),
      load(mass_kg),
      felt_through(soft_tyres(), load(mass_kg)),
      direct("tyre_compliance", "both", {positive("metres_per_newton", 5e-7, 3e-6)}),
      costing(kNarrowContact, squared("contact_patch", "width_m", 0.01, 0.03, wheel_width_m)),
      direct("tyre_creep", "along and across", {{"along", 0, 5e-3, 0.02, 0, 0.1}, {"across", 0, 5e-3, 0.02, 0, 0.1}}),
      from_start(direct("caster_swivel", "friction", {positive("friction_nm", 0.1, 0.5)}, {{"trail_m", 0.03}}), 0.3),
      from_start(direct("caster_swivel", "friction of a light robot", {positive("friction_nm", 0.01, 0.05)},
                        {{"trail_m", 0.03}}),
                 0.03),
      from_start(direct("caster_swivel", "askew", {{"initial_angle_rad", 0, 0.3, 2, -3.14, 3.14}},
                        {{"trail_m", 0.03}, {"friction_nm", 0.1}}),
                 1.5),
      felt_through(motor, dry_swivel()),
      direct("caster_drag", "coefficient", {positive("coefficient", 0.02, 0.04)}),
      drag_of_sides(0.04),
      felt_through(motor, drag_of_sides(0.1)),
      felt_through(tyres(), drag_of_sides(0.04)),
      from_start(direct("slippery_floor", "friction", {{"friction", 0, 2e-4, 0.2, 0.01, 0.8}}), 0.06),
      vector_hypothesis("floor_slope", "slope_rad", "downhill_rad", 0.01, 0.02, 0.5),
      felt_through(motor, vector_hypothesis("floor_slope", "slope_rad", "downhill_rad", 0.01, 0.05, 0.5)),
      felt_through(tyres(), vector_hypothesis("floor_slope", "slope_rad", "downhill_rad", 0.01, 0.05, 0.5)),
      vector_hypothesis("carpet_drift", "metres_per_metre", "direction_rad", 1e-3, 0.008, 0.5),
  };
  for (Hypothesis& f : all) {
    const auto same = [&](const Hypothesis& g) { return g.effect == f.effect; };
    f.variant_cost += std::log(double(std::count_if(all.begin(), all.end(), same)));
  }
  return all;
}

}  // namespace umbsim::gap

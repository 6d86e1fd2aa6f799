#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "effects/catalogue.h"
#include "gap/traits/traits.h"

namespace umbsim::gap {

/// One free number of an effect, in coordinates in which it acts nearly linearly (an eccentricity's two components
/// instead of its size and phase).
struct FreeParameter {
  std::string name;
  double start = 0;     ///< where the fit begins
  double step = 0;      ///< of the finite difference
  double prior_sd = 0;  ///< about zero
  double min = 0;
  double max = 0;
};

/// An effect of the catalogue with the numbers that are fitted, the others fixed.
struct Hypothesis {
  std::string effect;
  std::string variant;  ///< which numbers are free, where an effect has several hypotheses
  std::vector<FreeParameter> parameters;
  std::function<EffectValues(const Eigen::VectorXd& p)> values;
  /// Further effects that go with it and are not credited: how softly the tyres grip while they scrub.
  std::function<std::vector<Effect>(const Eigen::VectorXd& p)> with;
  bool from_zero = true;    ///< acts in proportion near zero; false: fitted from its start, by repeated simulation
  double search_cost = 0;   ///< log of the number of places or moments that were looked at
  double variant_cost = 0;  ///< log of the number of hypotheses of the same effect, which are all tried, or of a prior
  int of_others = 0;  ///< how many numbers, the last ones, are of what goes with it; without the first ones it is off
  bool shape_unknown = false;  ///< its numbers say how strong it is, not where: it is named, and added to no twin
  /// Moves numbers that derivatives at zero foretell to the likeliest ones that do the same; may be empty.
  std::function<void(Eigen::VectorXd& p)> likelier = nullptr;
};

/// The effect with everything that goes with it.
std::vector<Effect> effects_of(const Hypothesis& hypothesis, const Eigen::VectorXd& p);

Effect effect_of(const Hypothesis& hypothesis, const Eigen::VectorXd& p);

/// Whether the effect, or what goes with it, shows in counts against commands.
bool shows_in_counts(const Hypothesis& hypothesis);

/// Where the fit of its numbers begins.
Eigen::VectorXd start_of(const Hypothesis& hypothesis);

/// The free numbers of all hypotheses in order, and their prior standard deviations.
std::vector<FreeParameter> free_parameters(const std::vector<Hypothesis>& hypotheses);
Eigen::VectorXd prior_sd_of(const std::vector<Hypothesis>& hypotheses);

/// Every hypothesis of the catalogue that needs no search for a place or moment.
/// `period_s` and `ticks_per_revolution`: of the recording's encoders. `wheel_width_m`: no contact is wider; 0: not
/// known. `motor_inertia_kgm2`: that each motor moves as the robot speeds up. `mass_kg`: of the robot, which loads go
/// by.
std::vector<Hypothesis> plain_hypotheses(double period_s, double ticks_per_revolution, double wheel_width_m = 0,
                                         double motor_inertia_kgm2 = 0.1, double mass_kg = 40);

/// A caster that drags against turning, on tyres that creep along their way: turns on the spot and arcs come out small
/// by shares of their own (docs/calibration.md, scrub). How much it drags is free, about zero.
Hypothesis scrub_hypothesis();

/// Hypotheses of local effects, at a place of the floor or a moment of one run.
/// `heading_rad`: of the robot as it passes; the cable lies across.
Hypothesis bump_hypothesis(double x_m, double y_m, double heading_rad);
Hypothesis lift_hypothesis(double x_m, double y_m);
Hypothesis patch_hypothesis(double x_m, double y_m);
Hypothesis push_hypothesis(const std::string& run, int leg, double seconds_into_leg, double robot_kg);

}  // namespace umbsim::gap

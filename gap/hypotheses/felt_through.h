#pragma once

#include <functional>
#include <string>

#include "gap/hypotheses/hypothesis.h"

namespace umbsim::gap {

/// Something that gives way under a pull or a load, so that it is felt. How much is fitted, about what is typical.
struct GivesWay {
  std::string what;         ///< for the hypothesis' name
  FreeParameter log_times;  ///< logarithm of how many times what is typical
  std::function<Effect(double times)> effect;
};

/// Motors turn otherwise than they are told under a load, as much as they lag when the robot speeds up. Counts tell.
/// `inertia_kgm2`: that each of them moves.
GivesWay motors(double inertia_kgm2);

/// Tyres creep in proportion to the pull and to the way that they roll. Poses tell.
GivesWay tyres();

/// Tyres give way under the wheels' load: a loaded wheel rolls on a smaller radius. Poses tell.
GivesWay soft_tyres();

/// An effect that does nothing but pull or load, felt through what gives way. What is seen is pull times how much gives
/// way, in which it is linear, and hardly either of them: so the numbers of `pull`, which it acts in proportion to, are
/// those that it would have if what gives way were typical. A fit begins where pull and give are as likely as they may
/// be with the product that derivatives foretell.
Hypothesis felt_through(const GivesWay& gives_way, Hypothesis pull);

/// Toed wheels scrub, and how that slows and turns the robot depends on how softly the tyres grip.
Hypothesis on_soft_tyres(Hypothesis hypothesis);

/// A tyre_creep of these shares, which goes with another effect.
Effect creeping(double along, double across);

constexpr double kGivesWay_s = 0.01;  ///< typical time constant of a speed control in proportion

}  // namespace umbsim::gap

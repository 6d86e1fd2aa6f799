#pragma once

#include "core/random.h"
#include "gap/trial/draw/platform.h"

namespace umbsim {

/// How one parameter follows the amplitude a of its effect: offset + weight * a, or weight / a where strong effects
/// have small values (friction, ticks).
struct AmplitudeParameter {
  std::size_t index = 0;  ///< in the catalogue's line
  double weight = 1;
  double offset = 0;
  bool reciprocal = false;
  double grain = 0;  ///< values are whole multiples of this; 0: any
};

/// An effect with everything drawn but its strength: which wheel, which sign, where, when, in which run.
struct DrawnEffect {
  Effect effect;
  std::vector<AmplitudeParameter> amplitude;
  Range range;  ///< of the amplitude: from far below what is plausible up to the plausible maximum
  Range plausible;

  Effect at(double amplitude) const;
};

/// Draws the shape of an effect: places lie on the track of a wheel on a leg or turn of the plain square, a push falls
/// into one named run. Every effect of the catalogue has a line in the table of effect_draws.cpp.
DrawnEffect draw_effect(const EffectInfo& info, const Platform& platform, const std::vector<PlannedRun>& runs,
                        RandomStream& random);

/// Parameters that say how strong an effect is; all others say where, when or which way.
std::vector<std::string> strength_parameters(const std::string& effect);

}  // namespace umbsim

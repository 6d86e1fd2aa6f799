#pragma once

#include <optional>

#include "bench/worlds/run/severity.h"
#include "gap/trial/write/answers.h"

namespace umbsim::worlds {

/// A fault with everything drawn but its strength.
struct DrawnFault {
  std::string name;
  bool of_catalogue = true;
  DrawnEffect effect;      ///< of the catalogue
  OutsideEffect outside;   ///< or outside it
  Range range;             ///< of the strength
  double period_s = 0.02;  ///< of the world's control

  Faults at(double amplitude) const;
};

/// Where the effect has a place it lies on the track of a wheel on the world's own way.
DrawnFault draw_fault(const std::string& name, const World& world, RandomStream& random);

/// A fault at a strength.
struct ScaledFault {
  std::string name;
  Faults faults;
  std::optional<double> drawn = {};  ///< severity that was wanted
  WorldScale::Seen seen;             ///< severity that it has
};

/// Looks for the strength with the wanted severity by driving in the guide.
ScaledFault scale_fault(const DrawnFault& drawn, double wanted, const WorldScale& guide);

/// All of them at once.
Faults all_of(const std::vector<ScaledFault>& faults);

/// Parameters in the frame of the tracker, as a diagnosis can see them.
Json fault_json(const ScaledFault& fault, const Pose2& X_TW);

}  // namespace umbsim::worlds

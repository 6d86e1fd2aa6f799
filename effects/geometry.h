#pragma once

#include "effects/rig.h"

namespace umbsim {

/// Right radius over left radius is 1 + relative; the mean radius stays.
struct WheelRadiusDifference {
  double relative = 0;
};
void apply(const WheelRadiusDifference& effect, Rig& rig);

/// Both radii are 1 + relative times the nominal ones.
struct WheelRadiusScale {
  double relative = 0;
};
void apply(const WheelRadiusScale& effect, Rig& rig);

/// The wheels stand 1 + relative times the nominal wheelbase apart.
struct Wheelbase {
  double relative = 0;
};
void apply(const Wheelbase& effect, Rig& rig);

}  // namespace umbsim

#pragma once

#include <array>

#include "effects/rig.h"

namespace umbsim::worlds {

/// Three robots of one build, from a table top to a warehouse: two wheels and a ball without friction ahead of them.
enum class Size { small, middle, large };
inline constexpr std::array kSizes{Size::small, Size::middle, Size::large};
const char* name(Size size);

/// That robot on a level floor of friction 0.9, with nothing wrong.
Rig plain_rig(Size size, double payload_kg = 0);

}  // namespace umbsim::worlds

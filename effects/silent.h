#pragma once

#include <string>
#include <vector>

#include "effects/catalogue.h"

namespace umbsim {

/// Effects that change nothing of any of these rigs, which are without effects: one sentence for each, with its name
/// and the parameters that would make it act. `rigs`: one for every run, since some act in one run alone.
std::vector<std::string> silent_effects(const std::vector<Effect>& effects, const std::vector<Rig>& rigs);

}  // namespace umbsim

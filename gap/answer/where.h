#pragma once

#include <string>

#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// The pattern of an effect of the catalogue in the data: turns, legs, leg_start, place, wheel_angle, world_direction,
/// one_run, runs, load, reversals, commands.
std::string pattern_of(const std::string& effect);

/// Whether the evidence against a fit goes with the turns, the legs or one run.
LeftOver describe_left_over(const Model& model, const Fit& fit);

/// Stage, pattern and place of the best fit, and the segments of the course that speak against no effect.
void say_where(const Model& model, const Fit& none, const Fit& best, Diagnosis& d);

}  // namespace umbsim::gap

#pragma once

#include "gap/model.h"

namespace umbsim::gap {

/// Log evidence that errors of no particular cause gain on top of a fit: every leg and turn of every run may be longer,
/// more curved or further to one side than predicted, and the heading may ripple with either wheel's angle. What this
/// model finds and no effect does is unknown.
double generic_gain(const Model& model, const Fit& fit);

}  // namespace umbsim::gap

#pragma once

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// Log evidence that errors of no particular cause gain on top of a fit. The best of three models counts:
/// - patterns that all runs of a driving condition share: legs and turns longer or more curved than predicted, the
///   heading rippling with either wheel's angle, a drift over the floor, radii that change from run to run;
/// - radii that differ from run to run by more than they should;
/// - every leg and turn of every run on its own.
/// What one of them finds and no effect does is unknown.
double generic_gain(const Model& model, const Fit& fit);

/// The part of it that goes on while the robot rolls at constant speed: ripples with the wheels' angles, a drift over
/// the floor, radii that change from run to run.
double steady_gain(const Model& model, const Fit& fit);

/// Log evidence that the tracker saw the robot at other moments than its wheels were counted, in another way than by
/// one clock's offset.
double late_gain(const Model& model, const Fit& fit);

}  // namespace umbsim::gap

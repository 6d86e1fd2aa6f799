#pragma once

#include <string>
#include <vector>

#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// How much evidence each leg's start, cruise and stop and each turn of every run gives against the prediction of a
/// fit, most first.
std::vector<SegmentScore> segment_scores(const Model& model, const Fit& fit);

/// The pattern of an effect of the catalogue in the data: turns, legs, leg_start, place, wheel_angle, world_direction,
/// one_run, runs, load, reversals, commands.
std::string pattern_of(const std::string& effect);

/// Whether the evidence against a fit goes with the turns, the legs or one run.
LeftOver describe_left_over(const Model& model, const Fit& fit);

/// Finds the place of a cable or a patch, or where the robot was when it was pushed.
void find_place(const Model& model, const Fit& fit, Diagnosis& d);

/// The wheel that passes a place of the floor, "left" or "right"; empty if both do, or neither.
std::string wheel_at(const Model& model, double x_m, double y_m);

}  // namespace umbsim::gap

#pragma once

#include <nlohmann/json.hpp>

#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// What a page needs to draw a diagnosis: for each run the recorded positions, those that the scenario predicts
/// (`before`) and those of the first cause's twin (`after`, where there is one), thinned out, in metres; the parts that
/// score, as indices into them; the errors at the end (robot's start frame, metres and radians). Predictions begin
/// where they explain the run best: start pose and frame belong to nobody.
nlohmann::ordered_json tracks_json(const Model& model, const Diagnosis& diagnosis);

}  // namespace umbsim::gap

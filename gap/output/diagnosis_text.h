#pragma once

#include "gap/plan/ties.h"

namespace umbsim::gap {

/// The diagnosis for a reader at a terminal: what was found and where, and at its end the verdict in plain words.
std::string diagnosis_text(const Diagnosis& diagnosis, const std::vector<NextExperiment>& next);

}  // namespace umbsim::gap

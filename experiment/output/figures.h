#pragma once

#include <vector>

#include "batch/condition.h"
#include "experiment/scenario/figure_names.h"

namespace umbsim {

struct ExperimentResult;

/// The figures of one experiment in the order of figure_names(); nothing where it has no such figure.
std::vector<Cell> figures_of(const ExperimentResult& result);

}  // namespace umbsim

#pragma once

#include <string>
#include <vector>

#include "batch/condition.h"

namespace umbsim {

struct ExperimentResult;

/// Every number that summary.json can hold, by its key path (`umbmark.cw.r_cg_m`), in the order of the file. Left out
/// is what says which experiment it is (`seed`), and the time on the clock, which no two runs share.
const std::vector<std::string>& figure_names();

/// The figures of one experiment in the order of figure_names(); nothing where it has no such figure.
std::vector<Cell> figures_of(const ExperimentResult& result);

}  // namespace umbsim

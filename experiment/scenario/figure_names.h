#pragma once

#include <string>
#include <vector>

namespace umbsim {

/// Every number that summary.json can hold, by its key path (`umbmark.cw.r_cg_m`), in the order of the file. Left out
/// is what says which experiment it is (`seed`), and the time on the clock, which no two runs share. Made in
/// experiment/output/figures.cpp, from a result that has everything; declared here for those who only ask by name.
const std::vector<std::string>& figure_names();

}  // namespace umbsim

#pragma once

#include <string>
#include <vector>

namespace umbsim::worlds {

/// Root mean square and, in brackets, median size of some figures, each over `per_unit`. Empty if there are none.
std::string spread(const std::vector<double>& figures, double per_unit, int digits);

}  // namespace umbsim::worlds

#pragma once

#include <string>
#include <vector>

namespace umbsim::worlds {

/// One bar: which pair of engines, which part of the course, how many radians.
struct DifferenceBar {
  std::string pair;
  std::string part;
  double heading_rad = 0;
};

/// Differences of heading on a logarithmic axis, a row for each pair, a colour for each part, as an SVG picture.
std::string difference_picture(const std::vector<DifferenceBar>& bars);

}  // namespace umbsim::worlds

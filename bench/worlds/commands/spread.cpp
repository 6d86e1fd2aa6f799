#include "bench/worlds/commands/spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::worlds {

std::string spread(const std::vector<double>& figures, double per_unit, int digits) {
  if (figures.empty()) return "";
  double squares = 0;
  std::vector<double> sizes;
  for (const double f : figures) {
    squares += f * f;
    sizes.push_back(std::abs(f));
  }
  const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return fmt::format("{:.{}f} ({:.{}f})", std::sqrt(squares / double(figures.size())) / per_unit, digits,
                     *middle / per_unit, digits);
}

}  // namespace umbsim::worlds

#pragma once

#include <array>
#include <string>
#include <vector>

namespace umbsim::bench {

/// How one method found one figure over all robots, in parts of ten thousand.
struct FigureScore {
  int robots = 0;  ///< in which the method gave it
  double bias = 0;
  double bias_se = 0;
  double spread = 0;   ///< standard deviation of the error
  double covered = 0;  ///< share of 95 % intervals that hold the truth
  int intervals = 0;
};

struct MethodScore {
  std::string name;
  std::array<FigureScore, 3> figures;  ///< E_d, E_b, mean radius
};

extern const std::array<const char*, 3> kFigures;

/// A table of bias, spread and coverage in Markdown.
std::string score_table(const std::vector<MethodScore>& scores);

/// Bias as a dot and two standard deviations of the error as a bar, for each method and figure: an SVG picture.
std::string score_picture(const std::vector<MethodScore>& scores);

}  // namespace umbsim::bench

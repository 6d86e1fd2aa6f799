#pragma once

#include <string>
#include <vector>

namespace umbsim::bench {

/// One setting of one engine.
struct PlotPoint {
  std::string engine;
  double sim_s_per_s = 0;
  double error_mm = 0;
};

/// Return error against speed on logarithmic axes, a line for each engine, as an SVG picture.
std::string accuracy_plot(const std::vector<PlotPoint>& points);

}  // namespace umbsim::bench

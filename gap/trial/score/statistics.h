#pragma once

#include <cstdint>
#include <vector>

namespace umbsim {

/// A figure with its 95 % interval.
struct Estimate {
  double value = 0;
  double low = 0;
  double high = 0;
};

/// k of n, with the Clopper-Pearson interval. n = 0: value 0, interval [0, 1].
Estimate share(int k, int n);

/// Upper 95 % bound of a share (one-sided, Clopper-Pearson).
double upper_bound(int k, int n);

/// Median with the percentile interval of a bootstrap. Deterministic. Throws std::invalid_argument if empty.
Estimate median(std::vector<double> values);

double middle(std::vector<double> values);

}  // namespace umbsim

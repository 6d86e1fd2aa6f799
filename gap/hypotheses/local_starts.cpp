#include "gap/hypotheses/local_starts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace umbsim::gap {
namespace {

constexpr double kAside = 0.55;  // of a patch's radius

std::vector<double> geometric(double from, double to, double ratio) {
  std::vector<double> all;
  for (double x = from; x <= to; x *= ratio) all.push_back(x);
  return all;
}

std::vector<double> both_ways(std::vector<double> sizes) {
  const std::size_t n = sizes.size();
  for (std::size_t i = 0; i < n; ++i) sizes.push_back(-sizes[i]);
  return sizes;
}

// Every combination of the values of each number.
Starts all_of(const std::vector<std::vector<double>>& values) {
  std::vector<std::vector<double>> all{{}};
  for (const std::vector<double>& next : values) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& some : all) {
      for (const double x : next) {
        longer.push_back(some);
        longer.back().push_back(x);
      }
    }
    all = std::move(longer);
  }
  Starts starts;
  for (const std::vector<double>& x : all) {
    starts.push_back(Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size())));
  }
  return starts;
}

void append(Starts& starts, const Starts& more) { starts.insert(starts.end(), more.begin(), more.end()); }

}  // namespace

Starts cable_starts(double lost_m, double wheel_radius_m) {
  // Closed form of a cable that costs a wheel this distance.
  const double height_m = std::clamp(0.5 * std::pow(3 * std::sqrt(wheel_radius_m) * lost_m, 2.0 / 3), 0.001, 0.02);
  std::vector<double> heights;
  for (const double share : {0.5, 0.7, 1.0, 1.4, 2.0}) heights.push_back(std::clamp(share * height_m, 0.001, 0.02));
  return all_of({heights, {-0.03, -0.015, 0, 0.015, 0.03}});
}

Starts lift_starts(bool closely) {
  const std::vector<double> few{-0.04, 0, 0.04};
  const std::vector<double> close{-0.06, -0.04, -0.02, 0, 0.02, 0.04, 0.06};
  const std::vector<double> wide{-0.05, -0.025, 0, 0.025, 0.05};
  const std::vector<double> fine{-0.03, -0.02, -0.01, 0, 0.01, 0.02, 0.03};
  Starts starts = all_of({geometric(0.012, 0.06, 1.4), closely ? close : few, closely ? close : few});
  append(starts, all_of({geometric(0.065, 0.25, 1.4), closely ? wide : few, closely ? wide : few}));
  if (closely) append(starts, all_of({geometric(0.012, 0.028, 1.2), fine, fine}));
  return starts;
}

Starts patch_starts(double grips, bool closely) {
  Starts starts = all_of({geometric(0.4 * grips, 1.05 * grips, 1.05), {0.1, 0.3}, {0}, {0}});
  if (!closely) return starts;
  // Where a wheel felt it lies somewhere in it.
  for (const double radius_m : {0.06, 0.1, 0.16, 0.25, 0.4}) {
    const std::vector<double> about{-kAside * radius_m, 0, kAside * radius_m};
    append(starts, all_of({geometric(0.4 * grips, 1.05 * grips, 1.12), {radius_m}, about, about}));
  }
  return starts;
}

Starts push_starts(double robot_kg) {
  return all_of({both_ways(geometric(0.06 * robot_kg, 4 * robot_kg, 1.1)), {0, 0.05, 0.1}});
}

}  // namespace umbsim::gap

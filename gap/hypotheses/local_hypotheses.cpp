// What happens at one place or moment.
#include <algorithm>
#include <cmath>

#include "gap/hypotheses/parametrisations.h"

namespace umbsim::gap {
namespace {

// Logarithms of how many places on the path, and moments of the runs, were tried.
constexpr double kPlaces = 7;
constexpr double kMoments = 9;
constexpr double kPlacesApart = 4;  // places so far apart that none is in reach of another's fit

Hypothesis searched(Hypothesis hypothesis, double cost) {
  hypothesis.search_cost = cost;
  return hypothesis;
}

}  // namespace

Hypothesis bump_hypothesis(double x_m, double y_m, double heading_rad) {
  const EffectInfo& info = find_effect("bump");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t h = index_of(info, "height_m");
  const std::size_t x = index_of(info, "x_m");
  const std::size_t y = index_of(info, "y_m");
  const std::size_t d = index_of(info, "direction_rad");
  Hypothesis hypothesis{"bump",
                        "height and place",
                        {{"height_m", 0.005, 5e-4, 0.008, 5e-4, 0.02}, {"further along m", 0, 0.004, 0.03, -0.1, 0.1}},
                        {},
                        {},
                        false,
                        kPlaces};
  hypothesis.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[h] = p[0];
    values.numbers[x] = x_m + p[1] * std::cos(heading_rad);
    values.numbers[y] = y_m + p[1] * std::sin(heading_rad);
    values.numbers[d] = std::remainder(heading_rad + M_PI / 2, M_PI);
    return values;
  };
  return hypothesis;
}

namespace {

// A coordinate of the place, seen from where the search begins.
FreeParameter coordinate(const char* name) { return {name, 0, 0.005, 0.15, -0.6, 0.6}; }

// The last two numbers are a place.
Hypothesis placed(Hypothesis hypothesis, double x_m, double y_m) {
  const Eigen::Index own = Eigen::Index(hypothesis.parameters.size()) - 2;
  const auto values = hypothesis.values;
  hypothesis.values = [values, own, x_m, y_m](const Eigen::VectorXd& p) {
    Eigen::VectorXd at = p;
    at[own] += x_m;
    at[own + 1] += y_m;
    return values(at);
  };
  hypothesis.from_zero = false;
  return searched(std::move(hypothesis), kPlacesApart);
}

}  // namespace

Hypothesis lift_hypothesis(double x_m, double y_m) {
  return placed(direct("wheel_lift", "length and place",
                       {{"length_m", 0.06, 0.005, 0.1, 0.002, 0.4}, coordinate("x_m"), coordinate("y_m")}),
                x_m, y_m);
}

Hypothesis patch_hypothesis(double x_m, double y_m) {
  return placed(direct("slippery_patch", "friction, radius and place",
                       {{"friction", 0.03, 0.002, 0.2, 0.01, 0.8},
                        {"radius_m", 0.3, 0.02, 0.4, 0.03, 1.5},
                        coordinate("x_m"),
                        coordinate("y_m")}),
                x_m, y_m);
}

Hypothesis push_hypothesis(const std::string& run, int leg, double seconds_into_leg, double robot_kg) {
  const EffectInfo& info = find_effect("push");
  const EffectValues base = neutral_effect(info).values;
  const std::size_t l = index_of(info, "leg");
  const std::size_t t = index_of(info, "seconds_into_leg");
  const std::size_t i = index_of(info, "impulse_newton_seconds");
  Hypothesis hypothesis{
      "push",
      run,
      {{"impulse_newton_seconds", 0.75 * robot_kg, 0.025 * robot_kg, 1.5 * robot_kg, -25 * robot_kg, 25 * robot_kg},
       {"later s", 0, 0.02, 0.2, -0.6, 0.6}},
      {},
      {},
      false,
      kMoments};
  hypothesis.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.run = run;
    values.numbers[l] = leg;
    values.numbers[t] = std::max(0.0, seconds_into_leg + p[1]);
    values.numbers[i] = p[0];
    return values;
  };
  return hypothesis;
}

}  // namespace umbsim::gap

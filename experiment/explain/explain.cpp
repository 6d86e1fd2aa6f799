#include "experiment/explain/explain.h"

#include <cmath>

#include "experiment/run.h"

namespace umbsim {
namespace {

// The centroids of the scenario's plain runs with these effects.
Contributions return_errors_with(const Scenario& scenario, const std::vector<Effect>& effects, int jobs) {
  Scenario s = scenario;
  s.effects = effects;
  s.bumps = {};
  s.calibration.method = Calibrate::none;
  const ExperimentResult r = run_experiment(s, jobs, true, {Rows::To::nowhere, {}});
  Contributions result;
  for (const auto& [c, direction] : {std::pair{&r.cw, Direction::cw}, std::pair{&r.ccw, Direction::ccw}}) {
    if (!c->errors.empty()) result[direction] = {c->centroid_x_m, c->centroid_y_m, c->heading_rad};
  }
  return result;
}

Contributions difference(const Contributions& a, const Contributions& b) {
  Contributions result;
  for (const auto& [direction, value] : a) result[direction] = value - b.at(direction);
  return result;
}

void add(Contributions& sum, const Contributions& more) {
  for (const auto& [direction, value] : more) sum[direction] = sum[direction] + value;
}

std::vector<Effect> all_but(std::vector<Effect> effects, std::size_t i) {
  effects.erase(effects.begin() + std::ptrdiff_t(i));
  return effects;
}

}  // namespace

double Contribution::distance_m() const { return std::hypot(x_m, y_m); }
Contribution Contribution::operator+(const Contribution& o) const {
  return {x_m + o.x_m, y_m + o.y_m, heading_rad + o.heading_rad};
}
Contribution Contribution::operator-(const Contribution& o) const {
  return {x_m - o.x_m, y_m - o.y_m, heading_rad - o.heading_rad};
}

Explanation explain(const Scenario& scenario, int jobs) {
  const std::vector<Effect>& effects = scenario.effects;
  Explanation e;
  e.whole = return_errors_with(scenario, effects, jobs);
  e.baseline = effects.empty() ? e.whole : return_errors_with(scenario, {}, jobs);
  for (const auto& [direction, value] : e.baseline) e.sum_alone[direction] = {};
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const bool only = effects.size() == 1;
    const Contributions alone = only ? e.whole : return_errors_with(scenario, {effects[i]}, jobs);
    const Contributions without = only ? e.baseline : return_errors_with(scenario, all_but(effects, i), jobs);
    e.effects.push_back({effects[i].info->name, difference(alone, e.baseline), difference(e.whole, without)});
    add(e.sum_alone, e.effects.back().alone);
  }
  e.interaction = difference(difference(e.whole, e.baseline), e.sum_alone);
  return e;
}

}  // namespace umbsim

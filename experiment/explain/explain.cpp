#include "experiment/explain/explain.h"

#include <cmath>
#include <iterator>
#include <set>

#include "experiment/run.h"

namespace umbsim {
namespace {

struct Driven {
  Contributions errors;  // centroids of the plain runs
  std::vector<ExplainedRun> runs;
};

// The scenario's plain runs with these effects.
Driven drive_with(const Scenario& scenario, const std::vector<Effect>& effects, const std::string& with, int jobs) {
  Scenario s = scenario;
  s.effects = effects;
  s.bumps = {};
  s.calibration.method = Calibrate::none;
  const ExperimentResult r = run_experiment(s, jobs, true, {Rows::To::nowhere, {}});
  Driven driven;
  for (const auto& [c, direction] : {std::pair{&r.cw, Direction::cw}, std::pair{&r.ccw, Direction::ccw}}) {
    if (!c->errors.empty()) driven.errors[direction] = {c->centroid_x_m, c->centroid_y_m, c->heading_rad};
  }
  std::set<std::string> seen;
  for (std::size_t i = 0; i < r.digests.size(); ++i) {
    const RecordedRun& run = r.recording.runs[i];
    if (seen.insert(run.direction).second) driven.runs.push_back({with, run.id, run.direction, r.digests[i]});
  }
  return driven;
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
  const auto drive = [&](const std::vector<Effect>& some, const std::string& with) {
    Driven driven = drive_with(scenario, some, with, jobs);
    if (!with.empty()) std::move(driven.runs.begin(), driven.runs.end(), std::back_inserter(e.runs));
    return driven.errors;
  };
  e.whole = drive(effects, "all effects");
  e.baseline = effects.empty() ? e.whole : drive({}, "no effect");
  for (const auto& [direction, value] : e.baseline) e.sum_alone[direction] = {};
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const bool only = effects.size() == 1;
    const Contributions alone = only ? e.whole : drive({effects[i]}, effects[i].info->name + " alone");
    const Contributions without = only ? e.baseline : drive(all_but(effects, i), "");
    e.effects.push_back({effects[i].info->name, difference(alone, e.baseline), difference(e.whole, without)});
    add(e.sum_alone, e.effects.back().alone);
  }
  e.interaction = difference(difference(e.whole, e.baseline), e.sum_alone);
  return e;
}

}  // namespace umbsim

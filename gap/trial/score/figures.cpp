#include "gap/trial/score/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gap/trial/draw/severity.h"

namespace umbsim {
namespace {

using Filter = std::function<bool(const Verdict&)>;

// Bars of the same simulator (README of the trial: docs/trial.md).
struct ShareLine {
  const char* key;
  const char* text;
  Filter among;
  Filter hit;
  double at_least;  // NaN: no bar
};

constexpr double kNoBar = std::numeric_limits<double>::quiet_NaN();
constexpr double kMaxFalseAlarm = 0.05;
constexpr double kMaxKnownCalledUnknown = 0.10;
constexpr double kMaxSetSize = 2;
constexpr double kMaxParameterError = 0.15;
constexpr double kMinCoverage = 0.88, kMaxCoverage = 0.99;
constexpr double kMinClosure = 0.9;
constexpr double kMaxUncachedTime_s = 300;

// Every effect alone would be among the figures; a case made elsewhere, of unknown severity, is taken to be.
bool all_detectable(const Answer& answer) {
  return !answer.undetectable_expected && std::all_of(answer.effects.begin(), answer.effects.end(), [](const auto& e) {
    return e.second.severity.value_or(kLeastSeverity) >= kLeastSeverity;
  });
}

bool is(const Verdict& v, Tier tier) { return v.answer.tier == tier; }

const std::vector<ShareLine>& share_lines() {
  static const std::vector<ShareLine> lines = {
      {"first_cause_right", "first cause right, among distinguishable effects",
       [](const Verdict& v) { return single_and_detectable(v) && v.distinguishable; },
       [](const Verdict& v) { return v.right; }, 0.90},
      {"first_cause_right_all", "  the same among all effects", single_and_detectable,
       [](const Verdict& v) { return v.right; }, kNoBar},
      {"first_cause_right_or_tied", "  right or predicted to be tied", single_and_detectable,
       [](const Verdict& v) { return v.right_or_tied; }, kNoBar},
      {"truth_in_set", "truth in the reported set", single_and_detectable, [](const Verdict& v) { return v.in_set; },
       0.95},
      {"outside_called_unknown", "effect outside the catalogue called unknown",
       [](const Verdict& v) { return is(v, Tier::outside) && !v.answer.undetectable_expected; },
       [](const Verdict& v) { return v.unknown; }, 0.80},
      {"outside_unknown_or_tied", "  called unknown, or an effect predicted to be tied",
       [](const Verdict& v) { return is(v, Tier::outside) && !v.answer.undetectable_expected; },
       [](const Verdict& v) { return v.unknown || v.right_or_tied; }, kNoBar},
      {"stage_right", "stage right", single_and_detectable,
       [](const Verdict& v) { return v.stage_right.value_or(false); }, 0.90},
      {"location_right", "leg, turn, place or run right",
       [](const Verdict& v) { return single_and_detectable(v) && v.location_right.has_value(); },
       [](const Verdict& v) { return *v.location_right; }, 0.80},
      {"pair_both", "two effects, both to be seen: both in one member of the set",
       [](const Verdict& v) { return is(v, Tier::pairs) && all_detectable(v.answer); },
       [](const Verdict& v) { return v.both_in_set; }, 0.70},
      {"pair_both_all", "  the same where at least one can be seen",
       [](const Verdict& v) { return is(v, Tier::pairs) && !v.answer.undetectable_expected; },
       [](const Verdict& v) { return v.both_in_set; }, kNoBar},
      {"pair_one", "two effects: at least one in the set",
       [](const Verdict& v) { return is(v, Tier::pairs) && !v.answer.undetectable_expected; },
       [](const Verdict& v) { return v.one_in_set; }, 0.95},
      {"end_points_right_or_tied", "end points only: right or tied",
       [](const Verdict& v) { return is(v, Tier::end_points) && !v.answer.undetectable_expected; },
       [](const Verdict& v) { return v.right_or_tied; }, kNoBar},
      {"poor_runs_right_or_tied", "poor set of runs: right or tied",
       [](const Verdict& v) { return is(v, Tier::poor_runs) && !v.answer.undetectable_expected; },
       [](const Verdict& v) { return v.right_or_tied; }, kNoBar},
  };
  return lines;
}

Figure::Met met(int cases, bool yes) {
  if (cases == 0) return Figure::Met::no_cases;
  return yes ? Figure::Met::yes : Figure::Met::no;
}

Figure share_figure(const char* key, const char* text, int hits, int cases) {
  Figure f{key, text, "share", share(hits, cases), hits, cases, "", Figure::Met::no_bar};
  if (cases == 0) f.met = Figure::Met::no_cases;
  return f;
}

Figure share_figure(const ShareLine& line, const std::vector<Verdict>& verdicts) {
  int hits = 0, cases = 0;
  for (const Verdict& v : verdicts) {
    if (!line.among(v)) continue;
    ++cases;
    hits += line.hit(v);
  }
  Figure f = share_figure(line.key, line.text, hits, cases);
  if (!std::isnan(line.at_least)) {
    f.bar = fmt::format(">= {:.0f} %", 100 * line.at_least);
    f.met = met(cases, f.estimate.value >= line.at_least);
  }
  return f;
}

Figure false_alarms(const std::vector<Verdict>& verdicts) {
  int hits = 0, cases = 0;
  for (const Verdict& v : verdicts) {
    if (!is(v, Tier::no_effect)) continue;
    ++cases;
    hits += v.detected;
  }
  Figure f = share_figure("false_alarm", "false alarm where there is no effect", hits, cases);
  const double bound = upper_bound(hits, cases);
  f.bar = fmt::format("<= {:.0f} %, where the one-sided 95 % bound is {:.1f} %", 100 * kMaxFalseAlarm, 100 * bound);
  f.met = met(cases, bound <= kMaxFalseAlarm);
  return f;
}

Figure known_called_unknown(const std::vector<Verdict>& verdicts) {
  int hits = 0, cases = 0;
  for (const Verdict& v : verdicts) {
    if (!is(v, Tier::single)) continue;
    ++cases;
    hits += v.unknown;
  }
  Figure f = share_figure("known_called_unknown", "  a known effect called unknown", hits, cases);
  f.bar = fmt::format("<= {:.0f} %", 100 * kMaxKnownCalledUnknown);
  f.met = met(cases, f.estimate.value <= kMaxKnownCalledUnknown);
  return f;
}

Figure median_figure(const char* key, const char* text, const char* unit, const std::vector<double>& values,
                     const std::string& bar, const std::function<bool(double)>& good) {
  Figure f{key, text, unit, {}, 0, int(values.size()), bar, met(int(values.size()), false)};
  if (values.empty()) return f;
  f.estimate = median(values);
  f.met = bar.empty() ? Figure::Met::no_bar : met(f.cases, good(f.estimate.value));
  return f;
}

Figure set_size(const std::vector<Verdict>& verdicts) {
  std::vector<double> sizes;
  for (const Verdict& v : verdicts) {
    if (single_and_detectable(v) && !v.failed) sizes.push_back(double(v.diagnosis.set.size()));
  }
  return median_figure("set_size", "  median size of the set", "effects", sizes, "<= 2",
                       [](double m) { return m <= kMaxSetSize; });
}

Figure parameter_error(const std::vector<Verdict>& verdicts) {
  std::vector<double> errors;
  for (const Verdict& v : verdicts) {
    if (!single_and_detectable(v)) continue;
    for (const ParameterVerdict& p : v.parameters) errors.push_back(p.relative_error);
  }
  return median_figure("parameter_error", "parameter: median relative error", "ratio", errors, "<= 15 %",
                       [](double m) { return m <= kMaxParameterError; });
}

Figure parameter_coverage(const std::vector<Verdict>& verdicts) {
  int hits = 0, cases = 0;
  for (const Verdict& v : verdicts) {
    if (!single_and_detectable(v)) continue;
    for (const ParameterVerdict& p : v.parameters) {
      ++cases;
      hits += p.covered;
    }
  }
  Figure f = share_figure("parameter_coverage", "  coverage of the 95 % intervals", hits, cases);
  f.bar = fmt::format("{:.0f} to {:.0f} %", 100 * kMinCoverage, 100 * kMaxCoverage);
  f.met = met(cases, f.estimate.value >= kMinCoverage && f.estimate.value <= kMaxCoverage);
  return f;
}

std::vector<double> closures(const std::vector<Verdict>& verdicts) {
  std::vector<double> values;
  for (const Verdict& v : verdicts) {
    const bool has_effect = single_and_detectable(v) || is(v, Tier::pairs);
    if (has_effect && v.detected && !v.failed && v.diagnosis.closure) values.push_back(*v.diagnosis.closure);
  }
  return values;
}

Figure closure(const std::vector<Verdict>& verdicts) {
  return median_figure("closure", "closure on held-out runs, median", "ratio", closures(verdicts), ">= 0.9",
                       [](double m) { return m >= kMinClosure; });
}

Figure closure_below_zero(const std::vector<Verdict>& verdicts) {
  const std::vector<double> values = closures(verdicts);
  const int below = int(std::count_if(values.begin(), values.end(), [](double c) { return c < 0; }));
  Figure f = share_figure("closure_below_zero", "  closure below 0", below, int(values.size()));
  f.bar = "never";
  f.met = met(f.cases, below == 0);
  return f;
}

Figure wall_time(const std::vector<Verdict>& verdicts) {
  std::vector<double> times;
  for (const Verdict& v : verdicts) times.push_back(v.wall_s);
  return median_figure("wall_s", "time for one diagnosis, median", "s", times, "", {});
}

Figure longest_time(const std::vector<Verdict>& verdicts) {
  Figure f{"wall_max_s", "  the longest", "s", {}, 0, int(verdicts.size()), "<= 300 s (signatures not cached)",
           Figure::Met::no_cases};
  for (const Verdict& v : verdicts) f.estimate.value = std::max(f.estimate.value, v.wall_s);
  f.estimate.low = f.estimate.high = f.estimate.value;
  f.met = met(f.cases, f.estimate.value <= kMaxUncachedTime_s);
  return f;
}

}  // namespace

const char* name(Figure::Met met) {
  constexpr const char* kNames[] = {"", "no cases", "met", "missed"};
  return kNames[int(met)];
}

bool single_and_detectable(const Verdict& v) { return is(v, Tier::single) && !v.answer.undetectable_expected; }

std::vector<Figure> figures(const std::vector<Verdict>& verdicts) {
  std::vector<Figure> table{false_alarms(verdicts)};
  for (const ShareLine& line : share_lines()) {
    table.push_back(share_figure(line, verdicts));
    const std::string key = line.key;
    if (key == "truth_in_set") table.push_back(set_size(verdicts));
    if (key == "outside_unknown_or_tied") table.push_back(known_called_unknown(verdicts));
    if (key == "location_right") {
      table.push_back(parameter_error(verdicts));
      table.push_back(parameter_coverage(verdicts));
      table.push_back(closure(verdicts));
      table.push_back(closure_below_zero(verdicts));
    }
  }
  table.push_back(wall_time(verdicts));
  table.push_back(longest_time(verdicts));
  return table;
}

}  // namespace umbsim

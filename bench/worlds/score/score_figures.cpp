#include <algorithm>
#include <cmath>

#include "bench/worlds/score/score.h"
#include "gap/trial/score/tallies.h"

namespace umbsim::worlds {
namespace {

constexpr double kKnownRejected = 0.05;
constexpr double kWorthNaming = 0.5;  // noise floors
constexpr double kPlain = 1;          // noise floors
constexpr double kClosed = 0.7;

using Cases = std::vector<const WorldVerdict*>;

template <class Among, class Hit>
Figure share_of(const Cases& cases, const char* key, Among among, Hit hit) {
  int n = 0, k = 0;
  for (const WorldVerdict* v : cases) {
    if (!among(*v)) continue;
    ++n;
    k += hit(*v);
  }
  Figure f;
  f.key = key;
  f.unit = "share";
  f.estimate = share(k, n);
  f.hits = k;
  f.cases = n;
  return f;
}

struct Leanings {
  std::vector<double> unknown;  // of effects that the diagnosis cannot know
  std::vector<double> known;
};

Leanings leanings(const Cases& cases) {
  Leanings l;
  for (const WorldVerdict* v : cases) {
    if (!v->visible() || v->verdict.failed) continue;
    if (v->kind == "outside" || v->kind == "excluded") l.unknown.push_back(v->unknown);
    if (v->kind == "single") l.known.push_back(v->unknown);
  }
  std::sort(l.known.begin(), l.known.end(), std::greater<>());
  return l;
}

// Called unknown from the lowest threshold on at which no more than a twentieth of the known ones are.
Figure recall(const Leanings& l) {
  const std::size_t allowed = std::size_t(std::floor(kKnownRejected * double(l.known.size())));
  const double threshold = l.known.empty() ? 0 : l.known[std::min(allowed, l.known.size() - 1)];
  int k = 0;
  for (const double u : l.unknown) k += u > threshold;
  Figure f;
  f.key = "unknown_recall";
  f.unit = "share";
  f.cases = l.known.empty() ? 0 : int(l.unknown.size());
  f.hits = f.cases ? k : 0;
  f.estimate = share(f.hits, f.cases);
  return f;
}

// Probability that an unknown effect leans more to "unknown" than a known one; interval after Hanley & McNeil 1982.
Figure area(const Leanings& l) {
  Figure f;
  f.key = "unknown_area";
  f.unit = "ratio";
  const double n = double(l.unknown.size()), m = double(l.known.size());
  f.cases = int(std::min(n, m));
  if (f.cases == 0) return f;
  double sum = 0;
  for (const double u : l.unknown)
    for (const double k : l.known) sum += u > k ? 1 : (u == k ? 0.5 : 0);
  const double a = sum / (n * m), q1 = a / (2 - a), q2 = 2 * a * a / (1 + a);
  const double variance = (a * (1 - a) + (n - 1) * (q1 - a * a) + (m - 1) * (q2 - a * a)) / (n * m);
  const double half = 1.96 * std::sqrt(std::max(0.0, variance));
  f.estimate = {a, std::max(0.0, a - half), std::min(1.0, a + half)};
  return f;
}

Figure median_of(const char* key, const char* unit, const std::vector<double>& values) {
  Figure f;
  f.key = key;
  f.unit = unit;
  f.cases = int(values.size());
  if (f.cases) f.estimate = median(values);
  return f;
}

std::vector<double> times_s(const Cases& cases) {
  std::vector<double> times;
  for (const WorldVerdict* v : cases) times.push_back(v->verdict.wall_s);
  return times;
}

Figure longest(const Cases& cases) {
  Figure f;
  f.key = "longest_s";
  f.unit = "s";
  f.cases = int(cases.size());
  for (const double s : times_s(cases)) f.estimate.value = std::max(f.estimate.value, s);
  f.estimate.low = f.estimate.high = f.estimate.value;
  return f;
}

// Of the numbers of right causes, each with its interval.
Figure coverage(const Cases& cases) {
  int n = 0, k = 0;
  for (const WorldVerdict* v : cases) {
    if (v->kind != "single" || !v->visible()) continue;
    n += int(v->verdict.parameters.size());
    k += int(std::count_if(v->verdict.parameters.begin(), v->verdict.parameters.end(),
                           [](const ParameterVerdict& p) { return p.covered; }));
  }
  Figure f;
  f.key = "covered";
  f.unit = "share";
  f.estimate = share(k, n);
  f.hits = k;
  f.cases = n;
  return f;
}

// How far stated probabilities of first causes are from the shares of right ones, mean over the bins of their curve.
Figure calibration_error(const Cases& cases) {
  std::vector<Verdict> verdicts;
  for (const WorldVerdict* v : cases) {
    if (v->visible() && !v->verdict.failed) verdicts.push_back(v->verdict);
  }
  Figure f;
  f.key = "calibration";
  f.unit = "ratio";
  f.cases = int(verdicts.size());
  for (const CalibrationBin& bin : calibration_curve(verdicts)) {
    const double off = bin.mean_probability * bin.cases - bin.right;
    f.estimate.value += std::abs(off) / std::max(1, f.cases);
  }
  f.estimate.low = f.estimate.high = f.estimate.value;
  return f;
}

}  // namespace

bool WorldVerdict::all_named() const {
  const EffectNames named = split(verdict.named);
  return std::all_of(verdict.answer.effects.begin(), verdict.answer.effects.end(),
                     [&](const auto& e) { return named.count(e.first) > 0; });
}

bool WorldVerdict::names_more() const {
  return std::any_of(not_there.begin(), not_there.end(), [](double worth) { return worth > kWorthNaming; });
}

bool WorldVerdict::names_true() const {
  const EffectNames named = split(verdict.named);
  return std::any_of(verdict.answer.effects.begin(), verdict.answer.effects.end(),
                     [&](const auto& e) { return named.count(e.first) > 0; });
}

bool WorldVerdict::is_plain() const {
  return visible() && verdict.distinguishable && verdict.answer.severity().value_or(kPlain) >= kPlain;
}

WorldFigures world_figures(const Cases& cases) {
  WorldFigures f;
  f.cases = int(cases.size());
  for (const WorldVerdict* v : cases) {
    f.undetectable += !v->visible();
    f.failed += v->verdict.failed;
  }
  const auto shows = [](const WorldVerdict& v) { return v.known() && v.visible(); };
  f.false_alarm = share_of(
      cases, "false_alarm", [](const WorldVerdict& v) { return v.kind == "none"; },
      [](const WorldVerdict& v) { return v.verdict.detected; });
  f.pose_alarm = share_of(
      cases, "pose_alarm", [](const WorldVerdict& v) { return v.kind == "none"; },
      [](const WorldVerdict& v) { return v.names_more(); });
  f.quiet_alarm = share_of(
      cases, "quiet_alarm", [](const WorldVerdict& v) { return v.kind == "none" && v.of_the_world < kWorthNaming; },
      [](const WorldVerdict& v) { return v.verdict.detected; });
  f.right = share_of(
      cases, "right", [](const WorldVerdict& v) { return v.kind == "single" && v.visible(); },
      [](const WorldVerdict& v) { return v.verdict.right; });
  f.plain = share_of(
      cases, "plain", [](const WorldVerdict& v) { return v.kind == "single" && v.is_plain(); },
      [](const WorldVerdict& v) { return v.verdict.right; });
  f.both = share_of(
      cases, "both", [](const WorldVerdict& v) { return v.kind == "pair" && v.visible(); },
      [](const WorldVerdict& v) { return v.verdict.right; });
  f.named = share_of(cases, "named", shows, [](const WorldVerdict& v) { return v.all_named(); });
  f.in_set = share_of(cases, "in_set", shows, [](const WorldVerdict& v) { return v.verdict.both_in_set; });
  f.only_true =
      share_of(cases, "only_true", shows, [](const WorldVerdict& v) { return v.names_true() && !v.names_untrue(); });
  f.not_there = share_of(
      cases, "not_there", [](const WorldVerdict& v) { return !v.verdict.failed; },
      [](const WorldVerdict& v) { return v.names_more(); });
  f.untrue = share_of(
      cases, "untrue", [](const WorldVerdict& v) { return !v.verdict.failed; },
      [](const WorldVerdict& v) { return v.names_untrue(); });
  const auto closable = [&](const WorldVerdict& v) { return shows(v) && v.verdict.diagnosis.closure.has_value(); };
  std::vector<double> closures;
  for (const WorldVerdict* v : cases) {
    if (closable(*v)) closures.push_back(*v->verdict.diagnosis.closure);
  }
  f.closure = median_of("closure", "ratio", closures);
  f.closed = share_of(cases, "closed", closable,
                      [](const WorldVerdict& v) { return *v.verdict.diagnosis.closure >= kClosed; });
  f.misled =
      share_of(cases, "misled", closable, [](const WorldVerdict& v) { return *v.verdict.diagnosis.closure < 0; });
  f.covered = coverage(cases);
  f.calibration = calibration_error(cases);
  const Leanings l = leanings(cases);
  f.unknown_recall = recall(l);
  f.unknown_area = area(l);
  f.wall_s = median_of("wall_s", "s", times_s(cases));
  f.longest_s = longest(cases);
  return f;
}

}  // namespace umbsim::worlds

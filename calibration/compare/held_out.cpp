#include "calibration/compare/held_out.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace umbsim::calibration {
namespace {

// Of a condition, without the direction: all methods of squares and circles need both.
std::string both_ways(const TrainingRun& r) {
  std::string text = r.condition;
  const std::string direction = " " + r.run->direction;
  if (const std::size_t at = text.rfind(direction); at != std::string::npos) text.erase(at, direction.size());
  return text;
}

// What the method says without the runs of a fold; none where it has no answer.
std::optional<LogFactors> without(const Fold& fold, const MethodResult& result, const OdometryParameters& nominal) {
  if (!result.method || !result.fit) return std::nullopt;
  const auto& known = result.fit->left_out;
  if (fold.run && !known.empty() && known[*fold.run]) return known[*fold.run];
  try {
    return result.method->fit(fold.others, nominal).factors;
  } catch (const NotApplicable&) {
    return std::nullopt;
  }
}

Fold fold_without(const Runs& runs, const std::vector<std::size_t>& left_out) {
  Fold fold;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool out = std::find(left_out.begin(), left_out.end(), i) != left_out.end();
    (out ? fold.left_out : fold.others).push_back(runs[i]);
  }
  if (left_out.size() == 1) fold.run = left_out[0];
  return fold;
}

bool can_be_halved(const Runs& runs) {
  std::map<std::string, int> alike;
  for (const TrainingRun& r : runs) {
    if (!r.tracked() || ++alike[r.condition] > 1) return false;
  }
  return true;
}

// One half of a run, by time. Half a square is no square.
Recording half(const TrainingRun& r, bool second) {
  Recording recording = *r.recording;
  RecordedRun run = *r.run;
  const double middle_s = (run.truth.front().time_s + run.truth.back().time_s) / 2;
  std::erase_if(run.encoders, [&](const EncoderSample& s) { return (s.time_s >= middle_s) != second; });
  std::erase_if(run.truth, [&](const TruthSample& t) { return (t.time_s >= middle_s) != second; });
  if (recording.path.shape == "square") recording.path.shape = "free";
  recording.runs = {std::move(run)};
  return recording;
}

Folds halves_of(const Runs& runs) {
  Folds folds;
  folds.said = "no run was repeated: each half of all runs left out once";
  for (const bool second : {false, true}) {
    for (const TrainingRun& r : runs) folds.halves.push_back(half(r, second));
  }
  Runs first, second;
  for (std::size_t i = 0; i < folds.halves.size(); ++i) {
    TrainingRun r = runs[i % runs.size()];
    r.recording = &folds.halves[i];
    r.run = &folds.halves[i].runs[0];
    if (r.run->encoders.size() < 10 || r.run->truth.size() < 10) return {};
    (i < runs.size() ? first : second).push_back(r);
  }
  folds.all = {{first, second, {}}, {second, first, {}}};
  return folds;
}

struct Score {
  double sum_mm = 0;
  bool answered = false;
};

}  // namespace

Folds folds_of(const Runs& runs) {
  std::map<std::string, std::vector<std::size_t>> by_condition;
  for (std::size_t i = 0; i < runs.size(); ++i) by_condition[both_ways(runs[i])].push_back(i);
  Folds folds;
  if (by_condition.size() > 1) {
    for (const auto& [condition, members] : by_condition) folds.all.push_back(fold_without(runs, members));
    folds.said = fmt::format("{} conditions, each left out once", by_condition.size());
    return folds;
  }
  if (can_be_halved(runs)) folds = halves_of(runs);
  if (!folds.all.empty()) return folds;
  for (std::size_t i = 0; i < runs.size(); ++i) folds.all.push_back(fold_without(runs, {i}));
  folds.said = fmt::format("one condition only: each of {} runs left out once", runs.size());
  return folds;
}

void leave_out(const Folds& folds, const OdometryParameters& nominal, std::vector<MethodResult>& results) {
  const std::size_t n = folds.all.size();
  std::vector<Score> scores(results.size() * n);
  tbb::parallel_for(std::size_t(0), scores.size(), [&](std::size_t i) {
    const Fold& fold = folds.all[i % n];
    const auto factors = without(fold, results[i / n], nominal);
    scores[i].answered = factors.has_value();
    const OdometryParameters odometry = factors ? scaled(nominal, *factors) : nominal;
    for (const TrainingRun& r : fold.left_out)
      scores[i].sum_mm += run_error(r, odometry).final_mm / double(fold.left_out.size());
  });
  for (std::size_t i = 0; i < scores.size(); ++i) {
    results[i / n].held_out_mm += scores[i].sum_mm / double(n);
    results[i / n].held_out_answers += scores[i].answered;
  }
}

std::pair<std::size_t, std::string> choose(const std::vector<MethodResult>& results, const Folds& folds) {
  std::size_t best = 0, next = 0;
  bool any = false;
  for (std::size_t i = 1; i < results.size(); ++i) any = any || results[i].held_out_answers > 0;
  const auto cost = [&](const MethodResult& r) {
    if (any) return r.held_out_mm;
    double sum = 0;
    for (const MeanError& e : r.train) sum += e.final_mm / double(r.train.size());
    return sum;
  };
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (!results[i].fit) continue;
    if (cost(results[i]) < cost(results[best])) {
      next = best;
      best = i;
    } else if (next == best || cost(results[i]) < cost(results[next])) {
      next = i;
    }
  }
  const std::string how =
      any ? "runs that it had not seen (" + folds.said + ")"
          : std::string("the runs that it was fitted to: no run could be left out, which proves little");
  if (best == 0)
    return {0, fmt::format("no method predicts {} better than the nominal odometry, {:.1f} mm", how, cost(results[0]))};
  std::string why = fmt::format("ends {:.1f} mm from the truth in the mean on {}; nominal {:.1f} mm",
                                cost(results[best]), how, cost(results[0]));
  if (next != 0 && next != best) why += fmt::format(", next {} {:.1f} mm", results[next].name, cost(results[next]));
  return {best, why};
}

}  // namespace umbsim::calibration

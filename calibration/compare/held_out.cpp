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
std::optional<LogFactors> without(const Fold& fold, const Runs& runs, const MethodResult& result,
                                  const OdometryParameters& nominal) {
  if (!result.method || !result.fit) return std::nullopt;
  if (fold.left_out.size() == 1 && !result.fit->left_out.empty() && result.fit->left_out[fold.left_out[0]])
    return result.fit->left_out[fold.left_out[0]];
  Runs others;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (std::find(fold.left_out.begin(), fold.left_out.end(), i) == fold.left_out.end()) others.push_back(runs[i]);
  }
  try {
    return result.method->fit(others, nominal).factors;
  } catch (const NotApplicable&) {
    return std::nullopt;
  }
}

struct Score {
  double sum_mm = 0;
  bool answered = false;
};

}  // namespace

Folds folds_of(const Runs& runs) {
  std::map<std::string, Fold> by_condition;
  for (std::size_t i = 0; i < runs.size(); ++i) by_condition[both_ways(runs[i])].left_out.push_back(i);
  Folds folds;
  if (by_condition.size() > 1) {
    for (auto& [condition, fold] : by_condition) folds.all.push_back(std::move(fold));
    folds.said = fmt::format("{} conditions, each left out once", by_condition.size());
    return folds;
  }
  for (std::size_t i = 0; i < runs.size(); ++i) folds.all.push_back({{i}});
  folds.said = fmt::format("one condition only: each of {} runs left out once", runs.size());
  return folds;
}

void leave_out(const Runs& runs, const Folds& folds, const OdometryParameters& nominal,
               std::vector<MethodResult>& results) {
  const std::size_t n = folds.all.size();
  std::vector<Score> scores(results.size() * n);
  tbb::parallel_for(std::size_t(0), scores.size(), [&](std::size_t i) {
    const Fold& fold = folds.all[i % n];
    const auto factors = without(fold, runs, results[i / n], nominal);
    scores[i].answered = factors.has_value();
    const OdometryParameters odometry = factors ? scaled(nominal, *factors) : nominal;
    for (const std::size_t r : fold.left_out)
      scores[i].sum_mm += run_error(runs[r], odometry).final_mm / double(fold.left_out.size());
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

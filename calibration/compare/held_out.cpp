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
std::optional<OdometryParameters> without(const Fold& fold, const MethodResult& result,
                                          const OdometryParameters& nominal) {
  if (!result.method || !result.fit) return std::nullopt;
  const Fit& fit = *result.fit;
  if (fold.run && !fit.left_out.empty() && fit.left_out[*fold.run]) {
    OdometryParameters known = scaled(nominal, *fit.left_out[*fold.run]);
    if (!fit.left_out_scrub.empty()) known.scrub = fit.left_out_scrub[*fold.run];
    return known;
  }
  try {
    return fitted_odometry(nominal, result.method->fit(fold.others, nominal));
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
    const auto answer = without(fold, results[i / n], nominal);
    scores[i].answered = answer.has_value();
    const OdometryParameters odometry = answer.value_or(nominal);
    for (const TrainingRun& r : fold.left_out)
      scores[i].sum_mm += run_error(r, odometry).final_mm / double(fold.left_out.size());
  });
  for (std::size_t i = 0; i < scores.size(); ++i) {
    results[i / n].held_out_mm += scores[i].sum_mm / double(n);
    results[i / n].fold_mm.push_back(scores[i].sum_mm);
    results[i / n].held_out_answers += scores[i].answered;
  }
}

namespace {

bool any_answer(const std::vector<MethodResult>& results) {
  return std::any_of(results.begin() + 1, results.end(), [](const MethodResult& r) { return r.held_out_answers > 0; });
}

// On the runs left out; where no run could be left out on those that it was fitted to.
double cost_mm(const MethodResult& r, bool left_out) {
  if (left_out) return r.held_out_mm;
  double sum = 0;
  for (const MeanError& e : r.train) sum += e.final_mm / double(r.train.size());
  return sum;
}

// Whether the folds tell `other` from the better `best`: the mean of their differences is more than its standard error.
bool told_apart(const MethodResult& best, const MethodResult& other) {
  const double n = double(best.fold_mm.size());
  if (n < 2) return other.held_out_mm > best.held_out_mm;
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < best.fold_mm.size(); ++i) mean += (other.fold_mm[i] - best.fold_mm[i]) / n;
  for (std::size_t i = 0; i < best.fold_mm.size(); ++i)
    squares += std::pow(other.fold_mm[i] - best.fold_mm[i] - mean, 2);
  return mean > std::sqrt(squares / (n - 1) / n);
}

// Of the mean over the folds.
double standard_error_mm(const MethodResult& r) {
  const double n = double(r.fold_mm.size());
  double squares = 0;
  for (const double mm : r.fold_mm) squares += std::pow(mm - r.held_out_mm, 2);
  return n < 2 ? 0 : std::sqrt(squares / (n - 1) / n);
}

// The best of all, and of those within its standard error (Breiman et al. 1984, section 3.4.3) the one that takes least
// for exact: the last of the table. Runs of one course cannot tell what another course will ask for.
std::pair<std::size_t, std::size_t> best_and_chosen(const std::vector<MethodResult>& results, bool left_out) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (results[i].fit && cost_mm(results[i], left_out) < cost_mm(results[best], left_out)) best = i;
  }
  std::size_t chosen = best;
  for (std::size_t i = best + 1; left_out && best > 0 && i < results.size(); ++i) {
    if (results[i].fit && results[i].held_out_answers == results[best].held_out_answers &&
        results[i].held_out_mm <= results[best].held_out_mm + standard_error_mm(results[best]))
      chosen = i;
  }
  return {best, chosen};
}

}  // namespace

std::pair<std::size_t, std::string> choose(const std::vector<MethodResult>& results, const Folds& folds) {
  const bool left_out = any_answer(results);
  const auto [best, chosen] = best_and_chosen(results, left_out);
  const auto mm = [&](std::size_t i) { return fmt::format("{:.1f} mm", cost_mm(results[i], left_out)); };
  const std::string how =
      left_out ? "runs that it had not seen (" + folds.said + ")"
               : std::string("the runs that it was fitted to: no run could be left out, which proves little");
  if (best == 0) return {0, fmt::format("no method predicts {} better than the nominal odometry, {}", how, mm(0))};
  // What the folds do not tell from nominal corrects nothing that is known to be wrong.
  if (left_out && !told_apart(results[chosen], results[0]) && !told_apart(results[best], results[0]))
    return {0,
            fmt::format("{} ends {} from the truth in the mean on {}, which is not told from the nominal odometry, {}",
                        results[best].name, mm(best), how, mm(0))};
  std::string why = fmt::format("ends {} from the truth in the mean on {}; nominal {}", mm(chosen), how, mm(0));
  if (chosen != best) {
    return {chosen,
            why + fmt::format(", {} {}, by less than a standard error; of methods that are as good the one that "
                              "takes least for exact counts",
                              results[best].name, mm(best))};
  }
  std::size_t next = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (i == best || !results[i].fit) continue;
    if (next == 0 || cost_mm(results[i], left_out) < cost_mm(results[next], left_out)) next = i;
  }
  if (next != 0) why += fmt::format(", next {} {}", results[next].name, mm(next));
  return {best, why};
}

}  // namespace umbsim::calibration

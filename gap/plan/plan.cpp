#include "gap/plan/plan.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "gap/plan/select.h"

namespace umbsim::gap {
namespace {

constexpr double kFromNothing = 0.6;    // of the choice's time
constexpr int kDrawsOfSelection = 120;  // of each effect, for each set of runs that is tried

// Groups of names that pairs join, in the order of `effects`.
std::vector<std::vector<std::string>> groups_of(const std::vector<std::string>& effects, const Eigen::MatrixXd& alike,
                                                double above) {
  std::vector<std::size_t> root(effects.size());
  std::iota(root.begin(), root.end(), std::size_t(0));
  for (std::size_t i = 0; i < effects.size(); ++i) {
    for (std::size_t j = i + 1; j < effects.size(); ++j) {
      if (!(alike(Eigen::Index(i), Eigen::Index(j)) > above)) continue;
      const std::size_t from = std::max(root[i], root[j]);
      std::replace(root.begin(), root.end(), from, std::min(root[i], root[j]));
    }
  }
  std::map<std::size_t, std::vector<std::string>> groups;
  for (std::size_t i = 0; i < effects.size(); ++i) groups[root[i]].push_back(effects[i]);
  std::vector<std::vector<std::string>> several;
  for (auto& [first, names] : groups) {
    if (names.size() > 1) several.push_back(std::move(names));
  }
  return several;
}

std::vector<std::size_t> range(std::size_t first, std::size_t last) {
  std::vector<std::size_t> runs(last - first);
  std::iota(runs.begin(), runs.end(), first);
  return runs;
}

}  // namespace

Separation separation(Race race, const PlanOptions& options) {
  Separation s;
  const Eigen::MatrixXd alike = (race.mistaken + race.mistaken.transpose()) / 2;
  const Eigen::VectorXd found = 1 - race.named.rightCols(1).array();
  const Eigen::Index n = alike.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (found[i] < options.shown) s.not_shown.push_back(race.effects[std::size_t(i)]);
    for (Eigen::Index j = i + 1; j < n; ++j) {
      const bool mistaken = alike(i, j) > options.alike;
      if (mistaken) s.alike.push_back({{race.effects[std::size_t(i)], race.effects[std::size_t(j)]}, alike(i, j)});
      if (std::min(race.severity[i], race.severity[j]) < options.least) continue;
      if (!mistaken && found[i] >= options.shown && found[j] >= options.shown) ++s.separated;
      s.soft += (1 - std::min(1.0, 2 * alike(i, j))) * found[i] * found[j];
    }
  }
  s.groups = groups_of(race.effects, alike, options.alike);
  s.race = std::move(race);
  return s;
}

Plan plan(const Model& model, std::size_t given, double radius_scatter, const PlanOptions& options,
          const ProgressCallback& progress) {
  constexpr const char* kDriving = "driving the runs and the menu under every effect";
  progress(kDriving, 0);
  Plan p;
  p.no_hypothesis = without_hypothesis(options.effects);
  const std::vector<std::size_t> asked = range(0, given);
  const std::vector<std::size_t> menu = range(given, model.recording().runs.size());
  const Signatures signatures(model, planned_hypotheses(model, options.effects), asked, options.severity,
                              radius_scatter, [&](double share) { progress(kDriving, share); });
  const std::vector<Eigen::VectorXd> residual = model.residuals(model.predict({{}}).front());
  const std::vector<RunGram> grams = model.grams(residual, signatures.columns);
  const auto judged = [&](const std::vector<std::size_t>& runs, int draws) {
    const Eigen::MatrixXd A = information(grams, runs, signatures, model.nuisance_sd());
    return separation(race(A, signatures.all, Thresholds{}, {options.severity, draws, options.seed}), options);
  };
  progress("choosing runs", 0);
  p.given = judged(asked, options.draws);
  const Judge quickly = [&](const std::vector<std::size_t>& runs) { return judged(runs, kDrawsOfSelection); };
  p.from_nothing = select_runs({}, menu, quickly);
  progress("choosing runs", kFromNothing);
  p.further = select_runs(asked, menu, quickly);
  constexpr double kReached = 0.8;  // of the severity that was asked for
  for (std::size_t i = 0; i < p.given.race.effects.size(); ++i) {
    const double reached = p.given.race.severity[Eigen::Index(i)];
    if (reached < kReached * options.severity) p.weak.push_back({p.given.race.effects[i], reached});
  }
  return p;
}

}  // namespace umbsim::gap

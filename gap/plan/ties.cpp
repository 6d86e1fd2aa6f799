#include "gap/plan/ties.h"

#include <Eigen/LU>
#include <algorithm>

#include "gap/answer/unknown.h"

namespace umbsim::gap {
namespace {

constexpr double kScatter = 5e-5;  // of radii from run to run; sizes are not asked for here
constexpr int kRaceDraws = 200;
constexpr std::size_t kMostKinds = 3;

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Hypotheses that need no place, and every bending one as it was fitted.
std::vector<PlannedHypothesis> hypotheses_of(const Model& model, const Diagnosis& d) {
  std::set<std::string> wanted;
  for (const EffectInfo& info : catalogue()) wanted.insert(info.name);
  std::vector<PlannedHypothesis> hypotheses = planned_hypotheses(model, wanted);
  std::erase_if(hypotheses, [](const PlannedHypothesis& p) { return p.hypothesis.search_cost > 0; });
  for (const Cause& c : d.causes) {
    Eigen::Index at = 0;
    for (Hypothesis f : c.fit.hypotheses) {
      const Eigen::VectorXd p = c.fit.p.segment(at, Eigen::Index(f.parameters.size()));
      at += p.size();
      if (f.from_zero) continue;
      for (Eigen::Index i = 0; i < p.size(); ++i) f.parameters[std::size_t(i)].start = p[i];
      hypotheses.push_back({std::move(f), true, false, false, 0, 0});
    }
  }
  return hypotheses;
}

// The signature and the numbers of one hypothesis of a cause's fit.
FixedTruth as_fitted(const std::vector<Signature>& signatures, const Cause& cause, const std::string& effect) {
  FixedTruth truth;
  Eigen::Index at = 0;
  for (const Hypothesis& f : cause.fit.hypotheses) {
    const Eigen::Index n = Eigen::Index(f.parameters.size());
    const Eigen::VectorXd p = cause.fit.p.segment(at, n);
    at += n;
    if (f.effect != effect) continue;
    for (std::size_t i = 0; i < signatures.size(); ++i) {
      const Hypothesis& g = signatures[i].planned.hypothesis;
      if (g.effect != f.effect || g.variant != f.variant) continue;
      if (!f.from_zero && !(signatures[i].unit[0] == p[0])) continue;
      truth = {i, f.from_zero ? p : Eigen::VectorXd::Ones(1)};
    }
  }
  return truth;
}

// What the other effects of a combination explain is taken out, as if they were nuisances.
Eigen::MatrixXd without(const Eigen::MatrixXd& A, const std::vector<Signature>& signatures,
                        const std::vector<FixedTruth>& others) {
  Eigen::MatrixXd result = A;
  for (const FixedTruth& t : others) {
    const Signature& s = signatures[t.signature];
    Eigen::MatrixXd M =
        s.prior_sd.asDiagonal() * result.block(s.first, s.first, s.count, s.count) * s.prior_sd.asDiagonal();
    M.diagonal().array() += 1;
    const Eigen::MatrixXd cross = s.prior_sd.asDiagonal() * result.middleRows(s.first, s.count);
    result = (result - cross.transpose() * M.inverse() * cross).eval();
  }
  return result;
}

std::vector<std::string> effects_of_name(const std::string& name) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= name.size();) {
    const std::size_t to = std::min(name.find('+', from), name.size());
    parts.push_back(name.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

}  // namespace

Ties find_ties(const Model& model, const Diagnosis& d, const std::set<std::string>& excluded, const Thresholds& t,
               double alike) {
  Ties ties;
  const Cause& first = d.causes.front();
  if (first.fit.hypotheses.empty()) return ties;
  ties.hypotheses = hypotheses_of(model, d);
  const Signatures signatures(model, ties.hypotheses, model.all_runs(), 0, kScatter);
  const auto grams = model.grams(model.residuals(model.predict({{}}).front()), signatures.columns);
  const Eigen::MatrixXd A = information(grams, model.all_runs(), signatures, model.nuisance_sd());
  ties.information = A;
  const std::vector<std::string> own = effects_of_name(first.name);
  const auto add = [&](const std::string& effect, const FixedTruth& size) {
    if (holds(ties.members, effect) || size.numbers.size() == 0) return;
    ties.members.push_back(effect);
    ties.sizes.push_back(size);
  };
  for (const std::string& effect : own) add(effect, as_fitted(signatures.all, first, effect));
  ties.own = ties.members.size();
  for (const std::string& effect : own) {
    const FixedTruth truth = as_fitted(signatures.all, first, effect);
    if (truth.numbers.size() == 0) continue;
    std::vector<FixedTruth> others;
    for (const std::string& other : own) {
      const FixedTruth size = as_fitted(signatures.all, first, other);
      if (other != effect && size.numbers.size() > 0) others.push_back(size);
    }
    const Eigen::MatrixXd left = without(A, signatures.all, others);
    std::vector<std::string> group{effect};
    for (const EffectInfo& info : catalogue()) {
      if (holds(own, info.name)) continue;
      const FixedTruth rival = nearest(left, signatures.all, truth, info.name);
      if (rival.numbers.size() == 0) continue;
      if (excluded.count(info.name) > 0) {
        // Were it the truth, the first would be named in its place unless what that leaves can be seen.
        const double explained = first.score + t.effect_cost * double(own.size());
        const double seen = may_be_left(explained, model.contacts_differ(first.fit), t);
        if (expected_lead(left, signatures.all, rival, effect) <= seen) group.push_back(info.name);
        continue;
      }
      const Race race = race_among({truth, rival}, left, signatures.all, t, {0, kRaceDraws, 1});
      if ((race.mistaken(0, 1) + race.mistaken(1, 0)) / 2 <= alike) continue;
      group.push_back(info.name);
      add(info.name, rival);
      // The other way round counts for the set: the truth is this one, and the first is named.
      if (own.size() == 1 && race.mistaken(1, 0) > alike) ties.could_be.push_back(info.name);
    }
    if (group.size() > 1) ties.groups.push_back(std::move(group));
  }
  for (const std::string& name : d.set) {
    for (const Cause& c : d.causes) {
      if (c.name != name) continue;
      for (const std::string& effect : effects_of_name(name)) add(effect, as_fitted(signatures.all, c, effect));
    }
  }
  return ties;
}

void add_ties(const Ties& ties, const Thresholds& t, Diagnosis& d) {
  d.indistinguishable = ties.groups;
  constexpr double kNotFar = 2;  // times the evidence within which the set's members lie
  for (const std::string& effect : ties.could_be) {
    const auto fitted =
        std::find_if(d.causes.begin(), d.causes.end(), [&](const Cause& c) { return c.name == effect; });
    const bool near = fitted == d.causes.end() || d.causes.front().score - fitted->score < kNotFar * t.tie;
    if (near && !holds(d.set, effect)) d.set.push_back(effect);
  }
}

std::vector<NextExperiment> next_experiments(const Model& menu, const std::vector<std::string>& labels,
                                             const Ties& ties, const Thresholds& t) {
  std::vector<NextExperiment> all;
  const Signatures signatures(menu, ties.hypotheses, menu.all_runs(), 0, kScatter);
  const auto grams = menu.grams(menu.residuals(menu.predict({{}}).front()), signatures.columns);
  for (std::size_t r = 0; r + 1 < labels.size(); r += 2) {
    // A load says nothing by itself, only beside runs without it. Nuisances of the two are taken as independent.
    const Eigen::MatrixXd A = ties.information + information(grams, {r, r + 1}, signatures, menu.nuisance_sd());
    NextExperiment next{labels[r].substr(0, labels[r].rfind(',')) + ", cw and ccw", {}, 0};
    for (std::size_t i = 0; i < ties.members.size(); ++i) {
      for (std::size_t j = std::max(i + 1, ties.own); j < ties.members.size(); ++j) {
        const auto gained = [&](std::size_t truth, std::size_t other) {
          return expected_lead(A, signatures.all, ties.sizes[truth], ties.members[other]) -
                 expected_lead(ties.information, signatures.all, ties.sizes[truth], ties.members[other]);
        };
        const double lead = std::min(gained(i, j), gained(j, i));
        if (lead < t.tie) continue;
        for (const std::string& e : {ties.members[i], ties.members[j]}) {
          if (!holds(next.separates, e)) next.separates.push_back(e);
        }
        next.lead += lead;
      }
    }
    if (!next.separates.empty()) all.push_back(std::move(next));
  }
  std::stable_sort(all.begin(), all.end(), [](const NextExperiment& a, const NextExperiment& b) {
    if (a.separates.size() != b.separates.size()) return a.separates.size() > b.separates.size();
    return a.lead > b.lead;
  });
  if (all.size() > kMostKinds) all.resize(kMostKinds);
  return all;
}

}  // namespace umbsim::gap

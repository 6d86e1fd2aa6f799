// A model in which the signatures of a fit's effects may be off, as they are in other engines and on other tyres.
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "gap/evidence/model.h"
#include "gap/evidence/signature_shares.h"
#include "gap/replay/run_groups.h"
#include "gap/traits/signature_errors.h"

namespace umbsim::gap {
namespace {

constexpr double kSpeedingShare = 0.02;  // of the longest way in a sample, by which one is not like that before

// What a run does before each sample.
std::vector<CoursePart> parts_of(const NominalReplay& nominal, std::size_t run) {
  const auto& ways = nominal.wheels_m[run];
  double longest_m = 0;
  for (const auto& way : ways) longest_m = std::max({longest_m, std::abs(way[0]), std::abs(way[1])});
  std::vector<CoursePart> parts(ways.size(), kLeg);
  for (std::size_t k = 1; k < ways.size(); ++k) {
    const double ds_m = (ways[k][0] + ways[k][1]) / 2;
    const double turned_m = std::abs(ways[k][1] - ways[k][0]) / 2;
    double faster_m = 0;
    for (int w = 0; w < 2; ++w) faster_m = std::max(faster_m, std::abs(ways[k][w] - ways[k - 1][w]));
    parts[k] = faster_m > kSpeedingShare * longest_m ? kSpeeding
               : turned_m < 0.05 * std::abs(ds_m)    ? kLeg
               : std::abs(ds_m) > 0.3 * turned_m     ? kArc
                                                     : kInPlace;
  }
  return parts;
}

Eigen::VectorXd with_zeros(const Eigen::VectorXd& v, Eigen::Index more) {
  Eigen::VectorXd longer = Eigen::VectorXd::Zero(v.size() + more);
  longer.head(v.size()) = v;
  return longer;
}

// Columns that all runs share, in this order: of each effect its pieces, by group of runs and part of the course; what
// counts show of each; the clock of each tracker; leads of each group, along and turning; of each effect by part of the
// course the turns that what it does along, and across, may come with.
struct Unsure {
  Unsure(std::size_t effect_count, const RunGroups& run_groups, std::size_t trackers)
      : groups(run_groups),
        effects(Eigen::Index(effect_count)),
        pieces(Eigen::Index(kCourseParts * groups.rolling.size())),
        counts(pieces * effects),
        clocks(counts + effects),
        leads(clocks + Eigen::Index(trackers)),
        turns(leads + 2 * Eigen::Index(groups.rolling.size())),
        sd(turns + 2 * Eigen::Index(kCourseParts) * effects) {}

  Eigen::Index piece(Eigen::Index effect, std::size_t run, std::size_t part) const {
    return effect * pieces + Eigen::Index(kCourseParts * groups.group_of[run] + part);
  }
  Eigen::Index turn(Eigen::Index effect, std::size_t part, int axis) const {
    return turns + 2 * (effect * Eigen::Index(kCourseParts) + Eigen::Index(part)) + axis;
  }
  Eigen::Index lead(std::size_t run) const { return leads + 2 * Eigen::Index(groups.group_of[run]); }

  RunGroups groups;
  Eigen::Index effects, pieces, counts, clocks, leads, turns;
  Eigen::VectorXd sd;
};

// One run's part of them, as track errors, and further variance of its motions.
struct UnsureRun {
  Eigen::MatrixXd columns;
  Impulses3 more;
};

// What an effect adds to the motions of a run, cut by part of the course, and the turns of a wheel that does this
// alone.
void add_effect(const Unsure& unsure, Eigen::Index effect, std::size_t run, const TrackFilter& filter,
                const std::vector<CoursePart>& parts, const Impulses3& added, double motion, double wheelbase_m,
                UnsureRun& to) {
  std::vector<Impulses3> cut(kCourseParts, Impulses3(added.size(), Eigen::Vector3d::Zero()));
  for (std::size_t k = 1; k < added.size(); ++k) {
    cut[parts[k]][k] = added[k];
    to.more[k] += (motion * added[k]).cwiseAbs2();
  }
  for (std::size_t c = 0; c < kCourseParts; ++c) {
    to.columns.col(unsure.piece(effect, run, c)) = filter.propagate(cut[c]);
    for (int axis = 0; axis < 2; ++axis) {
      Impulses3 turns(added.size(), Eigen::Vector3d::Zero());
      for (std::size_t k = 0; k < added.size(); ++k) turns[k][2] = cut[c][k][axis] / (wheelbase_m / 2);
      to.columns.col(unsure.turn(effect, c, axis)) = filter.propagate(turns);
    }
  }
}

// Its tracker's clock, and leads of its poses, as the robot moves at these velocities.
void add_clock(const Unsure& unsure, std::size_t run, std::size_t tracker, const TrackFilter& filter,
               const std::vector<Eigen::Vector3d>& velocity, UnsureRun& to) {
  Impulses3 along(velocity.size(), Eigen::Vector3d::Zero()), turning = along;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    to.columns.col(unsure.clocks + Eigen::Index(tracker)).segment<3>(3 * Eigen::Index(k)) = velocity[k];
    if (k == 0) continue;
    along[k][0] = velocity[k][0] - velocity[k - 1][0];
    turning[k][2] = velocity[k][2] - velocity[k - 1][2];
  }
  to.columns.col(unsure.lead(run)) = filter.propagate(along);
  to.columns.col(unsure.lead(run) + 1) = filter.propagate(turning);
}

}  // namespace

Model Model::unsure_of(const Fit& fit) const {
  const double share = same_engine(fit) ? scatter_.same_engine : 1;
  return unsure_of(fit, [&](const std::string& effect) {
    SignatureErrors off = signature_errors_of(effect);
    for (double& part : off.parts) part *= share;
    off.motion *= share;
    off.counts *= share;
    off.turned = is_kinematic(effect) ? 0 : 1;
    return off;
  });
}

Model Model::unsure_of(const Fit& fit, const ErrorsOf& errors) const {
  Model model = *this;
  model.noise_m2_ = {};
  const NominalReplay moved = gap::beside(*campaign_, fit.predicted.tracks);
  Unsure unsure(fit.hypotheses.size(), grouped(recording().runs, nominal_.origin), campaign_->parts.size());
  std::vector<Predicted> alone;
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < unsure.effects; ++i) {
    const Hypothesis& h = fit.hypotheses[std::size_t(i)];
    const Eigen::VectorXd p = fit.p.segment(at, Eigen::Index(h.parameters.size()));
    at += p.size();
    const SignatureErrors off = errors(h.effect);
    for (Eigen::Index c = 0; c < unsure.pieces; ++c)
      unsure.sd[i * unsure.pieces + c] = off.parts[std::size_t(c) % kCourseParts];
    unsure.sd[unsure.counts + i] = off.counts;
    for (std::size_t c = 0; c < kCourseParts; ++c)
      unsure.sd.segment<2>(unsure.turn(i, c, 0)).setConstant(off.turned * off.parts[c]);
    alone.push_back(unsure.effects == 1 ? fit.predicted : predict({effects_of(h, p)}).front());
  }
  unsure.sd.segment(unsure.clocks, unsure.leads - unsure.clocks).setConstant(scatter_.clock_s);
  unsure.sd.segment(unsure.leads, unsure.turns - unsure.leads)
      .setConstant(another_engines(fit) ? nuisances_.lead_s : 0);
  const Eigen::Index more = unsure.sd.size();
  Nuisances& n = model.nuisances_;
  tbb::parallel_for(std::size_t(0), recording().runs.size(), [&](std::size_t r) {
    const std::vector<CoursePart> parts = parts_of(nominal_, r);
    UnsureRun run{Eigen::MatrixXd::Zero(3 * Eigen::Index(parts.size()), more),
                  Impulses3(parts.size(), Eigen::Vector3d::Zero())};
    Eigen::MatrixXd in_counts = Eigen::MatrixXd::Zero(kFeatureRows, more);
    for (Eigen::Index i = 0; i < unsure.effects; ++i) {
      const std::string& effect = fit.hypotheses[std::size_t(i)].effect;
      const Predicted& with = alone[std::size_t(i)];
      // How wheels slip under what is asked of them too much is each engine's own: of that, the motions themselves.
      const std::vector<Pose2> standing(parts.size());
      const Impulses3 added = is_commanded_motion(effect) ? motion_errors(standing, nominal_.tracks[r])
                                                          : motion_errors(nominal_.tracks[r], with.tracks[r]);
      add_effect(unsure, i, r, filters_[r], parts, added, errors(effect).motion, recording().robot.wheelbase_m, run);
      in_counts.col(unsure.counts + i) = feature_rows(r, with, without_effects_);
    }
    add_clock(unsure, r, campaign_->part_of[r], filters_[r], moved.velocity[r], run);
    model.filters_[r] = TrackFilter(nominal_.tracks[r], nominal_.rolled_m[r], noise(r), nominal_.seen[r],
                                    nominal_.velocity[r], run.more);
    n.tracks[r].conservativeResize(Eigen::NoChange, n.tracks[r].cols() + more);
    n.tracks[r].rightCols(more) = run.columns;
    n.shared[r].conservativeResize(Eigen::NoChange, n.shared[r].cols() + more);
    n.shared[r].bottomRightCorner(kFeatureRows, more) = in_counts;
  });
  whiten_again(n, nominal_, model.filters_);
  n.shared_sds = with_more(n.shared_sds, unsure.sd);
  n.usual_sd = with_more({n.usual_sd}, unsure.sd).front();
  n.unexplained_sd = with_zeros(n.unexplained_sd, more);
  n.engine_sd = with_zeros(n.engine_sd, more);
  model.look_without_effects();
  return model;
}

SignatureShares signature_shares(const Model& model, const Fit& fit, double motion) {
  constexpr double kWide = 1;
  const auto wide = [&](const std::string&) { return SignatureErrors{{kWide, kWide, kWide, kWide}, motion, kWide}; };
  const Model unsure = model.unsure_of(fit, wide);
  const Evidence e = evidence(unsure.grams(unsure.residuals(fit.predicted), {}), unsure.all_runs(),
                              first_columns(unsure.nuisances()), unsure.nuisance_sds());
  const std::size_t groups = grouped(model.recording().runs, model.nominal().origin).rolling.size();
  const Eigen::Index n = Eigen::Index(kCourseParts * groups) + 1;
  const Eigen::Index first = model.nuisances();
  SignatureShares shares;
  for (std::size_t i = 0; i < kCourseParts * groups; ++i) shares.part.push_back(i % kCourseParts);
  shares.part.push_back(kCourseParts);
  // Of the posterior what the prior brought is taken out again.
  const Eigen::MatrixXd known = e.covariance.block(first, first, n, n).inverse();
  shares.precision = known - Eigen::MatrixXd::Identity(n, n) / (kWide * kWide);
  shares.pull = known * e.mean.segment(first, n);
  shares.log_density = e.log_density - shares.gain(Eigen::VectorXd::Constant(n, kWide));
  for (const std::size_t r : unsure.all_runs()) shares.log_density -= unsure.filter(r).log_det() / 2;
  return shares;
}

double SignatureShares::gain(const Eigen::VectorXd& sd) const {
  Eigen::MatrixXd m = sd.asDiagonal() * precision * sd.asDiagonal();
  m.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> llt(m);
  const Eigen::VectorXd pulled = sd.cwiseProduct(pull);
  return pulled.dot(llt.solve(pulled)) / 2 - llt.matrixLLT().diagonal().array().log().sum();
}

}  // namespace umbsim::gap

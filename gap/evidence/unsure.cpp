// A model in which the signatures of a fit's effects may be off, as they are in other engines and on other tyres.
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "gap/evidence/model.h"
#include "gap/evidence/signature_shares.h"
#include "gap/replay/nominal_replay.h"
#include "gap/replay/run_groups.h"
#include "gap/traits/signature_errors.h"

namespace umbsim::gap {
namespace {

// What one effect may do otherwise, as columns that all runs share: its pieces, by group of runs and part of the
// course; what counts show of it; by part of the course the turns that what it does along, and across, may come with,
// and the way along that what it does across may: a wheel that slides aside has no grip left along its way.
struct Pieces {
  explicit Pieces(const RunGroups& run_groups)
      : groups(run_groups), counts(Eigen::Index(kCourseParts * run_groups.rolling.size())) {}

  Eigen::Index piece(std::size_t run, std::size_t part) const {
    return Eigen::Index(kCourseParts * groups.group_of[run] + part);
  }
  Eigen::Index besides(std::size_t part, int kind = 0) const { return counts + 1 + 3 * Eigen::Index(part) + kind; }
  Eigen::Index size() const { return besides(kCourseParts); }

  Eigen::VectorXd sd(const SignatureErrors& off) const {
    Eigen::VectorXd sd(size());
    for (Eigen::Index i = 0; i < counts; ++i) sd[i] = off.parts[std::size_t(i) % kCourseParts];
    sd[counts] = off.counts;
    for (std::size_t c = 0; c < kCourseParts; ++c) sd.segment<3>(besides(c)).setConstant(off.beside * off.parts[c]);
    return sd;
  }

  // Of a run: what an effect adds to its motions, cut by part of the course, and what may come beside that.
  Eigen::MatrixXd tracks(std::size_t run, const TrackFilter& filter, const std::vector<CoursePart>& parts,
                         const Impulses3& added, double wheelbase_m) const {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * Eigen::Index(parts.size()), size());
    for (std::size_t c = 0; c < kCourseParts; ++c) {
      Impulses3 cut(added.size(), Eigen::Vector3d::Zero());
      for (std::size_t k = 1; k < added.size(); ++k) {
        if (parts[k] == c) cut[k] = added[k];
      }
      columns.col(piece(run, c)) = filter.propagate(cut);
      std::array<Impulses3, 3> beside;
      for (const Eigen::Vector3d& motion : cut) {
        beside[0].emplace_back(0, 0, motion[0] / (wheelbase_m / 2));
        beside[1].emplace_back(0, 0, motion[1] / (wheelbase_m / 2));
        beside[2].emplace_back(motion[1], 0, 0);
      }
      for (int kind = 0; kind < 3; ++kind) columns.col(besides(c, kind)) = filter.propagate(beside[kind]);
    }
    return columns;
  }

  RunGroups groups;
  Eigen::Index counts;
};

// The clock of each tracker, and leads of each group, along and turning, as the robot moves at these velocities.
Eigen::MatrixXd clock_columns(const RunGroups& groups, std::size_t run, std::size_t tracker, std::size_t trackers,
                              const TrackFilter& filter, const std::vector<Eigen::Vector3d>& velocity) {
  const Eigen::Index clocks = Eigen::Index(trackers), lead = clocks + 2 * Eigen::Index(groups.group_of[run]);
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(3 * Eigen::Index(velocity.size()), clocks + 2 * Eigen::Index(groups.rolling.size()));
  Impulses3 along(velocity.size(), Eigen::Vector3d::Zero()), turning = along;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    columns.col(Eigen::Index(tracker)).segment<3>(3 * Eigen::Index(k)) = velocity[k];
    if (k == 0) continue;
    along[k][0] = velocity[k][0] - velocity[k - 1][0];
    turning[k][2] = velocity[k][2] - velocity[k - 1][2];
  }
  columns.col(lead) = filter.propagate(along);
  columns.col(lead + 1) = filter.propagate(turning);
  return columns;
}

}  // namespace

void Model::take_as_unsure(const Predicted& with, const SignatureErrors& off, bool commanded) {
  const Pieces pieces(grouped(recording().runs, nominal_.origin));
  std::vector<Eigen::MatrixXd> tracks(recording().runs.size()), counts = tracks;
  tbb::parallel_for(std::size_t(0), tracks.size(), [&](std::size_t r) {
    const std::vector<CoursePart> parts = parts_of(nominal_, r);
    // How wheels slip under what is asked of them too much is each engine's own: of that, the motions themselves.
    const std::vector<Pose2> standing(parts.size());
    const Impulses3 added =
        commanded ? motion_errors(standing, nominal_.tracks[r]) : motion_errors(nominal_.tracks[r], with.tracks[r]);
    tracks[r] = pieces.tracks(r, filters_[r], parts, added, recording().robot.wheelbase_m);
    counts[r] = Eigen::MatrixXd::Zero(kFeatureRows, pieces.size());
    counts[r].col(pieces.counts) = feature_rows(r, with, without_effects_);
    further_variance_[r].resize(parts.size(), Eigen::Vector3d::Zero());
    for (std::size_t k = 1; k < parts.size(); ++k) further_variance_[r][k] += (off.motion * added[k]).cwiseAbs2();
  });
  add_nuisances(tracks, counts, pieces.sd(off));
}

// `tracks` as errors, `counts` in standard deviations.
void Model::add_nuisances(const std::vector<Eigen::MatrixXd>& tracks, const std::vector<Eigen::MatrixXd>& counts,
                          const Eigen::VectorXd& sd) {
  Nuisances& n = nuisances_;
  const auto more = sd.size();
  for (std::size_t r = 0; r < tracks.size(); ++r) {
    n.tracks[r].conservativeResize(Eigen::NoChange, n.tracks[r].cols() + more);
    n.tracks[r].rightCols(more) = tracks[r];
    n.shared[r].conservativeResize(Eigen::NoChange, n.shared[r].cols() + more);
    n.shared[r].bottomRightCorner(kFeatureRows, more) = counts[r];
  }
  n.shared_sds = with_more(n.shared_sds, sd);
  n.usual_sd = with_more({n.usual_sd}, sd).front();
  for (Eigen::VectorXd* none : {&n.mount, &n.unexplained_sd, &n.engine_sd})
    none->conservativeResizeLike(Eigen::VectorXd::Zero(none->size() + more));
}

// Filters, and all that they whiten, when nuisances were added.
void Model::whiten_all() {
  noise_m2_ = {};
  tbb::parallel_for(std::size_t(0), filters_.size(), [&](std::size_t r) {
    filters_[r] = TrackFilter(nominal_.tracks[r], nominal_.rolled_m[r], noise(r), nominal_.seen[r],
                              nominal_.velocity[r], further_variance_[r]);
  });
  whiten_again(nuisances_, nominal_, filters_);
  look_without_effects();
}

Model Model::unsure_of(const Fit& fit) const {
  const double share = same_engine(fit) ? scatter_.same_engine : 1;
  return unsure_of(fit, [&](const std::string& effect) {
    SignatureErrors off = signature_errors_of(effect);
    for (double& part : off.parts) part *= share;
    off.motion *= share;
    off.counts *= share;
    return off;
  });
}

Model Model::unsure_of(const Fit& fit, const ErrorsOf& errors) const {
  Model model = *this;
  Eigen::Index at = 0;
  for (const Hypothesis& h : fit.hypotheses) {
    const Eigen::VectorXd p = fit.p.segment(at, Eigen::Index(h.parameters.size()));
    at += p.size();
    const Predicted with = fit.hypotheses.size() == 1 ? fit.predicted : predict({effects_of(h, p)}).front();
    model.take_as_unsure(with, errors(h.effect), is_commanded_motion(h.effect));
  }
  const NominalReplay moved = gap::beside(*campaign_, fit.predicted.tracks);
  const RunGroups groups = grouped(recording().runs, nominal_.origin);
  std::vector<Eigen::MatrixXd> tracks, counts;
  for (const std::size_t r : all_runs()) {
    tracks.push_back(
        clock_columns(groups, r, campaign_->part_of[r], campaign_->parts.size(), filters_[r], moved.velocity[r]));
    counts.push_back(Eigen::MatrixXd::Zero(kFeatureRows, tracks.back().cols()));
  }
  Eigen::VectorXd sd = Eigen::VectorXd::Constant(tracks.front().cols(), another_engines(fit) ? nuisances_.lead_s : 0);
  sd.head(Eigen::Index(campaign_->parts.size())).setConstant(scatter_.clock_s);
  model.add_nuisances(tracks, counts, sd);
  model.whiten_all();
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

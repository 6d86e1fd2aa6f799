#include "gap/evidence/evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

// Over all runs, at the expansion point.
struct Sums {
  Eigen::MatrixXd ZZ;
  Eigen::VectorXd Zy;
  double yy = 0;
  double log_det = 0;
};

Sums sums_of(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs, const std::vector<int>& columns,
             const Eigen::VectorXd& shift) {
  const Eigen::Index m = Eigen::Index(columns.size());
  Sums s{Eigen::MatrixXd::Zero(m, m), Eigen::VectorXd::Zero(m)};
  for (const std::size_t r : runs) {
    const Eigen::MatrixXd& G = grams[r].products;
    s.yy += G(0, 0);
    s.log_det += grams[r].log_det;
    s.Zy += G(columns, 0);
    s.ZZ += G(columns, columns);
  }
  if (shift.size() == m) {
    s.yy += 2 * s.Zy.dot(shift) + shift.dot(s.ZZ * shift);
    s.Zy += s.ZZ * shift;
  }
  return s;
}

// In units of the prior: M = I + S Z'Z S is well conditioned however weak a column is.
Eigen::LLT<Eigen::MatrixXd> in_units_of(const Eigen::VectorXd& prior_sd, const Eigen::MatrixXd& ZZ) {
  Eigen::MatrixXd M = prior_sd.asDiagonal() * ZZ * prior_sd.asDiagonal();
  M.diagonal().array() += 1;
  return Eigen::LLT<Eigen::MatrixXd>(M);
}

struct UnderPrior {
  UnderPrior(const Sums& sums, const Eigen::VectorXd& sd)
      : llt(in_units_of(sd, sums.ZZ)),
        mean(sd.cwiseProduct(llt.solve(sd.cwiseProduct(sums.Zy)))),
        misfit(sums.yy - sums.Zy.dot(mean)),
        log_density(-0.5 * (sums.log_det + misfit) - llt.matrixLLT().diagonal().array().log().sum()) {}

  Eigen::LLT<Eigen::MatrixXd> llt;
  Eigen::VectorXd mean;
  double misfit;
  double log_density;
};

}  // namespace

Evidence evidence(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                  const std::vector<int>& columns, const Eigen::VectorXd& prior_sd, const Eigen::VectorXd& shift) {
  return evidence(grams, runs, columns, std::vector<Eigen::VectorXd>{prior_sd}, shift);
}

Evidence evidence(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                  const std::vector<int>& columns, const std::vector<Eigen::VectorXd>& prior_sds,
                  const Eigen::VectorXd& shift) {
  const Sums sums = sums_of(grams, runs, columns, shift);
  std::vector<UnderPrior> under;
  for (const Eigen::VectorXd& sd : prior_sds) under.emplace_back(sums, sd);
  const auto best = std::max_element(under.begin(), under.end(), [](const UnderPrior& a, const UnderPrior& b) {
    return a.log_density < b.log_density;
  });
  double sum = 0;
  for (const UnderPrior& u : under) sum += std::exp(u.log_density - best->log_density);
  Evidence e;
  e.prior = std::size_t(best - under.begin());
  e.log_density = best->log_density + std::log(sum / double(under.size()));
  e.mean = best->mean;
  const auto S = prior_sds[e.prior].asDiagonal();
  e.covariance = S * best->llt.solve(Eigen::MatrixXd::Identity(e.mean.size(), e.mean.size())) * S;
  e.misfit = best->misfit;
  e.residual = sums.yy - 2 * sums.Zy.dot(e.mean) + e.mean.dot(sums.ZZ * e.mean);
  return e;
}

Eigen::VectorXd after_nuisances(int nuisances, const Eigen::VectorXd& p) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(nuisances + p.size());
  shift.tail(p.size()) = p;
  return shift;
}

std::vector<int> first_columns(Eigen::Index n) {
  std::vector<int> columns;
  for (int i = 1; i <= int(n); ++i) columns.push_back(i);
  return columns;
}

std::vector<Eigen::VectorXd> with_more(std::vector<Eigen::VectorXd> prior_sds, const Eigen::VectorXd& more) {
  for (Eigen::VectorXd& sd : prior_sds) {
    const Eigen::Index n = sd.size();
    sd.conservativeResize(n + more.size());
    sd.tail(more.size()) = more;
  }
  return prior_sds;
}

RunGram integrated_out(const Eigen::MatrixXd& products, int first, const Eigen::VectorXd& prior_sd) {
  const Eigen::Index k = prior_sd.size();
  RunGram gram{products.topLeftCorner(first, first), 0};
  if (k == 0) return gram;
  Eigen::MatrixXd M = prior_sd.asDiagonal() * products.block(first, first, k, k) * prior_sd.asDiagonal();
  M.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> llt(M);
  const Eigen::MatrixXd cross = prior_sd.asDiagonal() * products.block(first, 0, k, first);
  gram.products -= cross.transpose() * llt.solve(cross);
  for (Eigen::Index i = 0; i < k; ++i) gram.log_det += 2 * std::log(llt.matrixLLT()(i, i));
  return gram;
}

}  // namespace umbsim::gap

#include "gap/evidence/evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace umbsim::gap {
namespace {

// Of all runs, at the expansion point: A = Z'Z, b = Z'y, y'y.
struct Sums {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  double yy = 0;
  double integrated = 0;
};

Sums sums_of(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs, const std::vector<int>& columns,
             const Eigen::VectorXd& shift) {
  const Eigen::Index m = Eigen::Index(columns.size());
  Sums s{Eigen::MatrixXd::Zero(m, m), Eigen::VectorXd::Zero(m)};
  for (const std::size_t r : runs) {
    const Eigen::MatrixXd& G = grams[r].products;
    s.yy += G(0, 0);
    s.integrated += grams[r].log_det;
    for (Eigen::Index j = 0; j < m; ++j) {
      const auto column = G.col(columns[std::size_t(j)]);
      s.b[j] += column[0];
      for (Eigen::Index i = 0; i < m; ++i) s.A(i, j) += column[columns[std::size_t(i)]];
    }
  }
  if (shift.size() == m) {
    s.yy += 2 * s.b.dot(shift) + shift.dot(s.A * shift);
    s.b += s.A * shift;
  }
  return s;
}

// In units of the prior: M = I + S A S is well conditioned however weak a column is.
Eigen::MatrixXd in_units_of(const Eigen::VectorXd& prior_sd, const Eigen::MatrixXd& A) {
  Eigen::MatrixXd M = prior_sd.asDiagonal() * A * prior_sd.asDiagonal();
  M.diagonal().array() += 1;
  return M;
}

struct UnderPrior {
  UnderPrior(const Sums& sums, const Eigen::VectorXd& prior_sd)
      : llt(in_units_of(prior_sd, sums.A)),
        mean(prior_sd.cwiseProduct(llt.solve(prior_sd.cwiseProduct(sums.b)))),
        misfit(sums.yy - sums.b.dot(mean)),
        log_density(-0.5 * sums.integrated - llt.matrixLLT().diagonal().array().log().sum() - 0.5 * misfit) {}

  Eigen::LLT<Eigen::MatrixXd> llt;
  Eigen::VectorXd mean;
  double misfit;
  double log_density;
};

Evidence in_full(const UnderPrior& u, const Sums& sums, const Eigen::VectorXd& sd) {
  Evidence e;
  e.log_density = u.log_density;
  e.mean = u.mean;
  e.covariance = sd.asDiagonal() * u.llt.solve(Eigen::MatrixXd::Identity(sd.size(), sd.size())) * sd.asDiagonal();
  e.misfit = u.misfit;
  e.residual = sums.yy - 2 * sums.b.dot(e.mean) + e.mean.dot(sums.A * e.mean);
  return e;
}

}  // namespace

Evidence evidence(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                  const std::vector<int>& columns, const Eigen::VectorXd& prior_sd, const Eigen::VectorXd& shift) {
  const Sums sums = sums_of(grams, runs, columns, shift);
  return in_full(UnderPrior(sums, prior_sd), sums, prior_sd);
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
  const std::size_t at = std::size_t(best - under.begin());
  Evidence e = in_full(*best, sums, prior_sds[at]);
  e.log_density += std::log(sum / double(under.size()));
  e.prior = at;
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

double chi_squared_tail(double chi_squared, double degrees_of_freedom) {
  if (!(chi_squared > 0)) return 1;
  return boost::math::cdf(
      boost::math::complement(boost::math::chi_squared_distribution<double>(degrees_of_freedom), chi_squared));
}

double log_normal_cdf(double x) {
  if (x > -6) return std::log(0.5 * std::erfc(-x / M_SQRT2));
  return -0.5 * x * x - std::log(-x * std::sqrt(2 * M_PI));
}

}  // namespace umbsim::gap

#include "gap/evidence/evidence.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace umbsim::gap {

Evidence evidence(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                  const std::vector<int>& columns, const Eigen::VectorXd& prior_sd, const Eigen::VectorXd& shift) {
  const Eigen::Index m = Eigen::Index(columns.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(m);
  double yy = 0;
  double integrated = 0;
  for (const std::size_t r : runs) {
    const Eigen::MatrixXd& G = grams[r].products;
    yy += G(0, 0);
    integrated += grams[r].log_det;
    for (Eigen::Index i = 0; i < m; ++i) {
      b[i] += G(0, columns[std::size_t(i)]);
      for (Eigen::Index j = 0; j < m; ++j) A(i, j) += G(columns[std::size_t(i)], columns[std::size_t(j)]);
    }
  }
  if (shift.size() == m) {
    yy += 2 * b.dot(shift) + shift.dot(A * shift);
    b += A * shift;
  }
  // In units of the prior: M = I + S A S is well conditioned however weak a column is.
  const Eigen::VectorXd& s = prior_sd;
  Eigen::MatrixXd M = s.asDiagonal() * A * s.asDiagonal();
  M.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> llt(M);
  const Eigen::VectorXd scaled = llt.solve(s.cwiseProduct(b));
  Evidence e;
  e.mean = s.cwiseProduct(scaled);
  e.covariance = s.asDiagonal() * llt.solve(Eigen::MatrixXd::Identity(m, m)) * s.asDiagonal();
  double log_det = 0;
  for (Eigen::Index i = 0; i < m; ++i) log_det += 2 * std::log(llt.matrixLLT()(i, i));
  e.log_density = -0.5 * (integrated + log_det + yy - b.dot(e.mean));
  e.misfit = yy - b.dot(e.mean);
  e.residual = yy - 2 * b.dot(e.mean) + e.mean.dot(A * e.mean);
  return e;
}

Evidence evidence(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                  const std::vector<int>& columns, const std::vector<Eigen::VectorXd>& prior_sds,
                  const Eigen::VectorXd& shift) {
  std::vector<Evidence> all;
  for (const Eigen::VectorXd& sd : prior_sds) all.push_back(evidence(grams, runs, columns, sd, shift));
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].log_density > all[best].log_density) best = i;
  }
  double sum = 0;
  for (const Evidence& e : all) sum += std::exp(e.log_density - all[best].log_density);
  Evidence e = std::move(all[best]);
  e.log_density += std::log(sum / double(prior_sds.size()));
  e.prior = best;
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

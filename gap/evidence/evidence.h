#pragma once

#include <Eigen/Core>
#include <vector>

namespace umbsim::gap {

/// Inner products of whitened columns of one run. Column 0 is the residual, then the nuisances, then an effect's
/// derivatives; run-level nuisances are already integrated out.
struct RunGram {
  Eigen::MatrixXd products;  ///< square, symmetric
  double log_det = 0;        ///< of what was integrated out: log det(I + S A S)
};

/// What a linear Gaussian model says of the residual: y ~ N(0, I + Z diag(prior_sd^2) Z').
struct Evidence {
  double log_density = 0;      ///< of y, relative to the model without any column
  Eigen::VectorXd mean;        ///< of the coefficients, posterior
  Eigen::MatrixXd covariance;  ///< posterior
  double residual = 0;         ///< squared sum of what is left at the mean
  double misfit = 0;           ///< the same with what the mean costs: -2 log of the density but for its normalisation
  std::size_t prior = 0;       ///< of several, which made y most likely
};

/// `columns`: indices (>= 1) into the grams' columns, with a prior standard deviation for each; `runs`: which of the
/// grams count. `shift` moves the expansion point: the residual becomes y + Z_c shift_c (zeros when empty).
Evidence evidence(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                  const std::vector<int>& columns, const Eigen::VectorXd& prior_sd, const Eigen::VectorXd& shift = {});

/// The same where one of several priors holds, each as likely as the others: the density is their mean, all else that
/// of the prior under which y is most likely.
Evidence evidence(const std::vector<RunGram>& grams, const std::vector<std::size_t>& runs,
                  const std::vector<int>& columns, const std::vector<Eigen::VectorXd>& prior_sds,
                  const Eigen::VectorXd& shift = {});

/// Numbers `p` at which derivatives were taken, as a shift of the linear model's parameters: behind the nuisances.
Eigen::VectorXd after_nuisances(int nuisances, const Eigen::VectorXd& p);

/// Indices of the first `n` columns of a gram, the residual not counted.
std::vector<int> first_columns(Eigen::Index n);

/// Each prior with the same further standard deviations behind it.
std::vector<Eigen::VectorXd> with_more(std::vector<Eigen::VectorXd> prior_sds, const Eigen::VectorXd& more);

/// Integrates the columns from `first` on out of the products, with a prior standard deviation for each.
RunGram integrated_out(const Eigen::MatrixXd& products, int first, const Eigen::VectorXd& prior_sd);

}  // namespace umbsim::gap

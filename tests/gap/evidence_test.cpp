#include "gap/evidence/evidence.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "core/probability.h"
#include "core/random.h"

namespace umbsim::gap {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  RandomStream random(seed, "matrix");
  Eigen::MatrixXd m(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) m(i, j) = random.normal();
  }
  return m;
}

/// Log density of y under N(0, I + Z diag(sd^2) Z'), over that under N(0, 1) without its y'y: the constant that the
/// evidence leaves out.
double dense_log_density(const Eigen::VectorXd& y, const Eigen::MatrixXd& Z, const Eigen::VectorXd& sd) {
  Eigen::MatrixXd C = Z * sd.cwiseAbs2().asDiagonal() * Z.transpose();
  C.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> llt(C);
  double log_det = 0;
  for (Eigen::Index i = 0; i < C.rows(); ++i) log_det += 2 * std::log(llt.matrixLLT()(i, i));
  return -0.5 * (log_det + y.dot(llt.solve(y)));
}

/// Two runs that share four coefficients.
struct TwoRuns {
  Eigen::MatrixXd Z[2] = {random_matrix(30, 4, 1), random_matrix(45, 4, 2)};
  Eigen::VectorXd y[2] = {random_matrix(30, 1, 3), 2 * random_matrix(45, 1, 4)};
  std::vector<RunGram> grams;

  TwoRuns() {
    for (int r = 0; r < 2; ++r) {
      Eigen::MatrixXd all(y[r].size(), 5);
      all << y[r], Z[r];
      grams.push_back({all.transpose() * all, 0});
    }
  }
  Eigen::MatrixXd stacked(const std::vector<int>& columns) const {
    Eigen::MatrixXd S(75, Eigen::Index(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      S.col(Eigen::Index(i)) << Z[0].col(columns[i] - 1), Z[1].col(columns[i] - 1);
    }
    return S;
  }
  Eigen::VectorXd stacked_y() const {
    Eigen::VectorXd both(75);
    both << y[0], y[1];
    return both;
  }
};

constexpr double kRoundOff = 1e-9;

TEST(Evidence, IsTheDenseNormalDensity) {
  const TwoRuns data;
  for (const double size : {1e-3, 0.1, 1.0, 100.0}) {
    const Eigen::VectorXd sd = size * Eigen::Vector3d(1, 0.5, 2);
    const std::vector<int> columns{1, 3, 4};
    const Evidence e = evidence(data.grams, {0, 1}, columns, sd);
    EXPECT_NEAR(e.log_density, dense_log_density(data.stacked_y(), data.stacked(columns), sd), kRoundOff) << size;
  }
}

TEST(Evidence, UsesTheRunsItIsGiven) {
  const TwoRuns data;
  const Eigen::VectorXd sd = Eigen::Vector2d(0.3, 1);
  const Evidence e = evidence(data.grams, {1}, {1, 2}, sd);
  EXPECT_NEAR(e.log_density, dense_log_density(data.y[1], data.Z[1].leftCols(2), sd), kRoundOff);
}

TEST(Evidence, PosteriorIsThatOfRidgeRegression) {
  const TwoRuns data;
  const std::vector<int> columns{1, 2, 3, 4};
  const Eigen::VectorXd sd = Eigen::Vector4d(0.2, 1, 3, 0.05);
  const Evidence e = evidence(data.grams, {0, 1}, columns, sd);
  const Eigen::MatrixXd Z = data.stacked(columns);
  Eigen::MatrixXd H = Z.transpose() * Z;
  H.diagonal() += sd.cwiseAbs2().cwiseInverse();
  const Eigen::MatrixXd covariance = H.inverse();
  const Eigen::VectorXd mean = covariance * Z.transpose() * data.stacked_y();
  EXPECT_LT((e.mean - mean).norm(), kRoundOff);
  EXPECT_LT((e.covariance - covariance).norm(), kRoundOff);
  EXPECT_NEAR(e.residual, (data.stacked_y() - Z * mean).squaredNorm(), kRoundOff);
}

TEST(Evidence, ShiftAddsTheColumnsToTheResidual) {
  const TwoRuns data;
  const std::vector<int> columns{2, 4};
  const Eigen::VectorXd sd = Eigen::Vector2d(0.7, 0.2);
  const Eigen::VectorXd shift = Eigen::Vector2d(1.5, -0.4);
  const Evidence e = evidence(data.grams, {0, 1}, columns, sd, shift);
  const Eigen::MatrixXd Z = data.stacked(columns);
  EXPECT_NEAR(e.log_density, dense_log_density(data.stacked_y() + Z * shift, Z, sd), 10 * kRoundOff);
}

TEST(Evidence, AColumnThatIsIntegratedOutCountsAsIfItWereThere) {
  const TwoRuns data;
  const Eigen::VectorXd kept = Eigen::Vector2d(0.4, 1.1);
  const Eigen::VectorXd out = Eigen::Vector2d(2, 0.3);
  // The last two columns belong to each run alone: out of the grams, or side by side in one dense matrix.
  std::vector<RunGram> grams;
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(75, 6);
  for (int r = 0; r < 2; ++r) {
    grams.push_back(integrated_out(data.grams[std::size_t(r)].products, 3, out));
    Z.block(r * 30, 0, data.Z[r].rows(), 2) = data.Z[r].leftCols(2);
    Z.block(r * 30, 2 + 2 * r, data.Z[r].rows(), 2) = data.Z[r].rightCols(2);
  }
  Eigen::VectorXd sd(6);
  sd << kept, out, out;
  const Evidence e = evidence(grams, {0, 1}, {1, 2}, kept);
  EXPECT_NEAR(e.log_density, dense_log_density(data.stacked_y(), Z, sd), kRoundOff);
  Eigen::MatrixXd H = Z.transpose() * Z;
  H.diagonal() += sd.cwiseAbs2().cwiseInverse();
  const Eigen::VectorXd mean = H.ldlt().solve(Z.transpose() * data.stacked_y());
  EXPECT_LT((e.mean - mean.head(2)).norm(), kRoundOff);
}

// A wide prior for one column, or a narrow one: the data's density is their mean, and what is estimated is under the
// prior that the data speak for.
TEST(Evidence, OfSeveralPriorsIsTheirMeanDensity) {
  const TwoRuns data;
  const std::vector<int> columns{1, 2};
  const std::vector<Eigen::VectorXd> sds = with_more(
      {Eigen::VectorXd::Constant(1, 0.4), Eigen::VectorXd::Constant(1, 0.1)}, Eigen::VectorXd::Constant(1, 0.7));
  ASSERT_EQ(sds[1].size(), 2);
  EXPECT_EQ(sds[1][0], 0.1);
  EXPECT_EQ(sds[1][1], 0.7);
  const Eigen::MatrixXd Z = data.stacked(columns);
  double density[2];
  for (std::size_t i = 0; i < 2; ++i) density[i] = dense_log_density(data.stacked_y(), Z, sds[i]);
  const Evidence e = evidence(data.grams, {0, 1}, columns, sds);
  EXPECT_NEAR(e.log_density, density[0] + std::log((1 + std::exp(density[1] - density[0])) / 2), 1e-8);
  EXPECT_EQ(e.prior, std::size_t(density[1] > density[0] ? 1 : 0));
  const Evidence one = evidence(data.grams, {0, 1}, columns, sds[e.prior]);
  EXPECT_EQ(e.mean, one.mean);
  EXPECT_EQ(e.misfit, one.misfit);
}

// Tables of the chi-squared distribution.
TEST(Evidence, TailOfChiSquared) {
  EXPECT_NEAR(chi_squared_tail(6.634897, 1), 0.01, 1e-7);
  EXPECT_NEAR(chi_squared_tail(9.487729, 4), 0.05, 1e-7);
  EXPECT_EQ(chi_squared_tail(0, 3), 1);
  EXPECT_EQ(chi_squared_tail(-2, 3), 1);
}

TEST(Evidence, NothingIntegratedOutChangesNothing) {
  const TwoRuns data;
  const RunGram gram = integrated_out(data.grams[0].products, 5, Eigen::VectorXd());
  EXPECT_EQ(gram.products, data.grams[0].products);
  EXPECT_EQ(gram.log_det, 0);
}

}  // namespace
}  // namespace umbsim::gap

#include "gap/noise/track_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>

#include "core/random.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kSamples = 400;
constexpr double kStep_m = 0.02;

const NoiseModel kNoise{4e-6, 3e-7, 2e-7, 4e-4, 6e-4, 1e-6};

/// An S-bend with a turn on the spot in the middle.
std::vector<Pose2> bent_path() {
  std::vector<Pose2> path{{0.3, -0.2, 0.4}};
  for (std::size_t k = 1; k < kSamples; ++k) {
    const bool spot = k > 180 && k < 220;
    path.push_back(path.back() * arc(spot ? 0 : kStep_m, spot ? 0.04 : (k < 180 ? 0.005 : -0.008)));
  }
  return path;
}

std::vector<double> rolled(const std::vector<Pose2>& path) {
  std::vector<double> result(path.size(), 0.0);
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Pose2 u = inverse(path[k - 1]) * path[k];
    result[k] = std::hypot(u.x_m, u.y_m) + 0.17 * std::abs(u.theta_rad);
  }
  return result;
}

/// The robot as it would go: small random motions at every step, composed exactly, and a tracker that sees it with
/// noise. Nothing of the filter is used.
std::vector<Pose2> noisy_drive(const std::vector<Pose2>& path, const std::vector<double>& rolled_m,
                               std::uint64_t seed) {
  RandomStream random(seed, "drive");
  Pose2 at = path[0] * Pose2{random.normal(0, 0.01), random.normal(0, 0.01), random.normal(0, 0.01)};
  std::vector<Pose2> seen;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (k > 0) {
      const Pose2 u = inverse(path[k - 1]) * path[k];
      at = at * u *
           Pose2{random.normal(0, std::sqrt(kNoise.along_m2_pm * rolled_m[k])),
                 random.normal(0, std::sqrt(kNoise.across_m2_pm * rolled_m[k])),
                 random.normal(0, std::sqrt(kNoise.heading_rad2_pm * rolled_m[k]))};
    }
    seen.push_back({at.x_m + random.normal(0, kNoise.position_sd_m), at.y_m + random.normal(0, kNoise.position_sd_m),
                    at.theta_rad + random.normal(0, kNoise.heading_sd_rad)});
  }
  return seen;
}

Eigen::VectorXd random_column(std::uint64_t seed) {
  RandomStream random(seed, "column");
  Eigen::VectorXd column(3 * Eigen::Index(kSamples));
  for (Eigen::Index i = 0; i < column.size(); ++i) column[i] = random.normal();
  return column;
}

TEST(TrackError, IsTheMotionFromPredictedToActual) {
  const std::vector<Pose2> predicted{{1, 2, M_PI / 2}};
  const std::vector<Pose2> actual{{1.1, 2.3, M_PI / 2 + 0.05}};
  // Facing +y: 0.3 m further along, 0.1 m to the right.
  const Eigen::Vector3d expected(0.3, -0.1, 0.05);
  EXPECT_LT((track_error(predicted, actual) - expected).norm(), 1e-12);
}

TEST(TrackFilter, WhitensTheNoiseItIsTold) {
  const std::vector<Pose2> path = bent_path();
  const std::vector<double> rolled_m = rolled(path);
  const TrackFilter filter(path, rolled_m, kNoise);
  constexpr int kDrives = 40;
  double squares = 0, lag_products = 0, neighbours = 0, count = 0;
  for (int d = 0; d < kDrives; ++d) {
    const Eigen::VectorXd white = filter.whiten(track_error(path, noisy_drive(path, rolled_m, std::uint64_t(d))));
    // The first sample holds the start pose, drawn more narrowly than the filter's prior.
    for (Eigen::Index i = 3; i < white.size(); ++i) squares += white[i] * white[i];
    for (Eigen::Index i = 6; i < white.size(); ++i) lag_products += white[i] * white[i - 3];
    for (Eigen::Index i = 4; i < white.size(); ++i) neighbours += white[i] * white[i - 1];
    count += double(white.size() - 3);
  }
  // Standard errors of a mean square of normal numbers and of a mean product; four of them.
  EXPECT_NEAR(squares / count, 1, 4 * std::sqrt(2 / count));
  EXPECT_NEAR(lag_products / count, 0, 4 / std::sqrt(count));
  EXPECT_NEAR(neighbours / count, 0, 4 / std::sqrt(count));
}

TEST(TrackFilter, WrongNoiseIsNotWhite) {
  const std::vector<Pose2> path = bent_path();
  const std::vector<double> rolled_m = rolled(path);
  NoiseModel doubled = kNoise;
  doubled.position_sd_m *= 2;
  doubled.heading_sd_rad *= 2;
  const Eigen::VectorXd error = track_error(path, noisy_drive(path, rolled_m, 1));
  const Eigen::VectorXd white = TrackFilter(path, rolled_m, doubled).whiten(error);
  EXPECT_LT(white.tail(white.size() - 3).squaredNorm() / double(white.size() - 3), 0.7);
}

// The quadratic form and the determinant of the filter are those of the joint normal distribution of the whole track.
TEST(TrackFilter, HasTheDensityOfTheWholeTrack) {
  constexpr std::size_t n = 12;
  std::vector<Pose2> path = bent_path();
  path.erase(path.begin(), path.begin() + 175);
  path.resize(n);
  const std::vector<double> rolled_m = rolled(path);
  const TrackFilter filter(path, rolled_m, kNoise);
  // Covariance from the definition: every impulse of process noise carried to every later sample by finite poses.
  const Eigen::Index rows = 3 * Eigen::Index(n);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(rows, rows);
  const auto add = [&](std::size_t from, int axis, double variance) {
    constexpr double kTiny = 1e-6;
    Eigen::VectorXd effect = Eigen::VectorXd::Zero(rows);
    const Pose2 impulse{axis == 0 ? kTiny : 0, axis == 1 ? kTiny : 0, axis == 2 ? kTiny : 0};
    for (std::size_t k = from; k < n; ++k) {
      const Pose2 moved = inverse(path[from]) * path[k];
      const Pose2 e = inverse(moved) * impulse * moved;
      effect.segment<3>(3 * Eigen::Index(k)) << e.x_m / kTiny, e.y_m / kTiny, e.theta_rad / kTiny;
    }
    C += variance * effect * effect.transpose();
  };
  constexpr double kStart_m = 0.02, kStart_rad = 0.2;  // the filter's prior of the start
  add(0, 0, kStart_m * kStart_m);
  add(0, 1, kStart_m * kStart_m);
  add(0, 2, kStart_rad * kStart_rad);
  for (std::size_t k = 1; k < n; ++k) {
    add(k, 0, kNoise.along_m2_pm * rolled_m[k]);
    add(k, 1, kNoise.across_m2_pm * rolled_m[k]);
    add(k, 2, kNoise.heading_rad2_pm * rolled_m[k]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Eigen::Index row = 3 * Eigen::Index(k);
    C(row, row) += kNoise.position_sd_m * kNoise.position_sd_m;
    C(row + 1, row + 1) += kNoise.position_sd_m * kNoise.position_sd_m;
    C(row + 2, row + 2) += kNoise.heading_sd_rad * kNoise.heading_sd_rad;
  }
  const Eigen::VectorXd y = 1e-3 * random_column(5).head(rows);
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(C);
  const double quadratic = y.dot(ldlt.solve(y));
  // Finite impulses are off by their size times the heading change; condition number 1e4.
  EXPECT_NEAR(filter.whiten(y).squaredNorm(), quadratic, 1e-4 * quadratic);
  EXPECT_NEAR(filter.log_det(), ldlt.vectorD().array().log().sum(), 1e-3);
}

TEST(TrackFilter, WhitensColumnsAlikeAndLinearly) {
  const std::vector<Pose2> path = bent_path();
  const TrackFilter filter(path, rolled(path), kNoise);
  const Eigen::VectorXd a = random_column(1), b = random_column(2);
  Eigen::MatrixXd both(a.size(), 2);
  both << a, b;
  const Eigen::MatrixXd white = filter.whiten(both);
  const Eigen::VectorXd sum = filter.whiten(Eigen::VectorXd(2 * a - 3 * b));
  const double scale = white.norm();
  EXPECT_LT((sum - (2 * white.col(0) - 3 * white.col(1))).norm(), 1e-12 * scale);
  EXPECT_LT((filter.whiten(a) - white.col(0)).norm(), 1e-14 * scale);
}

TEST(TrackFilter, ImpulseProductsAreThoseOfThePropagatedImpulse) {
  const std::vector<Pose2> path = bent_path();
  const TrackFilter filter(path, rolled(path), kNoise);
  const Eigen::VectorXd white = filter.whiten(random_column(3));
  const TrackFilter::ImpulseProducts products = filter.impulse_products(white);
  for (const std::size_t k : {std::size_t(0), std::size_t(1), std::size_t(190), std::size_t(219), kSamples - 1}) {
    SCOPED_TRACE(k);
    Eigen::MatrixXd columns(white.size(), 3);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Eigen::Vector3d> impulses(kSamples, Eigen::Vector3d::Zero());
      impulses[k][axis] = 1;
      columns.col(axis) = filter.whiten(filter.propagate(impulses));
    }
    const Eigen::Vector3d with_column = columns.transpose() * white;
    const Eigen::Matrix3d with_itself = columns.transpose() * columns;
    EXPECT_LT((products.with_column[k] - with_column).norm(), 1e-9 * with_column.norm());
    EXPECT_LT((products.with_itself[k] - with_itself).norm(), 1e-9 * with_itself.norm());
  }
}

// What an impulse does to the track is what it does to the poses themselves.
TEST(TrackFilter, PropagatesLikePoses) {
  const std::vector<Pose2> path = bent_path();
  const TrackFilter filter(path, rolled(path), kNoise);
  constexpr std::size_t at = 100;
  constexpr double kSmall = 1e-5;
  std::vector<Eigen::Vector3d> impulses(kSamples, Eigen::Vector3d::Zero());
  impulses[at] = kSmall * Eigen::Vector3d(1, -2, 1.5);
  std::vector<Pose2> kicked(path.begin(), path.begin() + at);
  const Pose2 off = path[at] * Pose2{impulses[at][0], impulses[at][1], impulses[at][2]};
  for (std::size_t k = at; k < kSamples; ++k) kicked.push_back(off * (inverse(path[at]) * path[k]));
  const Eigen::VectorXd expected = track_error(path, kicked);
  // Second order in the impulse, over a path of some metres.
  EXPECT_LT((filter.propagate(impulses) - expected).lpNorm<Eigen::Infinity>(), 20 * kSmall * kSmall);
}

/// The same motions, each with its heading changed by a share of what it is and of how far it goes.
std::vector<Pose2> turned_more(const std::vector<Pose2>& path, double share) {
  std::vector<Pose2> other{path.front()};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Pose2 u = inverse(path[k - 1]) * path[k];
    other.push_back(other.back() * arc(std::hypot(u.x_m, u.y_m), u.theta_rad * (1 + share) + share * 3 * kStep_m));
  }
  return other;
}

// Unequal wheels that turn the robot by a quarter of a radian too much: the pose error is bent by the square of that,
// what this filter carries along is not.
TEST(TrackFilterError, IsLinearInWhatActsOnTheMotions) {
  const std::vector<Pose2> path = bent_path();
  const TrackFilter filter(path, rolled(path), kNoise);
  constexpr double kShare = 0.01;
  const auto little = turned_more(path, 0.1 * kShare), much = turned_more(path, kShare);
  ASSERT_GT(std::abs(track_error(path, much)(Eigen::last)), 0.2);
  const auto bent = [&](const Eigen::VectorXd& of_little, const Eigen::VectorXd& of_much) {
    return (of_much - 10 * of_little).lpNorm<Eigen::Infinity>() / of_much.lpNorm<Eigen::Infinity>();
  };
  const double carried = bent(filter.error(path, little), filter.error(path, much));
  const double poses = bent(track_error(path, little), track_error(path, much));
  std::printf("off a straight line: carried along %.1e, pose errors %.1e of the largest\n", carried, poses);
  EXPECT_LT(carried, 1e-3);
  EXPECT_GT(poses, 20 * carried);
}

// Small errors, and the tracker's noise, are the same either way.
TEST(TrackFilterError, SmallErrorsAreThePoses) {
  const std::vector<Pose2> path = bent_path();
  const std::vector<double> rolled_m = rolled(path);
  const std::vector<Pose2> seen = noisy_drive(path, rolled_m, 5);
  const Eigen::VectorXd error = track_error(path, seen);
  const TrackFilter filter(path, rolled_m, kNoise);
  EXPECT_LT((filter.error(path, seen) - error).lpNorm<Eigen::Infinity>(), 0.03 * error.lpNorm<Eigen::Infinity>());
}

// Headings that are read wrong by 0.04 rad would shorten a way of 7 m by 6 mm if their squares counted.
TEST(TrackFilterError, MisreadHeadingsAreNotSquared) {
  const std::vector<Pose2> path = bent_path();
  std::vector<Pose2> seen = path;
  RandomStream random(3, "misread");
  for (Pose2& pose : seen) pose.theta_rad += random.normal(0, 0.04);
  const Eigen::VectorXd error = TrackFilter(path, rolled(path), kNoise).error(path, seen);
  const Eigen::Vector3d last = error.tail<3>();
  std::printf("misread headings move the end by %.2f and %.2f mm\n", 1e3 * last[0], 1e3 * last[1]);
  EXPECT_LT(last.head<2>().norm(), 0.002);
}

// A total station sees no headings, whatever stands in their column: only where the robot was counts.
TEST(TrackFilterError, UnseenHeadingsTurnNoMotion) {
  const std::vector<Pose2> path = bent_path(), other = turned_more(path, 0.01);
  NoiseModel total_station = kNoise;
  total_station.heading_sd_rad = M_PI;
  EXPECT_EQ(TrackFilter(path, rolled(path), total_station).error(path, other), track_error(path, other));
}

}  // namespace
}  // namespace umbsim::gap

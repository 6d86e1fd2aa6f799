#include "gap/noise/clock.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "gap/noise/nuisances.h"
#include "recording/encoder_clock.h"

namespace umbsim::gap {
namespace {

constexpr int kRounds = 12;
constexpr int kColumns = 5;     // constant, scale of turns, drift with the way, offset, rate
constexpr double kOutlier = 3;  // in standard deviations: heavier errors count as absolute ones (Huber)
// Beyond what two clocks may be apart the fit has found something else.
constexpr double kMost_s = 0.5;
constexpr double kMostRate = 0.05;

// Heading and way by nominal odometry at a moment of the encoders' clock, with the turning speed there.
struct Reckoned {
  double heading_rad = 0;
  double way_m = 0;
  double turning_radps = 0;
};

Reckoned reckoned(const RecordedRun& run, const RecordedRobot& robot, const EncoderClock::Moment& m) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  const EncoderSample& a = run.encoders[m.before];
  const EncoderSample& b = run.encoders[m.before + 1];
  const double left = k * double(b.left_ticks - a.left_ticks);
  const double right = k * double(b.right_ticks - a.right_ticks);
  const EncoderSample& first = run.encoders.front();
  const double left_m = k * double(a.left_ticks - first.left_ticks) + m.share * left;
  const double right_m = k * double(a.right_ticks - first.right_ticks) + m.share * right;
  return {(right_m - left_m) / robot.wheelbase_m, (left_m + right_m) / 2,
          (right - left) / robot.wheelbase_m / (b.time_s - a.time_s)};
}

// One step of iterated least squares: columns and heading errors at the clock as it is fitted so far.
void linearise(const RecordedRun& run, const RecordedRobot& robot, const ClockFit& fit, Eigen::MatrixXd& A,
               Eigen::VectorXd& error) {
  EncoderClock clock(run.encoders);
  for (std::size_t k = 0; k < run.truth.size(); ++k) {
    const double t = run.truth[k].time_s;
    const Reckoned at = reckoned(run, robot, clock.at(t + fit.offset_s + fit.rate * t));
    const Eigen::Index row = Eigen::Index(k);
    A.row(row) << 1, at.heading_rad, at.way_m, at.turning_radps, at.turning_radps * t;
    error[row] = run.truth[k].X_WB.theta_rad - at.heading_rad;
  }
}

double robust_sd(const Eigen::VectorXd& x) {
  std::vector<double> size(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) size[std::size_t(i)] = std::abs(x[i]);
  std::nth_element(size.begin(), size.begin() + std::ptrdiff_t(size.size() / 2), size.end());
  return 1.4826 * size[size.size() / 2] + 1e-9;
}

}  // namespace

ClockFit fit_clock(const RecordedRun& run, const RecordedRobot& robot) {
  const Eigen::Index n = Eigen::Index(run.truth.size());
  Eigen::MatrixXd A(n, kColumns);
  Eigen::VectorXd error(n);
  Eigen::VectorXd left = Eigen::VectorXd::Constant(n, 0);
  ClockFit fit;
  for (int round = 0; round < kRounds; ++round) {
    linearise(run, robot, fit, A, error);
    const double sd = round == 0 ? 1e9 : robust_sd(left);
    const Eigen::VectorXd weight = (kOutlier * sd / left.array().abs().max(1e-12)).min(1.0);
    Eigen::MatrixXd M = A.transpose() * weight.asDiagonal() * A;
    M.diagonal() += 1e-9 * M.diagonal() + Eigen::VectorXd::Constant(kColumns, 1e-9);
    const Eigen::LDLT<Eigen::MatrixXd> solver(M);
    const Eigen::VectorXd x = solver.solve(A.transpose() * weight.cwiseProduct(error));
    left = error - A * x;
    fit.offset_s += x[3];
    fit.rate += x[4];
    const Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(kColumns, kColumns));
    fit.offset_sd_s = robust_sd(left) * std::sqrt(covariance(3, 3));
    fit.rate_sd = robust_sd(left) * std::sqrt(covariance(4, 4));
    if (std::abs(x[3]) < 1e-5 && std::abs(x[4]) < 1e-7) break;
  }
  return fit;
}

ClocksAligned with_clocks_aligned(Recording recording) {
  ClocksAligned result;
  constexpr double kStandsOut = 4;  // standard deviations; samples of a tracker are not independent
  for (RecordedRun& run : recording.runs) {
    const ClockFit fit = fit_clock(run, recording.robot);
    const bool clear =
        std::abs(fit.offset_s) > kStandsOut * fit.offset_sd_s || std::abs(fit.rate) > kStandsOut * fit.rate_sd;
    if (!clear || std::abs(fit.offset_s) > kMost_s || std::abs(fit.rate) > kMostRate) continue;
    std::vector<TruthSample> kept;
    for (TruthSample t : run.truth) {
      t.time_s += fit.offset_s + fit.rate * t.time_s;
      if (t.time_s >= run.encoders.front().time_s && t.time_s <= run.encoders.back().time_s) kept.push_back(t);
    }
    run.truth = std::move(kept);
    result.most_offset_s = std::max(result.most_offset_s, std::abs(fit.offset_s));
    result.most_rate = std::max(result.most_rate, std::abs(fit.rate));
  }
  result.recording = std::move(recording);
  return result;
}

Recording with_moments_between(Recording recording) {
  if (recording.truth_kind != "endpoints") return recording;
  constexpr double kStep_s = 0.1;
  for (RecordedRun& run : recording.runs) {
    if (run.truth.size() != 2) continue;
    const TruthSample first = run.truth.front();
    const TruthSample last = run.truth.back();
    run.truth = {first};
    for (double t = first.time_s + kStep_s; t < last.time_s - kStep_s / 2; t += kStep_s)
      run.truth.push_back({t, first.X_WB});
    run.truth.push_back(last);
  }
  return recording;
}

Recording followed_through(const Recording& given, std::vector<std::string>& limits) {
  Recording recording = with_moments_between(given);
  if (!tracker_is_free(recording) || recording.truth_kind != "track") return recording;
  ClocksAligned aligned = with_clocks_aligned(std::move(recording));
  if (aligned.most_offset_s > 0) {
    limits.push_back(
        fmt::format("the tracker's clock was moved by up to {:.0f} ms and {:.2f} % to agree with the encoders': "
                    "latency and clock cannot be told apart",
                    1000 * aligned.most_offset_s, 100 * aligned.most_rate));
  }
  return std::move(aligned.recording);
}

}  // namespace umbsim::gap

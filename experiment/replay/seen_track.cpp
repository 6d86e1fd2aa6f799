#include "experiment/replay/seen_track.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "recording/encoder_clock.h"

namespace umbsim {
namespace {

constexpr std::size_t kLeastReadings = 100;
constexpr double kWindow_s = 0.5;
constexpr double kSteady_s = 0.1;
constexpr double kSteady_radps = 0.05;
constexpr double kSteady_mps = 0.02;
constexpr double kCap = 3;  // median absolute deviations (1.48 of them: a standard deviation)
constexpr int kRounds = 3;
constexpr double kLeastSpread = 1e-4;  // m and rad: no tracker is better
constexpr std::size_t kLeastRows = 30;  // of ten steady readings: else nothing is known of clock and point
// Of clocks (s), tracked points (m) and a wrong scale before anything is seen. On a circle a point aside of the axle's
// middle, and a scale, look alike.
const Eigen::Vector4d kPriorSd(0.1, 0.05, 0.05, 0.02);

// What the tracker saw of a reading, beside the replay.
struct Reading {
  double time_s;
  Pose2 at;               // of the replay
  Eigen::Vector2d speed;  // of the replay, world frame
  double turning_radps;
  Eigen::Vector2d off_m;
  double off_rad;
};

Eigen::Matrix2d turned(double theta_rad) { return Eigen::Rotation2Dd(theta_rad).toRotationMatrix(); }

// With the tracker's clock `ahead_s` of the encoders'.
std::vector<Reading> readings_of(const RecordedRun& run, const std::vector<Pose2>& track, double ahead_s) {
  std::vector<Reading> readings;
  EncoderClock clock(run.encoders);
  for (const TruthSample& t : run.truth) {
    const auto m = clock.at(t.time_s + ahead_s);
    const Pose2 &a = track[m.before], &b = track[m.before + 1];
    const double dt = run.encoders[m.before + 1].time_s - run.encoders[m.before].time_s;
    Reading r;
    r.time_s = t.time_s;
    r.at = {m.between(a.x_m, b.x_m), m.between(a.y_m, b.y_m), m.between(a.theta_rad, b.theta_rad)};
    r.speed = Eigen::Vector2d(b.x_m - a.x_m, b.y_m - a.y_m) / dt;
    r.turning_radps = (b.theta_rad - a.theta_rad) / dt;
    r.off_m = {t.X_WB.x_m - r.at.x_m, t.X_WB.y_m - r.at.y_m};
    r.off_rad = wrap_angle(t.X_WB.theta_rad - r.at.theta_rad);
    readings.push_back(r);
  }
  return readings;
}

// Whether the replay goes on at the same speed for a tenth of a second before and after.
bool is_steady(const std::vector<Reading>& readings, std::size_t k) {
  const Reading& here = readings[k];
  for (const int way : {-1, 1}) {
    std::size_t i = k;
    while (i > 0 && i + 1 < readings.size() && std::abs(readings[i].time_s - here.time_s) < kSteady_s) {
      i = std::size_t(std::ptrdiff_t(i) + way);
    }
    if (std::abs(readings[i].turning_radps - here.turning_radps) > kSteady_radps) return false;
    if (std::abs(readings[i].speed.norm() - here.speed.norm()) > kSteady_mps) return false;
  }
  return true;
}

// Seconds that the tracker's clock is ahead, and where the tracked point lies on the robot.
struct Tracker {
  double ahead_s = 0;
  Eigen::Vector2d point_m = Eigen::Vector2d::Zero();
};

// From what changes between steady readings, half a second apart or more: by speeds that change, by a point that swings
// round, by a wrong scale. What a heading that is off makes of the way between is known.
Tracker tracker_of(const std::vector<Reading>& readings) {
  std::vector<Eigen::Matrix<double, 1, 5>> rows;  // ahead, point, scale; seen
  for (std::size_t i = 0, k = 0; k < readings.size(); ++k) {
    const Reading &a = readings[i], &b = readings[k];
    if (b.time_s - a.time_s < kWindow_s || !is_steady(readings, k)) continue;
    const Eigen::Vector2d way(b.at.x_m - a.at.x_m, b.at.y_m - a.at.y_m);
    const Eigen::Vector2d seen = b.off_m - a.off_m - (turned(a.off_rad) * way - way);
    const Eigen::Matrix2d swung = turned(b.at.theta_rad) - turned(a.at.theta_rad);
    for (int j = 0; j < 2; ++j) {
      rows.emplace_back();
      rows.back() << b.speed[j] - a.speed[j], swung.row(j), way[j], seen[j];
    }
    rows.emplace_back();
    rows.back() << b.turning_radps - a.turning_radps, 0, 0, 0, b.off_rad - a.off_rad;
    i = k;
  }
  if (rows.size() < kLeastRows) return {};
  Eigen::MatrixXd A(rows.size(), 5);
  for (std::size_t i = 0; i < rows.size(); ++i) A.row(Eigen::Index(i)) = rows[i];
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(A.rows());
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  double spread = kLeastSpread;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd W = A.leftCols<4>().transpose() * weight.asDiagonal();
    Eigen::Matrix4d normal = W * A.leftCols<4>();
    normal.diagonal() += (spread / kPriorSd.array()).square().matrix();
    x = normal.ldlt().solve(W * A.col(4));
    const Eigen::VectorXd left = (A.col(4) - A.leftCols<4>() * x).cwiseAbs();
    std::vector<double> sorted(left.data(), left.data() + left.size());
    const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    spread = 1.48 * std::max(*middle, kLeastSpread);
    const double cap = kCap * spread;
    for (Eigen::Index i = 0; i < left.size(); ++i) weight[i] = left[i] > cap ? cap / left[i] : 1;
  }
  return {x[0], {x[1], x[2]}};
}

}  // namespace

std::vector<Pose2> seen_beside(const RecordedRun& run, const std::vector<Pose2>& track, std::size_t every) {
  if (run.truth.size() < kLeastReadings) return {};
  const Tracker tracker = tracker_of(readings_of(run, track, 0));
  const std::vector<Reading> readings = readings_of(run, track, tracker.ahead_s);
  std::vector<Pose2> seen;
  std::size_t first = 0, end = 0;
  for (std::size_t i = 0; i < track.size(); i += every) {
    const double time_s = run.encoders[i].time_s;
    while (end < readings.size() && readings[end].time_s <= time_s + 1e-9) ++end;
    while (first < end && readings[first].time_s < time_s - kWindow_s) ++first;
    if (first == end) {
      seen.push_back(seen.empty() ? Pose2{} : seen.back());
      continue;
    }
    Eigen::Vector2d off_m = Eigen::Vector2d::Zero();
    double off_rad = 0;
    for (std::size_t k = first; k < end; ++k) {
      const Reading& r = readings[k];
      off_m += r.off_m - turned(r.at.theta_rad) * tracker.point_m;
      off_rad += r.off_rad;
    }
    off_m /= double(end - first);
    off_rad /= double(end - first);
    const Pose2& at = track[i];
    seen.push_back(Pose2{at.x_m + off_m.x(), at.y_m + off_m.y(), at.theta_rad + off_rad} * inverse(at));
  }
  return seen;
}

}  // namespace umbsim

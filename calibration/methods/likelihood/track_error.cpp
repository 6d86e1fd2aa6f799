#include "calibration/methods/likelihood/track_error.h"

#include <algorithm>

namespace umbsim::calibration {
namespace {

Eigen::Vector2d place(const Pose2& p) { return {p.x_m, p.y_m}; }
Eigen::Vector2d turned_left(const Eigen::Vector2d& v) { return {-v[1], v[0]}; }

}  // namespace

TrackError::TrackError(const TrainingRun& run, const OdometryParameters& nominal, std::size_t most)
    : run_(run), nominal_(nominal) {
  const std::vector<TruthSample>& truth = run.run->truth;
  if (!run.tracked()) {
    nodes_ = {truth.front(), truth.back()};
    nodes_[0].time_s = run.run->encoders.front().time_s;
    nodes_[1].time_s = run.run->encoders.back().time_s;
    return;
  }
  const std::size_t n = std::min(most, truth.size());
  for (std::size_t k = 0; k < n; ++k) nodes_.push_back(truth[k * (truth.size() - 1) / (n - 1)]);
}

TrackError::Linearised TrackError::at(const double* robot, const double* tracker, const double* start) const {
  Linearised l;
  std::vector<double> since_s, times_s;
  for (const TruthSample& t : nodes_) {
    since_s.push_back(t.time_s - nodes_.front().time_s);
    times_s.push_back(t.time_s + start[3] + tracker[3] * since_s.back());
  }
  std::sort(times_s.begin(), times_s.end());  // a trial step may let the clock run backwards
  OdometryParameters odometry = scaled(nominal_, {robot[0], robot[1], robot[2]});
  odometry.scrub = robot[3];
  l.at = travel(*run_.run, odometry, times_s);
  const Eigen::Index n = Eigen::Index(nodes_.size());
  l.error.resize(3 * n);
  l.by = Eigen::MatrixXd::Zero(3 * n, kRobotSize + kTrackerSize + kStartSize);
  const Pose2 back = inverse(Pose2{start[0], start[1], start[2]});
  const double c = std::cos(start[2]), s = std::sin(start[2]);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Travel& t = l.at[std::size_t(k)];
    const Pose2 seen = back * nodes_[std::size_t(k)].X_WB;
    const Pose2 marker = t.pose * Pose2{tracker[1], tracker[2], tracker[0]};
    l.error.segment<3>(3 * k) << seen.x_m - marker.x_m, seen.y_m - marker.y_m, seen.theta_rad - marker.theta_rad;
    const Eigen::Vector2d lever = turned_left(place(marker) - place(t.pose));
    auto by = l.by.middleRows<3>(3 * k);
    Eigen::Matrix<double, 3, kRobotSize> robot_columns;
    robot_columns << t.by_factor, t.by_scrub;
    by.leftCols<kRobotSize>() = -robot_columns;
    by.topLeftCorner<2, kRobotSize>() -= lever * robot_columns.row(2);
    by(2, kRobotSize) = -1;
    const double cb = std::cos(t.pose.theta_rad), sb = std::sin(t.pose.theta_rad);
    by.block<2, 2>(0, kRobotSize + 1) << -cb, sb, -sb, -cb;
    Eigen::Vector3d by_time = -t.velocity;
    by_time.head<2>() -= lever * t.velocity[2];
    by.col(kRobotSize + 3) = by_time * since_s[std::size_t(k)];
    constexpr int kStart = kRobotSize + kTrackerSize;
    by.block<2, 2>(0, kStart) << -c, -s, s, -c;
    by.block<2, 1>(0, kStart + 2) = -turned_left(place(seen));
    by(2, kStart + 2) = -1;
    by.col(kStart + 3) = by_time;
  }
  return l;
}

}  // namespace umbsim::calibration

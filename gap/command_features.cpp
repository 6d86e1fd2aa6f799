#include "gap/command_features.h"

#include <cmath>

#include <Eigen/Cholesky>

namespace umbsim::gap {
namespace {

struct Wheel {
  double gain = 0;
  double lag_s = 0;
};

// Gain from the total rotation. Lag: least squares of (commanded - counted angle) on (speed, angle, way, 1); the
// speed's coefficient is how far counts are behind.
Wheel wheel_features(const std::vector<EncoderSample>& s, double EncoderSample::*command,
                     const std::vector<std::array<double, 2>>& counts, std::size_t w) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  double commanded = 0;
  double rolled = 0;
  double counted = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double speed = s[i].*command;
    const double dt = s[i].time_s - s[i - 1].time_s;
    const double sign = speed > 0 ? 1 : speed < 0 ? -1 : 0;
    commanded += speed * dt;
    rolled += std::abs(speed) * dt;
    counted += sign * (counts[i][w] - counts[i - 1][w]);
    const Eigen::Vector4d x(speed, commanded, rolled, 1);
    A += x * x.transpose();
    b += x * (commanded - (counts[i][w] - counts[0][w]));
  }
  return {rolled > 0 ? counted / rolled - 1 : 0, A.ldlt().solve(b)[0]};
}

}  // namespace

CommandFeatures command_features(const RecordedRun& run, const std::vector<std::array<double, 2>>& counts_rad) {
  const Wheel left = wheel_features(run.encoders, &EncoderSample::left_command_radps, counts_rad, 0);
  const Wheel right = wheel_features(run.encoders, &EncoderSample::right_command_radps, counts_rad, 1);
  return {true, left.gain, right.gain, (left.lag_s + right.lag_s) / 2};
}

std::vector<std::array<double, 2>> counted_rad(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI / robot.ticks_per_revolution;
  std::vector<std::array<double, 2>> counts;
  for (const EncoderSample& s : run.encoders) counts.push_back({k * double(s.left_ticks), k * double(s.right_ticks)});
  return counts;
}

}  // namespace umbsim::gap

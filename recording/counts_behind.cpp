#include "recording/counts_behind.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace umbsim {
namespace {

constexpr double kMostByHeading_radps = 0.1;  // as much as a slope gives; a prior's standard deviation

}  // namespace

CountsBehind counts_behind(const std::vector<double>& commanded_radps, const std::vector<double>& commanded_rad,
                           const std::vector<double>& counted_rad, const std::vector<HeadingOverTime>& heading,
                           double step_rad) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Identity() * 1e-12;
  A.diagonal().tail<2>().setConstant(std::pow(step_rad / kMostByHeading_radps, 2) / 12);
  Vector6 b = Vector6::Zero();
  double in_place_rad = 0;
  for (std::size_t i = 1; i < counted_rad.size(); ++i) {
    if (heading[i].in_place) in_place_rad += commanded_rad[i] - commanded_rad[i - 1];
    Vector6 x;
    x << commanded_radps[i], commanded_rad[i], in_place_rad, 1, heading[i].ahead_s;
    A += x * x.transpose();
    b += x * (commanded_rad[i] - (counted_rad[i] - counted_rad[0]));
  }
  const Vector6 behind = A.ldlt().solve(b);
  return {behind[0], -behind.tail<2>(), behind[1], behind[1] + behind[2]};
}

std::vector<HeadingOverTime> heading_over_time(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI / robot.ticks_per_revolution * robot.wheel_radius_m / robot.wheelbase_m;
  const EncoderSample& first = run.encoders.front();
  std::vector<HeadingOverTime> heading(1);
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample& s = run.encoders[i];
    const double turned_ticks = double(s.right_ticks - first.right_ticks) - double(s.left_ticks - first.left_ticks);
    const double heading_rad = run.truth.front().X_WB.theta_rad + k * turned_ticks;
    const double dt_s = s.time_s - run.encoders[i - 1].time_s;
    const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad));
    heading.push_back({heading.back().ahead_s + dt_s * ahead, s.left_command_radps * s.right_command_radps < 0});
  }
  return heading;
}

}  // namespace umbsim

#include "gap/replay/command_response.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

// Steps by which the way over the turns of a course, eight to sixteen, is unsure: each end lies anywhere in one.
constexpr double kStepsUnsure = 1.5;

struct Wheel {
  double gain = 0;
  double lag_s = 0;
  double rolled_rad = 0;
};

// Way of a signal forwards and backwards, but for what it trembles over less than a width.
class Way {
 public:
  explicit Way(double width) : half_(width / 2) {}

  void to(double x) {
    const double at = std::clamp(at_, x - half_, x + half_);
    way_ += std::abs(at - at_);
    at_ = at;
  }

  double way() const { return way_; }

 private:
  double half_;
  double at_ = 0;
  double way_ = 0;
};

// Gain from the whole way: a controller that holds the robot at an edge between two counts makes them jump a step to
// and fro, which is no rotation. Lag: least squares of (commanded - counted angle) on (speed, angle, way, 1); the
// speed's coefficient is how far counts are behind.
Wheel wheel_features(const std::vector<EncoderSample>& s, double EncoderSample::*command,
                     const std::vector<std::array<double, 2>>& counts, std::size_t w, double step_rad) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  double commanded = 0;
  double rolled = 0;
  Way asked(step_rad);
  Way counted(step_rad);
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double speed = s[i].*command;
    const double dt = s[i].time_s - s[i - 1].time_s;
    commanded += speed * dt;
    rolled += std::abs(speed) * dt;
    asked.to(commanded);
    counted.to(counts[i][w] - counts[0][w]);
    const Eigen::Vector4d x(speed, commanded, rolled, 1);
    A += x * x.transpose();
    b += x * (commanded - (counts[i][w] - counts[0][w]));
  }
  return {asked.way() > 0 ? counted.way() / asked.way() - 1 : 0, A.ldlt().solve(b)[0], asked.way()};
}

}  // namespace

CommandResponse command_response(const RecordedRun& run, const std::vector<std::array<double, 2>>& counts_rad,
                                 double step_rad) {
  const Wheel left = wheel_features(run.encoders, &EncoderSample::left_command_radps, counts_rad, 0, step_rad);
  const Wheel right = wheel_features(run.encoders, &EncoderSample::right_command_radps, counts_rad, 1, step_rad);
  const double least_rad = std::min(left.rolled_rad, right.rolled_rad);
  return {true, left.gain, right.gain, (left.lag_s + right.lag_s) / 2,
          least_rad > 0 ? kStepsUnsure * step_rad / least_rad : 0};
}

std::vector<std::array<double, 2>> counted_rad(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI / robot.ticks_per_revolution;
  std::vector<std::array<double, 2>> counts;
  for (const EncoderSample& s : run.encoders) counts.push_back({k * double(s.left_ticks), k * double(s.right_ticks)});
  return counts;
}

}  // namespace umbsim::gap

#include "gap/replay/command_response.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

// Steps by which the way over the turns of a course, eight to sixteen, is unsure: each end lies anywhere in one.
constexpr double kStepsUnsure = 1.5;
constexpr double kMostByHeading_radps = 0.1;  // as much as a slope gives; a prior's standard deviation

struct Wheel {
  double gain = 0;
  double lag_s = 0;
  double rolled_rad = 0;
  Eigen::Vector2d by_heading_radps;
};

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Cosine and sine of the heading, summed over time, at the encoder samples: as counted, from where the truth begins.
std::vector<Eigen::Vector2d> headings(const RecordedRun& run, const RecordedRobot& robot) {
  const std::vector<std::array<double, 2>> counted = counted_rad(run, robot);
  std::vector<Eigen::Vector2d> sum{Eigen::Vector2d::Zero()};
  for (std::size_t i = 1; i < counted.size(); ++i) {
    const double turned_rad = counted[i][1] - counted[0][1] - (counted[i][0] - counted[0][0]);
    const double heading_rad = run.truth.front().X_WB.theta_rad + robot.wheel_radius_m / robot.wheelbase_m * turned_rad;
    const double dt = run.encoders[i].time_s - run.encoders[i - 1].time_s;
    sum.push_back(sum.back() + dt * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad)));
  }
  return sum;
}

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
// speed's coefficient is how far counts are behind. By heading: the same with two more, which are zero where the course
// does not tell them from the others.
Wheel wheel_features(const std::vector<EncoderSample>& s, const std::vector<Eigen::Vector2d>& heading,
                     double EncoderSample::*command, const std::vector<std::array<double, 2>>& counts, std::size_t w,
                     double step_rad) {
  Matrix6 A = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
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
    Vector6 x;
    x << speed, commanded, rolled, 1, heading[i];
    A += x * x.transpose();
    b += x * (commanded - (counts[i][w] - counts[0][w]));
  }
  const double lag_s = A.topLeftCorner<4, 4>().ldlt().solve(b.head<4>())[0];
  const double least = std::pow(step_rad / kMostByHeading_radps, 2) / 12;
  A.diagonal().tail<2>().array() += least;
  return {asked.way() > 0 ? counted.way() / asked.way() - 1 : 0, lag_s, asked.way(), -A.ldlt().solve(b).tail<2>()};
}

}  // namespace

CommandResponse command_response(const RecordedRun& run, const RecordedRobot& robot,
                                 const std::vector<std::array<double, 2>>& counts_rad, double step_rad) {
  const std::vector<Eigen::Vector2d> heading = headings(run, robot);
  const auto& s = run.encoders;
  const Wheel left = wheel_features(s, heading, &EncoderSample::left_command_radps, counts_rad, 0, step_rad);
  const Wheel right = wheel_features(s, heading, &EncoderSample::right_command_radps, counts_rad, 1, step_rad);
  const double least_rad = std::min(left.rolled_rad, right.rolled_rad);
  const double duration_s = s.back().time_s - s.front().time_s;
  CommandResponse response{true, left.gain, right.gain, (left.lag_s + right.lag_s) / 2};
  response.by_heading_radps = (left.by_heading_radps + right.by_heading_radps) / 2;
  response.gain_sd = least_rad > 0 ? kStepsUnsure * step_rad / least_rad : 0;
  response.by_heading_sd_radps = kStepsUnsure * step_rad / (duration_s / 2);  // no heading takes more than half of it
  response.speed_radps = (left.rolled_rad + right.rolled_rad) / 2 / duration_s;
  return response;
}

std::vector<std::array<double, 2>> counted_rad(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI / robot.ticks_per_revolution;
  std::vector<std::array<double, 2>> counts;
  for (const EncoderSample& s : run.encoders) counts.push_back({k * double(s.left_ticks), k * double(s.right_ticks)});
  return counts;
}

}  // namespace umbsim::gap

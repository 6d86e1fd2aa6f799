#include "gap/replay/command_response.h"

#include <algorithm>
#include <cmath>

#include "recording/counts_behind.h"

namespace umbsim::gap {
namespace {

// Steps by which the way over the turns of a course, eight to sixteen, is unsure: each end lies anywhere in one.
constexpr double kStepsUnsure = 1.5;
constexpr double kGravity_mps2 = 9.81;

struct Wheel {
  double gain = 0;
  double asked_rad = 0;
  double rolled_rad = 0;
  CountsBehind behind;
  Eigen::Vector2d speed_radps = Eigen::Vector2d::Zero();  // mean size of the command on the way, and in turns in place
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
// and fro, which is no rotation.
Wheel wheel_features(const std::vector<EncoderSample>& s, const std::vector<HeadingOverTime>& heading,
                     double EncoderSample::*command, const std::vector<std::array<double, 2>>& counts, std::size_t w,
                     double step_rad) {
  std::vector<double> speed{s.front().*command}, commanded{0}, counted{counts.front()[w]};
  Eigen::Vector2d moved_rad = Eigen::Vector2d::Zero(), moving_s = Eigen::Vector2d::Zero();
  Way asked(step_rad);
  Way turned(step_rad);
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double dt = s[i].time_s - s[i - 1].time_s;
    speed.push_back(s[i].*command);
    commanded.push_back(commanded.back() + speed.back() * dt);
    counted.push_back(counts[i][w]);
    moved_rad[heading[i].in_place] += std::abs(speed.back()) * dt;
    if (speed.back() != 0) moving_s[heading[i].in_place] += dt;
    asked.to(commanded.back());
    turned.to(counts[i][w] - counts[0][w]);
  }
  return {asked.way() > 0 ? turned.way() / asked.way() - 1 : 0, asked.way(), moved_rad.sum(),
          counts_behind(speed, commanded, counted, heading, step_rad),
          moved_rad.cwiseQuotient(moving_s.cwiseMax(1e-9))};
}

}  // namespace

CommandResponse command_response(const RecordedRun& run, const RecordedRobot& robot,
                                 const std::vector<std::array<double, 2>>& counts_rad, double step_rad) {
  const std::vector<HeadingOverTime> heading = heading_over_time(run, robot);
  const auto& s = run.encoders;
  const Wheel left = wheel_features(s, heading, &EncoderSample::left_command_radps, counts_rad, 0, step_rad);
  const Wheel right = wheel_features(s, heading, &EncoderSample::right_command_radps, counts_rad, 1, step_rad);
  const double least_rad = std::min(left.asked_rad, right.asked_rad);
  const double duration_s = s.back().time_s - s.front().time_s;
  CommandResponse response{true, left.gain, right.gain, (left.behind.lag_s + right.behind.lag_s) / 2};
  response.by_heading_radps = (left.behind.by_heading_radps + right.behind.by_heading_radps) / 2;
  for (const Wheel& w : {left, right})
    response.behind_radps += Eigen::Vector2d(w.behind.share, w.behind.share_in_place).cwiseProduct(w.speed_radps) / 2;
  response.gain_sd = least_rad > 0 ? kStepsUnsure * step_rad / least_rad : 0;
  response.by_heading_sd_radps = kStepsUnsure * step_rad / (duration_s / 2);  // no heading takes more than half of it
  response.speed_radps = (left.rolled_rad + right.rolled_rad) / 2 / duration_s;
  return response;
}

double slowed_radps(double friction_s, const RecordedRobot& robot) {
  return friction_s * kGravity_mps2 / robot.wheel_radius_m;
}

std::vector<std::array<double, 2>> counted_rad(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI / robot.ticks_per_revolution;
  std::vector<std::array<double, 2>> counts;
  for (const EncoderSample& s : run.encoders) counts.push_back({k * double(s.left_ticks), k * double(s.right_ticks)});
  return counts;
}

Eigen::Matrix2d course_axes(const RecordedRun& run) {
  const double start_rad = run.truth.front().X_WB.theta_rad;
  const double side = run.direction == "cw" ? -1 : 1;
  Eigen::Matrix2d axes;
  axes << std::cos(start_rad), -side * std::sin(start_rad),  //
      std::sin(start_rad), side * std::cos(start_rad);
  return axes;
}

}  // namespace umbsim::gap

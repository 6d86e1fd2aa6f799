#include "exchange/import/truth/mount.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/error.h"
#include "recording/encoder_clock.h"

namespace umbsim::exchange {
namespace {

constexpr double kPiece_s = 0.5;
constexpr double kWay_m = 0.5;      // below, nothing is said of where the tracked frame looks,
constexpr double kTurned_rad = 2;   // nor of where it lies
constexpr double kStraight = 0.15;  // radians in a piece that counts as straight
constexpr double kWrong_rad = 0.2;  // 11 degrees: no laboratory's alignment is so bad
constexpr double kAside_m = 0.01;

struct Moved {
  double ahead_m = 0, turn_rad = 0;  ///< by the wheels
  Pose2 tracked;
};

std::vector<Moved> pieces_of(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  std::vector<Moved> pieces;
  EncoderClock clock(run.encoders);
  const auto rolled = [&](double t) {
    const auto m = clock.at(t);
    const EncoderSample& a = run.encoders[m.before];
    const EncoderSample& b = run.encoders[m.before + 1];
    return std::pair{k * m.between(double(a.left_ticks), double(b.left_ticks)),
                     k * m.between(double(a.right_ticks), double(b.right_ticks))};
  };
  std::size_t before = 0;
  auto from = rolled(run.truth.front().time_s);
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    if (run.truth[i].time_s - run.truth[before].time_s < kPiece_s) continue;
    const auto to = rolled(run.truth[i].time_s);
    const double left = to.first - from.first, right = to.second - from.second;
    pieces.push_back(
        {(left + right) / 2, (right - left) / robot.wheelbase_m, inverse(run.truth[before].X_WB) * run.truth[i].X_WB});
    before = i;
    from = to;
  }
  return pieces;
}

// Where the tracked frame lies on the body: in a piece it moves by R(-yaw) (arc + (R(turn) - 1) lever).
struct Lever {
  double ahead_m = 0, left_m = 0, sd_m = 0;
};

Lever lever_of(const std::vector<Moved>& pieces) {
  Eigen::MatrixXd A(Eigen::Index(2 * pieces.size()), 2);
  Eigen::VectorXd y(Eigen::Index(2 * pieces.size()));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Moved& p = pieces[i];
    const double turn = p.tracked.theta_rad;
    const Pose2 rolled = arc(p.ahead_m, turn);
    const double c = std::cos(turn) - 1, s = std::sin(turn);
    const Eigen::Index row = Eigen::Index(2 * i);
    A.row(row) << c, -s;
    A.row(row + 1) << s, c;
    y[row] = p.tracked.x_m - rolled.x_m;
    y[row + 1] = p.tracked.y_m - rolled.y_m;
  }
  const Eigen::Matrix2d M = A.transpose() * A;
  const Eigen::Vector2d x = M.ldlt().solve(A.transpose() * y);
  const double rms = std::sqrt((y - A * x).squaredNorm() / double(y.size()));
  return {x[0], x[1], rms / std::sqrt(M(0, 0))};
}

}  // namespace

void check_mount(const Recording& recording, const ImportOptions& options, std::vector<std::string>& remarks) {
  std::vector<Moved> all;
  for (const RecordedRun& run : recording.runs) {
    const std::vector<Moved> pieces = pieces_of(run, recording.robot);
    all.insert(all.end(), pieces.begin(), pieces.end());
  }
  std::complex<double> along = 0;
  double way = 0, turned = 0;
  for (const Moved& p : all) {
    turned += std::abs(p.tracked.theta_rad);
    if (std::abs(p.turn_rad) > kStraight || std::abs(p.tracked.theta_rad) > kStraight) continue;
    way += std::abs(p.ahead_m);
    along += std::copysign(1.0, p.ahead_m) * std::complex<double>(p.tracked.x_m, p.tracked.y_m) *
             std::polar(1.0, -p.tracked.theta_rad / 2);
  }
  const Pose2 given = options.X_BT.value_or(Pose2{});
  // Where nothing is coherent the intake says what is wrong.
  if (way > kWay_m && std::abs(along) > 0.5 * way) {
    const double yaw = -std::arg(along);
    const double right = degrees(wrap_angle(given.theta_rad + yaw));
    if (std::abs(yaw) > kWrong_rad) {
      throw InputError(fmt::format(
          "the tracked frame does not look ahead: driving straight it moves {:.0f} degrees beside its own x axis. Give "
          "where it sits on the robot with --mount FORWARD,LEFT,DEGREES; the data say {:.1f} degrees (180: the wheels "
          "count "
          "backwards, or the frame looks back)",
          degrees(-yaw), right));
    }
    if (std::abs(yaw) > 0.02) {
      remarks.push_back(
          fmt::format("the tracked frame looks {:.1f} degrees beside the way that the robot takes; --mount "
                      "{:g},{:g},{:.1f} would set it straight",
                      degrees(yaw), given.x_m, given.y_m, right));
    }
  }
  if (turned < kTurned_rad || way < kWay_m) return;
  const Lever lever = lever_of(all);
  const double aside = std::hypot(lever.ahead_m, lever.left_m);
  if (aside < std::max(kAside_m, 5 * lever.sd_m)) return;
  remarks.push_back(
      fmt::format("the tracked point lies {:.0f} mm ahead of the axle's middle and {:.0f} mm to its left ({:.0f} mm "
                  "uncertain): the "
                  "truth must be the axle's middle; --mount {:.4f},{:.4f},{:.1f} moves it there",
                  1000 * lever.ahead_m, 1000 * lever.left_m, 2000 * lever.sd_m, given.x_m + lever.ahead_m,
                  given.y_m + lever.left_m, degrees(given.theta_rad)));
}

}  // namespace umbsim::exchange

#include "gap/noise/least_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace umbsim::gap {
namespace {

// Supports of the simulator give by 0.1 mm (docs/physics.md): of less its tracks say nothing. The heading's share is a
// choice, a third of what 0.1 mm make over a LabMate's wheelbase.
constexpr double kEngine_m = 1e-4;
constexpr double kEngine_rad = 1e-4;
// Walks far below any floor's, a choice too: 0.04 mm and 0.13 mrad over a square of 16 m.
constexpr double kEngineHeading_rad2_pm = 1e-9;
constexpr double kEngineWay_m2_pm = 1e-10;
constexpr double kEngineClock_s = 1e-6;
// Where in a step, or how far from the middle of its bounds, is anybody's guess: a uniform distribution's deviation.
const double kUniform = 1 / std::sqrt(12.0);

// Smallest difference between numbers of the track, which is how it was written. `of`: one number of a pose.
double last_digit(const Recording& recording, double Pose2::*of) {
  std::vector<double> values;
  for (const TruthSample& t : recording.runs.front().truth) values.push_back(t.X_WB.*of);
  std::sort(values.begin(), values.end());
  double smallest = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double apart = values[i] - values[i - 1];
    if (apart > 1e-12 && (smallest == 0 || apart < smallest)) smallest = apart;
  }
  return smallest;
}

// Nearly the highest acceleration along, and of turning.
std::array<double, 2> accelerations(const NominalReplay& n) {
  std::vector<double> along;
  std::vector<double> turning;
  for (std::size_t r = 0; r < n.runs(); ++r) {
    const auto& truth = n.recording->runs[r].truth;
    for (std::size_t k = 1; k < truth.size(); ++k) {
      const double dt = std::max(1e-6, truth[k].time_s - truth[k - 1].time_s);
      const Eigen::Vector3d change = n.velocity[r][k] - n.velocity[r][k - 1];
      along.push_back(std::abs(change[0]) / dt);
      turning.push_back(std::abs(change[2]) / dt);
    }
  }
  const auto high = [](std::vector<double>& x) {
    if (x.empty()) return 0.0;
    const auto at = x.begin() + std::ptrdiff_t(0.99 * double(x.size() - 1));
    std::nth_element(x.begin(), at, x.end());
    return *at;
  };
  return {high(along), high(turning)};
}

}  // namespace

NoiseModel least_noise(const NominalReplay& nominal, double reading_s) {
  const Recording& recording = *nominal.recording;
  const RecordedRobot& robot = recording.robot;
  const double tick_m = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  const double rounding_m = tick_m * kUniform;
  // A speed that changes by a T over an interval T leaves a straight line between its ends by up to a T^2 / 8.
  const std::array<double, 2> a = accelerations(nominal);
  const double between = reading_s * reading_s / 4 * kUniform;
  const auto root = [](double x, double y, double z, double u) { return std::sqrt(x * x + y * y + z * z + u * u); };
  NoiseModel least;
  least.heading_rad2_pm = kEngineHeading_rad2_pm;
  least.along_m2_pm = least.across_m2_pm = kEngineWay_m2_pm;
  least.clock_s = kEngineClock_s;
  // The middle has half of both wheels' rounding, the heading the difference over the wheelbase.
  least.position_sd_m =
      root(rounding_m / M_SQRT2, a[0] * between, last_digit(recording, &Pose2::x_m) * kUniform, kEngine_m);
  least.heading_sd_rad = root(rounding_m * M_SQRT2 / robot.wheelbase_m, a[1] * between,
                              last_digit(recording, &Pose2::theta_rad) * kUniform, kEngine_rad);
  return least;
}

}  // namespace umbsim::gap

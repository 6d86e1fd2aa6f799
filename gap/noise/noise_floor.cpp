#include "gap/noise/noise_floor.h"

#include <algorithm>
#include <cmath>

namespace umbsim::gap {

double noise_floor_m2(const NominalReplay& nominal, const NoiseModel& noise, std::size_t run) {
  const auto& path = nominal.tracks[run];
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  double sum = 0;
  double seen = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (k > 0) {
      const Eigen::Matrix3d T = error_transition(inverse(path[k - 1]) * path[k]);
      P = (T * P * T.transpose()).eval();
      P.diagonal() +=
          nominal.rolled_m[run][k] * Eigen::Vector3d(noise.along_m2_pm, noise.across_m2_pm, noise.heading_rad2_pm);
    }
    if (!nominal.seen[run][k]) continue;
    sum += P(0, 0) + P(1, 1) + 2 * noise.position_sd_m * noise.position_sd_m;
    seen += 1;
  }
  return sum / std::max(1.0, seen);
}

double noise_floor_m(const NominalReplay& nominal, const std::vector<NoiseModel>& noise) {
  double sum = 0;
  for (std::size_t r = 0; r < nominal.runs(); ++r) sum += noise_floor_m2(nominal, noise[r], r);
  return std::sqrt(sum / double(nominal.runs()));
}

double displacement_m(const std::vector<std::vector<Pose2>>& a, const std::vector<std::vector<Pose2>>& b) {
  double sum = 0;
  for (std::size_t r = 0; r < a.size(); ++r) {
    double run = 0;
    for (std::size_t k = 0; k < a[r].size(); ++k) {
      run += std::pow(a[r][k].x_m - b[r][k].x_m, 2) + std::pow(a[r][k].y_m - b[r][k].y_m, 2);
    }
    sum += run / double(std::max<std::size_t>(1, a[r].size())) / double(a.size());
  }
  return std::sqrt(sum);
}

}  // namespace umbsim::gap

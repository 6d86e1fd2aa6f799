#include "gap/noise/tracker_mount.h"

#include <cmath>
#include <utility>

namespace umbsim::gap {
namespace {

double log_density(double x, double sd) { return -0.5 * x * x / (sd * sd) - std::log(sd); }

// Log odds of a number that is known to `noise`.
double odds(double x, double noise, double exact_sd, double by_hand_sd) {
  return log_density(x, std::hypot(noise, exact_sd)) - log_density(x, std::hypot(noise, by_hand_sd));
}

// What one run's first reading says: a simulator starts where the course does, and no hand puts a robot there. Squares
// start at the origin; the heading is the start's whatever the path. A reading that is the start to the last digit was
// made to be it, and says nothing.
double odds_of_start(const NominalReplay& nominal, std::size_t run, const NoiseModel& noise, const Scatter& s) {
  const Pose2& first = nominal.recording->runs[run].truth.front().X_WB;
  const double off_rad = wrap_angle(first.theta_rad - nominal.recording->runs[run].start_heading_rad.value_or(0));
  if (off_rad == 0) return 0;
  double exact = odds(off_rad, noise.heading_sd_rad, s.exact_start_rad, s.frame_rad);
  if (nominal.origin[run]->path.shape != "square") return exact;
  for (const double off_m : {first.x_m, first.y_m})
    exact += odds(off_m, noise.position_sd_m, s.exact_marker_m, s.placed_m);
  return exact;
}

}  // namespace

void settle_trackers(Nuisances& n, const NominalReplay& nominal, const std::vector<NoiseModel>& noise, const Scatter& s,
                     const Eigen::VectorXd& mean) {
  n.mount = Eigen::VectorXd::Zero(mean.size());
  if (n.markers.empty()) return;
  double exact = 0;  // log odds
  for (const Eigen::Index marker : n.markers) {
    for (const double at_m : mean.segment(marker, 2)) exact += odds(at_m, 0, s.exact_marker_m, s.marker_m);
  }
  // Where all runs start is one placement, not as many as there are runs.
  for (std::size_t r = 0; r < nominal.runs(); ++r)
    exact += odds_of_start(nominal, r, noise[r], s) / double(nominal.runs());
  for (const Eigen::Index marker : n.markers) {
    if (exact > 0) continue;
    n.mount.segment(marker, 2) = mean.segment(marker, 2);
    n.mount[marker + 3] = mean[marker + 3];  // its heading; its clock (+ 2) is not known from late readings
  }
  // Each mounted by hand stands before its exact one.
  std::vector<Eigen::VectorXd> left;
  for (std::size_t i = exact > 0; i < n.shared_sds.size(); i += 2) left.push_back(std::move(n.shared_sds[i]));
  n.shared_sds = std::move(left);
  n.wide /= 2;
  n.of_another /= 2;
}

}  // namespace umbsim::gap

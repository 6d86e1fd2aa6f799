#include "bench/worlds/engines/planar/ground.h"

#include <cmath>

namespace umbsim::worlds::planar {
namespace {

Carried ripples(const Floor& floor, const Eigen::Vector2d& place_m) {
  Carried at;
  for (const Ripple& r : floor.ripples) {
    const double phase = r.kx_radpm * place_m.x() + r.ky_radpm * place_m.y() + r.phase_rad;
    at.height_m += r.amplitude_m * std::cos(phase);
    at.slope -= r.amplitude_m * std::sin(phase) * Eigen::Vector2d(r.kx_radpm, r.ky_radpm);
  }
  return at;
}

// The floor touches a round body off the place under its centre where it is steep.
Carried over_ripples(const Floor& floor, const Eigen::Vector2d& place_m, double radius_m) {
  if (floor.ripples.empty()) return {};
  Carried at = ripples(floor, place_m);
  at = ripples(floor, place_m + radius_m * at.slope);
  at.height_m += radius_m * (std::sqrt(1 + at.slope.squaredNorm()) - 1);
  return at;
}

}  // namespace

Carried carried(const Floor& floor, const Eigen::Vector2d& place_m, double radius_m) {
  Carried at = over_ripples(floor, place_m, radius_m);
  for (const Cable& c : floor.cables) {
    const Eigen::Vector2d along(std::cos(c.direction_rad), std::sin(c.direction_rad)), across(-along.y(), along.x());
    const Eigen::Vector2d from = place_m - Eigen::Vector2d(c.x_m, c.y_m);
    if (std::abs(from.dot(along)) > c.length_m / 2) continue;
    const double r = c.height_m / 2, arc_m = radius_m + r, off_m = from.dot(across);
    if (std::abs(off_m) >= arc_m) continue;
    const double above_m = std::sqrt(arc_m * arc_m - off_m * off_m);
    const double height_m = ripples(floor, {c.x_m, c.y_m}).height_m + above_m - (radius_m - r);
    if (height_m > at.height_m) at = {height_m, -off_m / above_m * across};
  }
  return at;
}

}  // namespace umbsim::worlds::planar

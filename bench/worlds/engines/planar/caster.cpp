#include "bench/worlds/engines/planar/caster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace umbsim::worlds::planar {
namespace {

constexpr double kBearingTwist_rad = 0.002;  // that a dry bearing gives before it turns
constexpr double kBearingDampingRatio = 0.3;

}  // namespace

CasterPart::CasterPart(const Caster& caster, const TyreLaw& law)
    : caster_(caster),
      law_(law),
      pivot_m_(flat(caster.swivels ? caster.swivel_point_m : caster.centre_m)),
      trail_m_(flat(caster.centre_m) - pivot_m_),
      swivel_rad_(caster.initial_angle_rad) {
  if (!caster.swivels) return;
  fork_kgm2_ = caster.fork.inertia_kgm2(2, 2) +
               caster.fork.mass_kg * (flat(caster.fork.com_m) - pivot_m_).squaredNorm() +
               caster.wheel_transverse_inertia_kgm2 + caster.wheel_mass_kg * trail_m_.squaredNorm();
  bearing_stiffness_ = caster.swivel_friction_nm / kBearingTwist_rad;
  bearing_damping_ = 2 * kBearingDampingRatio * std::sqrt(bearing_stiffness_ * fork_kgm2_);
}

double CasterPart::stiffest_radps(double load_n) const {
  if (!caster_.swivels) return 0;
  return std::sqrt((law_.stiffness_pm * load_n * trail_m_.squaredNorm() + bearing_stiffness_) / fork_kgm2_);
}

Eigen::Vector2d CasterPart::contact_m() const { return pivot_m_ + Eigen::Rotation2Dd(swivel_rad_) * trail_m_; }

Hold CasterPart::step(const Eigen::Vector2d& velocity_mps, double yaw_radps, double floor_friction, double load_n,
                      double step_s) {
  if (caster_.swivels) return swivel(velocity_mps, yaw_radps, floor_friction, load_n, step_s);
  if (caster_.friction <= 0) return {};
  const Eigen::Vector2d slip = velocity_mps + yaw_radps * left_of(pivot_m_);
  return {tread_.step(law_, caster_.friction, load_n, slip, 0, step_s), pivot_m_, 0};
}

// The wheel rolls freely: only its sideways force turns the fork.
Hold CasterPart::swivel(const Eigen::Vector2d& velocity_mps, double yaw_radps, double friction, double load_n,
                        double step_s) {
  const Eigen::Vector2d arm = Eigen::Rotation2Dd(swivel_rad_) * trail_m_;
  const Eigen::Vector2d ahead(std::cos(swivel_rad_), std::sin(swivel_rad_)), left = left_of(ahead);
  const Eigen::Vector2d velocity = velocity_mps + yaw_radps * left_of(pivot_m_) + fork_radps_ * left_of(arm);
  const Eigen::Vector2d force =
      tread_.step(law_, friction, load_n, {0, velocity.dot(left)}, velocity.dot(ahead), step_s).y() * left;
  const double bearing = bearing_nm(fork_radps_ - yaw_radps, step_s);
  fork_radps_ += step_s * (cross(arm, force) - bearing) / fork_kgm2_;
  swivel_rad_ += step_s * (fork_radps_ - yaw_radps);
  return {force, pivot_m_, bearing};
}

double CasterPart::bearing_nm(double swivel_radps, double step_s) {
  const double most_nm = caster_.swivel_friction_nm;
  if (most_nm <= 0) return 0;
  const double before = bearing_twist_rad_;
  bearing_twist_rad_ = std::clamp(before + step_s * swivel_radps, -kBearingTwist_rad, kBearingTwist_rad);
  const double damping = bearing_damping_ * (bearing_twist_rad_ - before) / step_s;
  return std::clamp(bearing_stiffness_ * bearing_twist_rad_ + damping, -most_nm, most_nm);
}

}  // namespace umbsim::worlds::planar

#include "bench/worlds/engines/planar/tyre.h"

#include <cmath>

namespace umbsim::worlds::planar {
namespace {

Eigen::Vector2d within(const Eigen::Vector2d& v, double limit) {
  const double length = v.norm();
  return length > limit ? Eigen::Vector2d(v * (limit / length)) : v;
}

// How fast rolling relaxes the tread, over the rate of small slip: the inverse of the steady curve, at the share
// `used` of the friction limit.
double relaxation(TyreLaw::Curve curve, double used) {
  if (curve == TyreLaw::Curve::lugre || used < 1e-6) return 1;
  return 3 * (1 - std::cbrt(1 - std::fmin(used, 1))) / used;
}

}  // namespace

Eigen::Vector2d Tread::step(const TyreLaw& law, double friction, double load_n, const Eigen::Vector2d& slip_mps,
                            double rolling_mps, double step_s) {
  if (friction <= 0 || load_n <= 0) {
    deflection_m_.setZero();
    return Eigen::Vector2d::Zero();
  }
  const double most_m = friction / law.stiffness_pm;
  const Eigen::Vector2d before = deflection_m_;
  const double rate = std::abs(rolling_mps) * law.stiffness_pm * relaxation(law.curve, before.norm() / most_m);
  const double sliding = law.curve == TyreLaw::Curve::lugre ? slip_mps.norm() / most_m : 0;
  // Implicit in the deflection: stable however fast the tread passes.
  const Eigen::Vector2d loosened(1 + step_s * (rate * law.creep_along + sliding),
                                 1 + step_s * (rate * law.creep_across + sliding));
  deflection_m_ = within((before + step_s * slip_mps).cwiseQuotient(loosened), most_m);
  const Eigen::Vector2d share = law.stiffness_pm * deflection_m_ + law.damping_spm / step_s * (deflection_m_ - before);
  return -load_n * within(share, friction);
}

}  // namespace umbsim::worlds::planar

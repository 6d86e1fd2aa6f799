#include "bench/worlds/engines/planar/supports.h"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

namespace umbsim::worlds::planar {

Supports::Supports(std::vector<Eigen::Vector2d> places_m, double weight_n, double sink_m)
    : places_m_(std::move(places_m)),
      carries_(places_m_.size(), true),
      loads_n_(places_m_.size()),
      stiffness_npm_(weight_n / (double(places_m_.size()) * sink_m)) {}

// With those that carry now; false where they cannot hold the base.
bool Supports::solve(const Eigen::Vector3d& wanted, const std::vector<double>& raised_m, Eigen::Vector3d& sink) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rest = wanted / stiffness_npm_;
  for (std::size_t i = 0; i < places_m_.size(); ++i) {
    if (!carries_[i]) continue;
    const Eigen::Vector3d arm(1, places_m_[i].x(), places_m_[i].y());
    A += arm * arm.transpose();
    rest -= arm * raised_m[i];
  }
  Eigen::Matrix3d inverse;
  bool regular = false;
  A.computeInverseWithCheck(inverse, regular, 1e-12);
  if (regular) sink = inverse * rest;
  return regular;
}

bool Supports::balance(const Pressing& pressing, const std::vector<double>& raised_m) {
  const Eigen::Vector3d wanted(pressing.weight_n, pressing.ahead_nm, pressing.left_nm);
  carries_.assign(places_m_.size(), true);
  const bool raised = std::any_of(raised_m.begin(), raised_m.end(), [](double m) { return m != 0; });
  if (raised || leans_) solve(Eigen::Vector3d::Zero(), raised_m, lean_);
  leans_ = raised;
  Eigen::Vector3d sink;
  for (std::size_t round = 0; round < places_m_.size(); ++round) {
    if (!solve(wanted, raised_m, sink)) return false;
    std::size_t worst = places_m_.size();
    for (std::size_t i = 0; i < places_m_.size(); ++i) {
      const double sink_m = sink[0] + sink[1] * places_m_[i].x() + sink[2] * places_m_[i].y() + raised_m[i];
      loads_n_[i] = carries_[i] ? stiffness_npm_ * sink_m : 0;
      if (loads_n_[i] < 0 && (worst == places_m_.size() || loads_n_[i] < loads_n_[worst])) worst = i;
    }
    if (worst == places_m_.size()) return true;
    carries_[worst] = false;
  }
  return false;
}

}  // namespace umbsim::worlds::planar

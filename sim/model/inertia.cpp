#include "sim/model/inertia.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

namespace umbsim {
namespace {

// Flat discs have izz = ixx + iyy exactly; files round to two or three digits.
constexpr double kTriangleTolerance = 0.01;

// Inertia of a point mass at r about the origin.
Eigen::Matrix3d point_inertia(double mass_kg, const Eigen::Vector3d& r) {
  return mass_kg * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
}

}  // namespace

Inertial transformed(const Inertial& body, const Eigen::Isometry3d& x_ab) {
  const Eigen::Matrix3d r = x_ab.linear();
  return {body.mass_kg, x_ab * body.com_m, r * body.inertia_kgm2 * r.transpose()};
}

Inertial lumped(const Inertial& a, const Inertial& b) {
  if (b.mass_kg == 0) return a;
  if (a.mass_kg == 0) return b;
  Inertial sum;
  sum.mass_kg = a.mass_kg + b.mass_kg;
  sum.com_m = (a.mass_kg * a.com_m + b.mass_kg * b.com_m) / sum.mass_kg;
  sum.inertia_kgm2 = a.inertia_kgm2 + point_inertia(a.mass_kg, a.com_m - sum.com_m) +  //
                     b.inertia_kgm2 + point_inertia(b.mass_kg, b.com_m - sum.com_m);
  return sum;
}

std::string inertia_fault(const Eigen::Matrix3d& inertia_kgm2) {
  if (!inertia_kgm2.allFinite()) return "inertia is not finite";
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia_kgm2, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& moments = solver.eigenvalues();  // ascending
  const auto text = [&](const char* what) {
    return fmt::format("inertia {}: principal moments {:.4g}, {:.4g}, {:.4g} kg m2", what, moments[0], moments[1],
                       moments[2]);
  };
  if (!(moments[0] > 0)) return text("is not positive definite");
  if (moments[2] > (moments[0] + moments[1]) * (1 + kTriangleTolerance)) {
    return text("breaks the triangle inequality (no moment may exceed the sum of the other two)");
  }
  return {};
}

}  // namespace umbsim

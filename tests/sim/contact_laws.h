#pragma once

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "sim/dynamics/contact_solver.h"

namespace umbsim::testing {

/// By how much a solution breaks the laws of Signorini and Coulomb and the motors' bounds, as the largest violation of
/// any of their conditions. Written from the laws themselves (signs, complementarity, maximal dissipation), not from
/// the projections that the solver iterates on. Impulses count relative to the largest one, velocities relative to
/// what that impulse does to their row.
inline double law_violation(const ContactProblem& p, const RowVector& x) {
  const RowVector w = p.A * x + p.b;
  const double impulse = 1e-9 + x.cwiseAbs().maxCoeff();
  double worst = 0;
  const auto note = [&](double violation) { worst = std::max(worst, violation); };
  for (int i = 0; i < p.contacts; ++i) {
    const int n = p.contact[i].normal;
    const double speed = impulse * p.A(n, n);
    note(-x[n] / impulse);
    note(-w[n] / speed);
    note(std::min(x[n] / impulse, w[n] / speed));  // one of them is zero
    if (p.contact[i].friction <= 0) continue;
    const double limit = p.contact[i].friction * x[n];
    const auto x_t = x.segment<2>(n + 1);
    const auto w_t = w.segment<2>(n + 1);
    const double slip = impulse * (p.A(n + 1, n + 1) + p.A(n + 2, n + 2)) / 2;
    note((x_t.norm() - limit) / impulse);
    // Friction takes out all the power it can: x_t . w_t = -limit |w_t|. Zero for a sticking contact.
    note(std::abs(x_t.dot(w_t) + limit * w_t.norm()) / (impulse * slip));
  }
  for (int i = 0; i < p.motors; ++i) {
    const auto [row, upper, lower_share] = p.motor[i];
    const double lower = lower_share * upper;
    const double speed = impulse * p.A(row, row);
    note((x[row] - upper) / impulse);
    note((lower - x[row]) / impulse);
    // Too slow only at the upper bound, too fast only at the lower one.
    note(std::min(-w[row] / speed, (upper - x[row]) / impulse));
    note(std::min(w[row] / speed, (x[row] - lower) / impulse));
  }
  return worst;
}

/// A = J M^-1 J^T + compliance for random J and M, as a mechanism with `dofs` degrees of freedom gives it.
inline RowMatrix random_delassus(RandomStream& random, int rows, int dofs, double compliance) {
  Eigen::MatrixXd J(rows, dofs);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < dofs; ++j) J(i, j) = random.normal();
  }
  Eigen::VectorXd inverse_mass(dofs);
  for (int j = 0; j < dofs; ++j) inverse_mass[j] = random.uniform(0.02, 1);
  RowMatrix A = J * inverse_mass.asDiagonal() * J.transpose();
  A.diagonal().array() += compliance;
  return (0.5 * (A + A.transpose())).eval();
}

/// 1..4 contacts, most of them with friction, then 0..2 motors, of which some can only push.
inline ContactProblem random_problem(RandomStream& random, double max_friction) {
  ContactProblem p;
  int rows = 0;
  p.contacts = 1 + int(random.uniform(0, 4));
  for (int i = 0; i < p.contacts; ++i) {
    const bool rough = random.uniform() < 0.7;
    p.contact[i] = {rows, rough ? random.uniform(0.05, max_friction) : 0};
    rows += rough ? 3 : 1;
  }
  p.motors = int(random.uniform(0, 3));
  for (int i = 0; i < p.motors; ++i)
    p.motor[i] = {rows++, random.uniform(0.05, 2), random.uniform() < 0.3 ? 0.0 : -1.0};
  p.A = random_delassus(random, rows, rows + 2, 1e-6);
  p.b.resize(rows);
  for (int i = 0; i < rows; ++i) p.b[i] = random.normal();
  for (int i = 0; i < p.contacts; ++i) p.b[p.contact[i].normal] -= 1;  // most contacts close
  return p;
}

}  // namespace umbsim::testing

#include "sim/dynamics/contact_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kTolerance = 1e-11;  // on impulses, relative to the largest one
constexpr double kGoodEnough = 1e-6;  // of Gauss-Seidel, where contacts barely slide and Newton finds no better
constexpr int kNewtonIterations = 40;
constexpr int kHalvings = 6;
constexpr int kSweeps = 3000;

constexpr int kUsualRows = 7;  // two wheels with friction, a ball without

// x = -A^-1 b by Cholesky, A = L L^T. N: number of rows at compile time where it is the usual one.
template <int N>
void solve_spd(const ContactProblem& p, RowVector& x) {
  const int n = N == Eigen::Dynamic ? int(p.b.size()) : N;
  constexpr int kStride = N == Eigen::Dynamic ? kMaxRows : N;
  const double* A = p.A.data();
  double L[kStride * kStride];  // its diagonal holds 1 / L_ii
  double y[kStride];
  for (int i = 0; i < n; ++i) {
    double* Li = L + i * kStride;
    double rest = -p.b[i];
    for (int j = 0; j < i; ++j) {
      const double* Lj = L + j * kStride;
      double sum = A[i * n + j];
      for (int k = 0; k < j; ++k) sum -= Li[k] * Lj[k];
      Li[j] = sum * Lj[j];
      rest -= Li[j] * y[j];
    }
    double square = A[i * n + i];
    for (int k = 0; k < i; ++k) square -= Li[k] * Li[k];
    Li[i] = 1 / std::sqrt(square);
    y[i] = rest * Li[i];
  }
  x.resize(n);
  for (int i = n - 1; i >= 0; --i) {
    double sum = y[i];
    for (int k = i + 1; k < n; ++k) sum -= L[k * kStride + i] * x[k];
    x[i] = sum * L[i * kStride + i];
  }
}

double scale(const RowVector& x) { return 1e-9 + x.cwiseAbs().maxCoeff(); }

bool all_stick_holds(const ContactProblem& p, const RowVector& x) {
  for (int i = 0; i < p.contacts; ++i) {
    const ContactRows& c = p.contact[i];
    if (x[c.normal] < 0) return false;
    if (c.friction > 0) {
      const double cone = c.friction * x[c.normal] * (1 + kConeSlack);
      if (x.segment<2>(c.normal + 1).squaredNorm() > cone * cone) return false;
    }
  }
  for (int i = 0; i < p.motors; ++i) {
    const BoundedRow& m = p.motor[i];
    if (x[m.row] > m.limit || x[m.row] < m.lower_share * m.limit) return false;
  }
  return true;
}

// The projection form F(x) = 0 of the three laws, and its generalised Jacobian.
struct Projection {
  const ContactProblem& p;

  double residual(const RowVector& x, RowVector& F) const { return evaluate(x, F, nullptr); }

  double evaluate(const RowVector& x, RowVector& F, RowMatrix* jacobian) const {
    const RowVector w = p.A * x + p.b;
    F.resize(x.size());
    for (int i = 0; i < p.contacts; ++i) contact_rows(p.contact[i], x, w, F, jacobian);
    for (int i = 0; i < p.motors; ++i) motor_row(p.motor[i], x, w, F, jacobian);
    return F.cwiseAbs().maxCoeff() / scale(x);
  }

  void motor_row(const BoundedRow& m, const RowVector& x, const RowVector& w, RowVector& F, RowMatrix* jac) const {
    const double r = 1 / p.A(m.row, m.row);
    const double y = x[m.row] - r * w[m.row];
    const double lower = m.lower_share * m.limit;
    const bool inside = y >= lower && y <= m.limit;
    F[m.row] = x[m.row] - std::clamp(y, lower, m.limit);
    if (!jac) return;
    jac->row(m.row).setZero();
    if (inside)
      jac->row(m.row) = r * p.A.row(m.row);
    else
      (*jac)(m.row, m.row) = 1;
  }

  void contact_rows(const ContactRows& c, const RowVector& x, const RowVector& w, RowVector& F, RowMatrix* jac) const {
    const int n = c.normal;
    const double rn = 1 / p.A(n, n);
    const double z = x[n] - rn * w[n];
    F[n] = x[n] - std::max(0.0, z);
    if (jac) {
      jac->row(n).setZero();
      if (z > 0)
        jac->row(n) = rn * p.A.row(n);
      else
        (*jac)(n, n) = 1;
    }
    if (c.friction > 0) friction_rows(c, z, rn, x, w, F, jac);
  }

  void friction_rows(const ContactRows& c, double z, double rn, const RowVector& x, const RowVector& w, RowVector& F,
                     RowMatrix* jac) const {
    const int t = c.normal + 1;
    const double rt = 2 / (p.A(t, t) + p.A(t + 1, t + 1));
    const Vector2d y = x.segment<2>(t) - rt * w.segment<2>(t);
    const double cone = c.friction * std::max(0.0, z);
    const double length = y.norm();
    if (length <= cone) {
      F.segment<2>(t) = rt * w.segment<2>(t);
      if (jac) jac->middleRows<2>(t) = rt * p.A.middleRows<2>(t);
      return;
    }
    const Vector2d direction = y / length;
    F.segment<2>(t) = x.segment<2>(t) - cone * direction;
    if (!jac) return;
    // d(cone * y/|y|) = cone/|y| (I - dd^T) dy + d * mu * dz
    const Matrix2d turn = cone / length * (Matrix2d::Identity() - direction * direction.transpose());
    jac->middleRows<2>(t) = rt * turn * p.A.middleRows<2>(t);
    jac->block<2, 2>(t, t) += Matrix2d::Identity() - turn;
    if (z > 0) {
      jac->middleRows<2>(t) += c.friction * rn * direction * p.A.row(c.normal);
      jac->block<2, 1>(t, c.normal) -= c.friction * direction;
    }
  }
};

bool newton(const ContactProblem& p, RowVector& x, SolveReport& report) {
  const Projection projection{p};
  const int rows = int(p.b.size());
  RowMatrix jacobian(rows, rows);
  RowVector F(rows), trial_F(rows);
  double norm = projection.evaluate(x, F, &jacobian);
  for (int i = 0; i < kNewtonIterations && norm > kTolerance; ++i) {
    const RowVector step = Eigen::PartialPivLU<RowMatrix>(jacobian).solve(F);
    if (!step.allFinite()) return false;
    RowVector best = x - step;
    double best_norm = projection.residual(best, trial_F);
    double fraction = 1;
    for (int k = 0; k < kHalvings && !(best_norm < norm); ++k) {
      fraction /= 2;
      const RowVector trial = x - fraction * step;
      const double trial_norm = projection.residual(trial, trial_F);
      if (trial_norm < best_norm) best = trial, best_norm = trial_norm;
    }
    x = best;
    norm = projection.evaluate(x, F, &jacobian);
    report.iterations = i + 1;
  }
  report.residual = norm;
  return norm <= kTolerance;
}

// Block projected Gauss-Seidel: slow, but it always goes on.
void gauss_seidel(const ContactProblem& p, RowVector& x) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double change = 0;
    const auto set = [&](int row, double value) {
      change = std::max(change, std::abs(value - x[row]));
      x[row] = value;
    };
    const auto velocity = [&](int row) { return p.A.row(row).dot(x) + p.b[row]; };
    for (int i = 0; i < p.contacts; ++i) {
      const ContactRows& c = p.contact[i];
      const int n = c.normal;
      set(n, std::max(0.0, x[n] - velocity(n) / p.A(n, n)));
      if (c.friction <= 0) continue;
      const double rt = 1 / (p.A(n + 1, n + 1) + p.A(n + 2, n + 2));
      Vector2d y = x.segment<2>(n + 1) - rt * Vector2d(velocity(n + 1), velocity(n + 2));
      const double cone = c.friction * x[n];
      if (y.norm() > cone) y *= cone / y.norm();
      set(n + 1, y[0]);
      set(n + 2, y[1]);
    }
    for (int i = 0; i < p.motors; ++i) {
      const int row = p.motor[i].row;
      const double limit = p.motor[i].limit;
      set(row, std::clamp(x[row] - velocity(row) / p.A(row, row), p.motor[i].lower_share * limit, limit));
    }
    if (change <= kTolerance * scale(x)) return;
  }
}

}  // namespace

SolveReport solve_contacts(const ContactProblem& problem, RowVector& x) {
  SolveReport report;
  const int rows = int(problem.b.size());
  if (rows == 0) return report;
  const RowVector warm = x.size() == rows ? x : RowVector(RowVector::Zero(rows));
  if (rows == kUsualRows)
    solve_spd<kUsualRows>(problem, x);
  else
    solve_spd<Eigen::Dynamic>(problem, x);
  if (all_stick_holds(problem, x)) return report;

  report.outcome = SolveOutcome::newton;
  const RowVector stick = x;
  for (const RowVector& start : {warm, stick}) {
    x = start;
    if (newton(problem, x, report)) return report;
  }
  gauss_seidel(problem, x);
  RowVector refined = x;
  if (newton(problem, refined, report)) {
    x = refined;
    return report;
  }
  RowVector F;
  report.residual = Projection{problem}.residual(x, F);
  if (report.residual > kGoodEnough) report.outcome = SolveOutcome::fallback;
  return report;
}

}  // namespace umbsim

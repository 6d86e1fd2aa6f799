#pragma once

#include <Eigen/Core>

namespace umbsim {

/// Rows that the solver can hold: eight contacts with friction, and eight bounded rows.
constexpr int kMaxRows = 32;
/// Relative: a stick impulse exactly on the cone is still sticking.
constexpr double kConeSlack = 1e-12;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMaxRows, kMaxRows>;
using RowVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1>;

/// What holds for the rows of one contact: row `normal`, and rows normal + 1, normal + 2 if it has friction.
struct ContactRows {
  int normal = 0;
  double friction = 0;  ///< 0: the contact has no friction rows
};

/// A row whose impulse is bounded: a motor, or the friction of a turning contact patch.
struct BoundedRow {
  int row = 0;
  double limit = 0;
  double lower_share = -1;  ///< lower_share * limit <= impulse <= limit; 0: it can only push
};

/// One time step's contact problem. Find impulses x with w = A x + b such that
///   normal rows:    x >= 0, w >= 0, x w = 0                               (Signorini)
///   friction rows:  |x_t| <= mu x_n; x_t opposes w_t where it slides      (Coulomb, the true cone)
///   bounded rows:   w = 0 unless x is at its bound
/// A: (rows, rows), symmetric positive definite: J M^-1 J^T plus the compliance of each row on its diagonal.
/// Units: impulses N s (N m s for motors), velocities m/s (rad/s for motors).
struct ContactProblem {
  RowMatrix A;
  RowVector b;
  int contacts = 0;
  ContactRows contact[8];
  int motors = 0;
  BoundedRow motor[8];
};

enum class SolveOutcome {
  stick,     ///< every contact closed and sticking, motors within their limits: one factorisation
  newton,    ///< a semi-smooth Newton iteration found the solution
  fallback,  ///< neither Newton nor projected Gauss-Seidel came below 1e-6 of the largest impulse
};

struct SolveReport {
  SolveOutcome outcome = SolveOutcome::stick;
  int iterations = 0;
  double residual = 0;  ///< natural residual, velocity units scaled to impulses
};

/// Solves the problem directly. `x` holds the last step's impulses on entry if it has the right size (a warm start).
/// Method: Cholesky for the all-sticking guess, which most steps confirm; otherwise Newton on the projection form of
/// the three laws (Alart & Curnier 1991), with projected Gauss-Seidel as the counted fallback.
SolveReport solve_contacts(const ContactProblem& problem, RowVector& x);

}  // namespace umbsim

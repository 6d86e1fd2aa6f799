#pragma once

#include "sim/multibody.h"

namespace umbsim {

/// A contact that holds: it pushes with -give (speed of its point + offset). Base frame.
struct Sticking {
  Eigen::Matrix3d give;    ///< impulse per speed
  Eigen::Vector3d offset;  ///< speed
  Eigen::Vector3d known;   ///< speed of its point before the step, with the held wheels at their set speeds
  int leg = -1;            ///< whose joints move it, too
};

/// The momentum balance of a step, (M + J^T C^-1 J) (change of u) = right: the base's six rows, and two for each leg,
/// whose joints couple to the base only. C^-1 of each contact is its tensor `give` at its place. What contacts hold is
/// 1e6 times as stiff as what they let go: solved for the change of u, not for u, the round-off of the one does not
/// show in the other.
class StickingProblem {
 public:
  StickingProblem(const HeldBody& held, const Eigen::Matrix<double, 6, 1>& given);

  void add(const MultiBody::Lever& lever, const Sticking& contact);
  /// Holds the base, which turns with `speed` about `axis`, against that, or pushes it so.
  void hold_turning(const Eigen::Vector3d& axis, double speed, double give);
  void turn(const Eigen::Vector3d& axis, double impulse);
  void hold_fork(int leg, double speed, double give) {
    leg_[leg].a += give;
    leg_[leg].right[0] -= give * speed;
  }
  void turn_fork(int leg, double impulse) { leg_[leg].right[0] += impulse; }

  /// False if the problem is not positive definite.
  bool solve();

  // What solve() found: changes of velocity.
  Eigen::Vector3d turning() const { return {right_[0], right_[1], right_[2]}; }
  Eigen::Vector3d moving() const { return {right_[3], right_[4], right_[5]}; }
  double fork_radps(int leg) const { return leg_[leg].right[0]; }
  double wheel_radps(int leg) const { return leg_[leg].right[1]; }
  /// Of the contact's point, after the step.
  Eigen::Vector3d speed(const MultiBody::Lever& lever, const Sticking& contact) const;

 private:
  struct Leg {
    double coupling[2][6];  // of fork and wheel to the base
    double carried[2][6];   // times the inverse of [a b; b d]
    double a, b, d;
    double right[2];
  };
  bool set_legs_aside();
  bool solve_base();
  void find_legs();

  double K_[6][6];  // lower half; angular, then linear
  double right_[6];
  Leg leg_[4];
  int legs_;
};

}  // namespace umbsim

#pragma once

#include "sim/dynamics/multibody.h"

namespace umbsim {

/// What a contact does as its point's speed changes in the step: it pushes with push - give (change). Base frame.
struct Sticking {
  Eigen::Matrix3d give;   ///< impulse per speed; symmetric unless the contact slides
  Eigen::Vector3d push;   ///< impulse if nothing changed
  Eigen::Vector3d known;  ///< speed of its point before the step, with the held wheels at their set speeds
  int leg = -1;           ///< whose joints move it, too
  bool slides = false;
};

/// The momentum balance of a step, (M + J^T C^-1 J) (change of u) = right: the base's six rows, and two for each leg,
/// whose joints couple to the base only. C^-1 of each contact is its tensor `give` at its place. What contacts hold is
/// 1e6 times as stiff as what they let go: solved for the change of u, not for u, the round-off of the one does not
/// show in the other.
class StickingProblem {
 public:
  /// `symmetric`: no contact slides.
  void start(const HeldBody& held, const Eigen::Matrix<double, 6, 1>& given, bool symmetric);

  void add(const MultiBody::Lever& lever, const Sticking& contact);
  /// Holds the base, which turns with `speed` about `axis`, against that, or pushes it so.
  void hold_turning(const Eigen::Vector3d& axis, double speed, double give);
  void turn(const Eigen::Vector3d& axis, double impulse);
  void hold_fork(int leg, double speed, double give) {
    leg_[leg].a += give;
    leg_[leg].right[0] -= give * speed;
  }
  void turn_fork(int leg, double impulse) { leg_[leg].right[0] += impulse; }
  void hold_wheel(int leg, double speed, double give) {
    leg_[leg].d += give;
    leg_[leg].right[1] -= give * speed;
  }
  void turn_wheel(int leg, double impulse) { leg_[leg].right[1] += impulse; }

  /// False if the problem is not positive definite.
  bool solve();

  // What solve() found: changes of velocity.
  Eigen::Vector3d turning() const { return {right_[0], right_[1], right_[2]}; }
  Eigen::Vector3d moving() const { return {right_[3], right_[4], right_[5]}; }
  double fork_radps(int leg) const { return leg_[leg].right[0]; }
  double wheel_radps(int leg) const { return leg_[leg].right[1]; }
  /// Of the contact's point.
  Eigen::Vector3d change(const MultiBody::Lever& lever, const Sticking& contact) const;

 private:
  struct Leg {
    double on_base[2][6];  // what rates of fork and wheel do to the base
    double by_base[2][6];  // and the base to them; the same unless a contact slides
    double carried[2][6];  // by_base, times the inverse of [a b; c d]
    double a, b, c, d;
    double right[2];
  };
  void add_symmetric(const Eigen::Vector3d& arm_m, const Eigen::Matrix3d& give);
  void add_any(const Eigen::Vector3d& arm_m, const Eigen::Matrix3d& give);
  void add_to_leg(const MultiBody::Lever& lever, const Sticking& contact);
  bool set_legs_aside();
  bool solve_symmetric();
  bool solve_any();
  void find_legs();

  double K_[6][6];  // angular, then linear; the lower half where it is symmetric
  double right_[6];
  Leg leg_[6];
  int legs_;
  bool symmetric_;
};

}  // namespace umbsim

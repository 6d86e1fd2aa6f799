#include "sim/dynamics/sticking.h"

#include <cmath>
#include <utility>

namespace umbsim {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void StickingProblem::start(const HeldBody& held, const Eigen::Matrix<double, 6, 1>& given, bool symmetric) {
  legs_ = held.legs;
  symmetric_ = symmetric;
  const Vector3d& c = held.all.moment_kgm;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      K_[i][j] = held.all.inertia_kgm2(i, j);
      K_[i + 3][j + 3] = i == j ? held.all.mass_kg : 0;
    }
    right_[i] = held.turning_kgm2ps[i] + given[i];
    right_[i + 3] = held.pushing_kgmps[i] + given[i + 3];
  }
  // Linear momentum of a turning base, w x c; angular of a moving one, c x v.
  K_[3][0] = K_[4][1] = K_[5][2] = K_[0][3] = K_[1][4] = K_[2][5] = 0;
  K_[3][1] = K_[1][3] = c.z(), K_[3][2] = K_[2][3] = -c.y();
  K_[4][0] = K_[0][4] = -c.z(), K_[4][2] = K_[2][4] = c.x();
  K_[5][0] = K_[0][5] = c.y(), K_[5][1] = K_[1][5] = -c.x();
  for (int l = 0; l < legs_; ++l) {
    const HeldBody::Leg& from = held.leg[l];
    Leg& to = leg_[l];
    for (int i = 0; i < 3; ++i) {
      to.on_base[0][i] = to.by_base[0][i] = from.turning[i];
      to.on_base[0][i + 3] = to.by_base[0][i + 3] = from.pushing[i];
      to.on_base[1][i] = to.by_base[1][i] = from.spinning[i];
      to.on_base[1][i + 3] = to.by_base[1][i + 3] = 0;
    }
    to.a = from.fork_kgm2, to.b = to.c = 0, to.d = from.wheel_kgm2;
    to.right[0] = from.fork_kgm2ps, to.right[1] = from.wheel_kgm2ps;
  }
}

void StickingProblem::add(const MultiBody::Lever& lever, const Sticking& contact) {
  if (symmetric_)
    add_symmetric(lever.arm_m, contact.give);
  else
    add_any(lever.arm_m, contact.give);
  const Vector3d turned = lever.arm_m.cross(contact.push);
  for (int i = 0; i < 3; ++i) right_[i] += turned[i], right_[i + 3] += contact.push[i];
  if (contact.leg >= 0) add_to_leg(lever, contact);
}

// J^T T J with J = [-[r]x 1]: columns for a turn about each axis, w x r, and for a speed along it. G = [r]x T.
void StickingProblem::add_symmetric(const Vector3d& r, const Matrix3d& T) {
  double G[3][3];
  for (int i = 0; i < 3; ++i) {
    G[0][i] = r.y() * T(2, i) - r.z() * T(1, i);
    G[1][i] = r.z() * T(0, i) - r.x() * T(2, i);
    G[2][i] = r.x() * T(1, i) - r.y() * T(0, i);
    for (int j = 0; j < 3; ++j) K_[i + 3][j] += G[j][i];
    for (int j = 0; j <= i; ++j) K_[i + 3][j + 3] += T(i, j);
  }
  for (int i = 0; i < 3; ++i) {
    K_[i][0] += r.y() * G[i][2] - r.z() * G[i][1];
    if (i > 0) K_[i][1] += r.z() * G[i][0] - r.x() * G[i][2];
    if (i > 1) K_[i][2] += r.x() * G[i][1] - r.y() * G[i][0];
  }
}

void StickingProblem::add_any(const Vector3d& r, const Matrix3d& T) {
  Vector3d moment[3];
  for (int i = 0; i < 3; ++i) {
    moment[i] = r.cross(T.col(i));
    for (int j = 0; j < 3; ++j) K_[j][i + 3] += moment[i][j], K_[j + 3][i + 3] += T(j, i);
  }
  for (int j = 0; j < 3; ++j) {
    const Vector3d by_turn = r.cross(Vector3d(moment[0][j], moment[1][j], moment[2][j]));
    const Vector3d pushed = r.cross(Vector3d(T.row(j)));
    for (int i = 0; i < 3; ++i) K_[j][i] += by_turn[i], K_[j + 3][i] += pushed[i];
  }
}

void StickingProblem::add_to_leg(const MultiBody::Lever& lever, const Sticking& contact) {
  const Vector3d& r = lever.arm_m;
  const Matrix3d& T = contact.give;
  Leg& leg = leg_[contact.leg];
  const Vector3d* joint[2] = {&lever.turn_m[1], &lever.turn_m[0]};  // the lever has the wheel first, then the fork
  for (int k = 0; k < 2; ++k) {
    const Vector3d push = T * *joint[k], pushed = T.transpose() * *joint[k];
    const Vector3d turn = r.cross(push), turned = r.cross(pushed);
    for (int i = 0; i < 3; ++i) {
      leg.on_base[k][i] += turn[i], leg.on_base[k][i + 3] += push[i];
      leg.by_base[k][i] += turned[i], leg.by_base[k][i + 3] += pushed[i];
    }
    (k == 0 ? leg.a : leg.b) += joint[0]->dot(push);
    (k == 0 ? leg.c : leg.d) += joint[1]->dot(push);
    leg.right[k] += joint[k]->dot(contact.push);
  }
}

void StickingProblem::hold_turning(const Vector3d& axis, double speed, double give) {
  turn(axis, -give * speed);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) K_[i][j] += give * axis[i] * axis[j];
  }
}

void StickingProblem::turn(const Vector3d& axis, double impulse) {
  for (int i = 0; i < 3; ++i) right_[i] += impulse * axis[i];
}

bool StickingProblem::solve() {
  if (!set_legs_aside() || !(symmetric_ ? solve_symmetric() : solve_any())) return false;
  find_legs();
  return true;
}

// Each leg's rates are [a b; c d]^-1 (right - by_base base); put into the base's rows, these stand alone.
bool StickingProblem::set_legs_aside() {
  for (int l = 0; l < legs_; ++l) {
    Leg& leg = leg_[l];
    const double determinant = leg.a * leg.d - leg.b * leg.c;
    if (!(determinant > 0)) return false;
    const double a = leg.d / determinant, b = -leg.b / determinant, c = -leg.c / determinant, d = leg.a / determinant;
    const double fork = leg.right[0], wheel = leg.right[1];
    leg.right[0] = a * fork + b * wheel;
    leg.right[1] = c * fork + d * wheel;
    for (int i = 0; i < 6; ++i) {
      leg.carried[0][i] = a * leg.by_base[0][i] + b * leg.by_base[1][i];
      leg.carried[1][i] = c * leg.by_base[0][i] + d * leg.by_base[1][i];
    }
    for (int i = 0; i < 6; ++i) {
      right_[i] -= leg.on_base[0][i] * leg.right[0] + leg.on_base[1][i] * leg.right[1];
      const int columns = symmetric_ ? i + 1 : 6;
      for (int j = 0; j < columns; ++j) {
        K_[i][j] -= leg.on_base[0][i] * leg.carried[0][j] + leg.on_base[1][i] * leg.carried[1][j];
      }
    }
  }
  return true;
}

// K = L D L^T, of the lower half.
bool StickingProblem::solve_symmetric() {
  double inverse[6];
  for (int i = 0; i < 6; ++i) {
    double* Ki = K_[i];
    double diagonal = Ki[i];
    for (int j = 0; j < i; ++j) {
      for (int k = 0; k < j; ++k) Ki[j] -= Ki[k] * K_[j][k];
    }
    for (int j = 0; j < i; ++j) {
      const double scaled = Ki[j] * inverse[j];
      diagonal -= Ki[j] * scaled;
      right_[i] -= scaled * right_[j];
      Ki[j] = scaled;
    }
    if (!(diagonal > 0)) return false;
    inverse[i] = 1 / diagonal;
  }
  for (int i = 5; i >= 0; --i) {
    right_[i] *= inverse[i];
    for (int k = i + 1; k < 6; ++k) right_[i] -= K_[k][i] * right_[k];
  }
  return true;
}

// Elimination with rows exchanged: where contacts slide K is not symmetric, and pivots on its diagonal may have any
// sign.
bool StickingProblem::solve_any() {
  double inverse[6];
  for (int k = 0; k < 6; ++k) {
    int pivot = k;
    for (int i = k + 1; i < 6; ++i) {
      if (std::abs(K_[i][k]) > std::abs(K_[pivot][k])) pivot = i;
    }
    if (!(std::abs(K_[pivot][k]) > 0)) return false;
    if (pivot != k) {
      std::swap(K_[pivot], K_[k]);
      std::swap(right_[pivot], right_[k]);
    }
    inverse[k] = 1 / K_[k][k];
    for (int i = k + 1; i < 6; ++i) {
      const double factor = K_[i][k] * inverse[k];
      for (int j = k + 1; j < 6; ++j) K_[i][j] -= factor * K_[k][j];
      right_[i] -= factor * right_[k];
    }
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) right_[i] -= K_[i][k] * right_[k];
    right_[i] *= inverse[i];
  }
  return true;
}

void StickingProblem::find_legs() {
  for (int l = 0; l < legs_; ++l) {
    for (int i = 0; i < 6; ++i) {
      leg_[l].right[0] -= leg_[l].carried[0][i] * right_[i];
      leg_[l].right[1] -= leg_[l].carried[1][i] * right_[i];
    }
  }
}

Vector3d StickingProblem::change(const MultiBody::Lever& lever, const Sticking& contact) const {
  const Vector3d change = moving() + turning().cross(lever.arm_m);
  if (contact.leg < 0) return change;
  return change + wheel_radps(contact.leg) * lever.turn_m[0] + fork_radps(contact.leg) * lever.turn_m[1];
}

}  // namespace umbsim

#include "sim/sticking.h"

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

StickingProblem::StickingProblem(const HeldBody& held, const Eigen::Matrix<double, 6, 1>& given) : legs_(held.legs) {
  const Matrix3d& I = held.all.inertia_kgm2;
  const Vector3d& c = held.all.moment_kgm;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      K_[i][j] = I(i, j);
      K_[i + 3][j + 3] = i == j ? held.all.mass_kg : 0;
    }
    right_[i] = held.turning_kgm2ps[i] + given[i];
    right_[i + 3] = held.pushing_kgmps[i] + given[i + 3];
  }
  // Linear momentum of a turning base: w x c.
  K_[3][0] = K_[4][1] = K_[5][2] = 0;
  K_[3][1] = c.z(), K_[3][2] = -c.y();
  K_[4][0] = -c.z(), K_[4][2] = c.x();
  K_[5][0] = c.y(), K_[5][1] = -c.x();
  for (int l = 0; l < legs_; ++l) {
    const HeldBody::Leg& from = held.leg[l];
    Leg& to = leg_[l];
    for (int i = 0; i < 3; ++i) {
      to.coupling[0][i] = from.turning[i];
      to.coupling[0][i + 3] = from.pushing[i];
      to.coupling[1][i] = from.spinning[i];
      to.coupling[1][i + 3] = 0;
    }
    to.a = from.fork_kgm2, to.b = 0, to.d = from.wheel_kgm2;
    to.right[0] = from.fork_kgm2ps, to.right[1] = from.wheel_kgm2ps;
  }
}

// J^T give J with J = [-[arm]x 1].
void StickingProblem::add(const MultiBody::Lever& lever, const Sticking& contact) {
  const Vector3d& r = lever.arm_m;
  const Matrix3d& T = contact.give;
  for (int i = 0; i < 3; ++i) {
    const Vector3d turn = r.cross(T.col(i));  // a force along axis i is the answer to a speed along it
    for (int j = 0; j < 3; ++j) K_[i + 3][j] += turn[j];
    for (int j = 0; j <= i; ++j) K_[i + 3][j + 3] += T(i, j);
  }
  const Matrix3d G = (Matrix3d() << r.cross(T.col(0)), r.cross(T.col(1)), r.cross(T.col(2))).finished();
  for (int i = 0; i < 3; ++i) {
    const Vector3d row = r.cross(Vector3d(G.row(i)));
    for (int j = 0; j <= i; ++j) K_[i][j] += row[j];
  }
  const Vector3d force = -(T * (contact.known + contact.offset)), moment = r.cross(force);
  for (int i = 0; i < 3; ++i) right_[i] += moment[i], right_[i + 3] += force[i];
  if (contact.leg < 0) return;
  Leg& leg = leg_[contact.leg];
  const Vector3d &wheel = lever.turn_m[0], &fork = lever.turn_m[1];
  const Vector3d by_wheel = T * wheel, by_fork = T * fork;
  const Vector3d turn_wheel = r.cross(by_wheel), turn_fork = r.cross(by_fork);
  for (int i = 0; i < 3; ++i) {
    leg.coupling[0][i] += turn_fork[i], leg.coupling[0][i + 3] += by_fork[i];
    leg.coupling[1][i] += turn_wheel[i], leg.coupling[1][i + 3] += by_wheel[i];
  }
  leg.a += fork.dot(by_fork), leg.b += fork.dot(by_wheel), leg.d += wheel.dot(by_wheel);
  leg.right[0] += fork.dot(force), leg.right[1] += wheel.dot(force);
}

void StickingProblem::hold_turning(const Vector3d& axis, double speed, double give) {
  turn(axis, -give * speed);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) K_[i][j] += give * axis[i] * axis[j];
  }
}

void StickingProblem::turn(const Vector3d& axis, double impulse) {
  for (int i = 0; i < 3; ++i) right_[i] += impulse * axis[i];
}

bool StickingProblem::solve() {
  if (!set_legs_aside() || !solve_base()) return false;
  find_legs();
  return true;
}

// Each leg's rates are [a b; b d]^-1 (right - coupling^T base); put into the base's rows, these stand alone.
bool StickingProblem::set_legs_aside() {
  for (int l = 0; l < legs_; ++l) {
    Leg& leg = leg_[l];
    const double determinant = leg.a * leg.d - leg.b * leg.b;
    if (!(determinant > 0)) return false;
    const double a = leg.d / determinant, b = -leg.b / determinant, d = leg.a / determinant;
    for (int i = 0; i < 6; ++i) {
      leg.carried[0][i] = a * leg.coupling[0][i] + b * leg.coupling[1][i];
      leg.carried[1][i] = b * leg.coupling[0][i] + d * leg.coupling[1][i];
      right_[i] -= leg.carried[0][i] * leg.right[0] + leg.carried[1][i] * leg.right[1];
      for (int j = 0; j <= i; ++j) {
        K_[i][j] -= leg.carried[0][i] * leg.coupling[0][j] + leg.carried[1][i] * leg.coupling[1][j];
      }
    }
    const double fork = leg.right[0], wheel = leg.right[1];
    leg.right[0] = a * fork + b * wheel;
    leg.right[1] = b * fork + d * wheel;
  }
  return true;
}

// K = L D L^T.
bool StickingProblem::solve_base() {
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

void StickingProblem::find_legs() {
  for (int l = 0; l < legs_; ++l) {
    for (int i = 0; i < 6; ++i) {
      leg_[l].right[0] -= leg_[l].carried[0][i] * right_[i];
      leg_[l].right[1] -= leg_[l].carried[1][i] * right_[i];
    }
  }
}

Vector3d StickingProblem::speed(const MultiBody::Lever& lever, const Sticking& contact) const {
  const Vector3d speed = contact.known + moving() + turning().cross(lever.arm_m);
  if (contact.leg < 0) return speed;
  return speed + wheel_radps(contact.leg) * lever.turn_m[0] + fork_radps(contact.leg) * lever.turn_m[1];
}

}  // namespace umbsim

#include "bench/fidelity/plane_dynamics.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace umbsim::fidelity {
namespace {

// x, y, heading of the centre of mass; its velocity (base frame), yaw rate; left and right wheel speed.
using State = Eigen::Matrix<double, 8, 1>;
using Jacobian = Eigen::Matrix<double, 8, 8>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Eigen::Vector2d;

constexpr double kSmooth_mps = 1e-5;
constexpr double kStep_s = 2e-4;
constexpr double kNewton = 1e-12;
constexpr double kDifference = 1e-8;

struct Contact {
  Vector2d arm_m;            // from the centre of mass, base frame
  Vector2d force_per_load;   // of the floor on the robot
};

struct Derivative {
  State rate;
  double least_load_n;
};

Contact contact(const SlopeCase& c, const State& y, int i) {
  const Body& b = c.body;
  const Vector2d at = i < 2 ? Vector2d(0, i == 0 ? b.half_m : -b.half_m) : Vector2d(b.ball_x_m, b.ball_y_m);
  const Vector2d arm = at - b.com_m.head<2>();
  Vector2d slip(y[3] - y[5] * arm.y(), y[4] + y[5] * arm.x());
  if (i < 2) slip.x() -= b.radius_m * y[6 + i];
  const double friction = i < 2 ? c.friction : b.ball_friction;
  return {arm, -friction * slip / std::sqrt(slip.squaredNorm() + kSmooth_mps * kSmooth_mps)};
}

// Unknowns: acceleration of the centre of mass (base frame), yaw acceleration, three loads. Newton's and Euler's
// equations of one rigid body with two spinning wheels, about the centre of mass:
//   I_xz a - I_yz w^2 - w H = M_x,   I_yz a + I_xz w^2 + H' = M_y,   I_zz a = M_z,   H = I_spin (left + right speed)
Derivative derivative(const SlopeCase& c, const State& y) {
  const Body& b = c.body;
  const Eigen::Matrix3d& I = b.inertia_kgm2;
  const double w = y[5], height_m = b.com_m.z();
  const double along = kG_mps2 * std::sin(c.slope_rad);
  Matrix6 A = Matrix6::Zero();
  Vector6 rhs;
  A(0, 0) = A(1, 1) = b.mass_kg;
  A(3, 2) = I(0, 2);
  A(4, 2) = I(1, 2);
  A(5, 2) = I(2, 2);
  Contact at[3];
  for (int i = 0; i < 3; ++i) {
    at[i] = contact(c, y, i);
    const Vector2d &r = at[i].arm_m, &f = at[i].force_per_load;
    const double spin_up = i < 2 && !c.braked[i] ? -b.radius_m * f.x() : 0;  // I_spin times wheel acceleration
    A.col(3 + i) << -f.x(), -f.y(), 1, -(r.y() + height_m * f.y()), r.x() + height_m * f.x() + spin_up,
        -(r.x() * f.y() - r.y() * f.x());
  }
  rhs << b.mass_kg * along * std::cos(y[2]), -b.mass_kg * along * std::sin(y[2]),
      b.mass_kg * kG_mps2 * std::cos(c.slope_rad), I(1, 2) * w * w + w * b.spin_kgm2 * (y[6] + y[7]),
      -I(0, 2) * w * w, 0;
  const Vector6 x = Eigen::PartialPivLU<Matrix6>(A).solve(rhs);
  Derivative d;
  d.rate << std::cos(y[2]) * y[3] - std::sin(y[2]) * y[4], std::sin(y[2]) * y[3] + std::cos(y[2]) * y[4], w,
      x[0] + w * y[4], x[1] - w * y[3], x[2], 0, 0;
  for (int i = 0; i < 2; ++i) {
    if (!c.braked[i]) d.rate[6 + i] = -b.radius_m * at[i].force_per_load.x() * x[3 + i] / b.spin_kgm2;
  }
  d.least_load_n = x.tail<3>().minCoeff();
  return d;
}

// Solves Y = base + h f(Y) by Newton's method with a line search, from `guess`.
State implicit_stage(const SlopeCase& c, const State& base, double h, State guess) {
  const auto residual = [&](const State& y) -> State { return y - base - h * derivative(c, y).rate; };
  State F = residual(guess);
  for (int i = 0; i < 50 && F.norm() > kNewton; ++i) {
    Jacobian J;
    for (int k = 0; k < 8; ++k) {
      State moved = guess;
      moved[k] += kDifference;
      J.col(k) = (residual(moved) - F) / kDifference;
    }
    const State step = Eigen::PartialPivLU<Jacobian>(J).solve(F);
    double part = 1;
    State next = guess - step, next_F = residual(next);
    while (next_F.norm() >= F.norm() && part > 1e-3) {
      part /= 2;
      next = guess - part * step;
      next_F = residual(next);
    }
    if (next_F.norm() >= F.norm()) break;  // round-off
    guess = next;
    F = next_F;
  }
  return guess;
}

}  // namespace

SlopeState integrate(const SlopeCase& c, double seconds) {
  const double gamma = 1 - std::sqrt(0.5);
  const Vector2d com = c.body.com_m.head<2>();
  const Pose2 start = Pose2{0, 0, c.heading_rad} * Pose2{com.x(), com.y(), 0};
  State y = State::Zero();
  y.head<3>() << start.x_m, start.y_m, start.theta_rad;
  double least_n = 1e9;
  const int steps = int(std::ceil(seconds / kStep_s - 1e-9));
  const double h = seconds / steps;
  for (int k = 0; k < steps; ++k) {
    const State first = implicit_stage(c, y, gamma * h, y);
    const State rate = (first - y) / (gamma * h);
    y = implicit_stage(c, y + (1 - gamma) * h * rate, gamma * h, first);
    least_n = std::min(least_n, derivative(c, y).least_load_n);
  }
  return {Pose2{y[0], y[1], y[2]} * Pose2{-com.x(), -com.y(), 0}, least_n};
}

}  // namespace umbsim::fidelity

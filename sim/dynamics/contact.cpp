#include "sim/dynamics/contact.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Along z of the base, where the spring gives way.
Vector3d upwards(const Contact& c) { return {c.direction[0].z(), c.direction[1].z(), c.direction[2].z()}; }

Matrix3d compliance(const Contact& c) {
  Matrix3d C = Vector3d(c.compliance[0], c.compliance[1], c.compliance[2]).asDiagonal();
  if (c.spring_give > 0) C += (c.spring_give * upwards(c)) * upwards(c).transpose();
  return C;
}

// Speed along each direction, offsets included, of what the compliances do not take.
Vector3d speeds(const Contact& c, const Vector3d& speed_mps) {
  Vector3d along(c.offset[0], 0, 0);
  if (c.friction > 0) along += Vector3d(0, c.offset[1], c.offset[2]);
  const Vector3d relative = speed_mps + Vector3d(0, 0, c.spring_mps);
  for (int i = 0; i < (c.friction > 0 ? 3 : 1); ++i) along[i] += c.direction[i].dot(relative);
  return along;
}

// From a matrix along the contact's directions.
Tangent turned(const Contact& c, const Matrix3d& give) {
  Matrix3d directions;
  for (int i = 0; i < 3; ++i) directions.col(i) = c.direction[i];
  const Matrix3d pushes = directions.lazyProduct(give);
  Tangent t;
  t.give = pushes.lazyProduct(directions.transpose());
  t.push = -pushes.lazyProduct(speeds(c, Vector3d::Zero()));
  return t;
}

}  // namespace

Tangent sticking_tangent(const Contact& c) {
  Tangent t;
  t.give = (1 / c.compliance[0] * c.direction[0]) * c.direction[0].transpose();
  Vector3d offset = c.offset[0] * c.direction[0];
  for (int i = 1; i < 3 && c.friction > 0; ++i) {
    t.give += (1 / c.compliance[i] * c.direction[i]) * c.direction[i].transpose();
    offset += c.offset[i] * c.direction[i];
  }
  offset.z() += c.spring_mps;
  if (c.spring_give > 0) {  // by the formula of Sherman and Morrison
    const Vector3d up = t.give.col(2);
    t.give -= (c.spring_give / (1 + c.spring_give * up.z()) * up) * up.transpose();
  }
  t.push = -(t.give * offset);
  return t;
}

// Linear in x and w: G_x x + G_w w = 0, and w = speed + C x. Closed and sticking rows say w = 0, open ones x = 0.
// Sliding x_t is the projection of y = x_t - r w_t on the cone mu x_n, whose derivative only turns y.
Tangent tangent(const Contact& c, const Touch& at, const Likeness& like) {
  const double load = at.impulse[0] - like.normal * at.slip[0];
  if (load <= 0) {
    Tangent open;
    open.give.setZero();
    open.push.setZero();
    open.open = true;
    return open;
  }
  const Matrix3d C = compliance(c);
  if (c.friction <= 0) {
    Tangent t;
    t.give = (1 / C(0, 0) * c.direction[0]) * c.direction[0].transpose();
    t.push = -(1 / C(0, 0) * speeds(c, Vector3d::Zero())[0]) * c.direction[0];
    return t;
  }
  const Vector2d y = at.impulse.tail<2>() - like.along * at.slip.tail<2>();
  const double cone = c.friction * load, length = y.norm();
  if (length <= cone) return sticking_tangent(c);
  const Vector2d d = y / length;
  const Matrix2d turn = cone / length * (Matrix2d::Identity() - d * d.transpose());
  Matrix3d on_x = Matrix3d::Zero(), on_w = Matrix3d::Zero();
  on_w(0, 0) = 1;
  on_x.block<2, 1>(1, 0) = -c.friction * d;
  on_x.bottomRightCorner<2, 2>() = Matrix2d::Identity() - turn;
  on_w.bottomRightCorner<2, 2>() = like.along * turn;
  Tangent t = turned(c, (on_x + on_w * C).inverse() * on_w);
  t.slides = true;
  return t;
}

Touch touch(const Contact& c, const Tangent& tangent, const Vector3d& speed_mps) {
  const Vector3d force = tangent.push - tangent.give * speed_mps;
  Touch t;
  t.impulse.setZero();
  for (int i = 0; i < (c.friction > 0 ? 3 : 1); ++i) t.impulse[i] = c.direction[i].dot(force);
  t.slip = speeds(c, speed_mps) + compliance(c) * t.impulse;
  if (c.friction <= 0) t.slip.tail<2>().setZero();
  return t;
}

double unbalance(const Contact& c, const Touch& at, const Likeness& like) {
  const double load = at.impulse[0] - like.normal * at.slip[0];
  const double off = std::abs(at.impulse[0] - std::max(0.0, load));
  if (c.friction <= 0) return off;
  Vector2d y = at.impulse.tail<2>() - like.along * at.slip.tail<2>();
  const double cone = c.friction * std::max(0.0, load), length = y.norm();
  if (length > cone) y *= cone / length;
  return std::max(off, (at.impulse.tail<2>() - y).cwiseAbs().maxCoeff());
}

}  // namespace umbsim

#pragma once

#include <Eigen/Core>

#include "sim/dynamics/multibody.h"

namespace umbsim {

/// What a support does to the floor or a cable where it touches it, base frame. Directions: normal, along the rolling
/// direction, across it; the last two count where there is friction. Speed along a direction plus compliance times
/// impulse is minus the offset, until the contact opens or slides.
struct Contact {
  int support = 0;
  double friction = 0;  ///< 0: there is none
  MultiBody::Lever lever;
  Eigen::Vector3d direction[3];
  double compliance[3];  ///< velocity per impulse
  double offset[3];
  // A spring between the support and the base gives way along z of the base.
  double spring_mps = 0;   ///< its speed without a force
  double spring_give = 0;  ///< more speed per impulse; 0: it is at a stop, or there is none
};

/// A contact's impulse on its support, and the speed that its compliances leave of that of its point. Both along its
/// directions: x and w of the contact laws (docs/physics.md).
struct Touch {
  Eigen::Vector3d impulse;
  Eigen::Vector3d slip;
};

/// Impulse per speed that makes x and w alike in the projections of the laws, for the normal and along the floor. Any
/// positive values do; near the inverse of the diagonal of A Newton's method takes few steps.
struct Likeness {
  double normal;
  double along;
};

/// The laws of Signorini and Coulomb as a tangent: force = push - give (speed of the point).
struct Tangent {
  Eigen::Matrix3d give;  ///< base frame
  Eigen::Vector3d push;
  bool open = false;
  bool slides = false;
};

/// Where the contact neither opens nor slides.
Tangent sticking_tangent(const Contact& contact);
/// Of the projections of the laws (Alart and Curnier 1991), at some impulse and slip.
Tangent tangent(const Contact& contact, const Touch& at, const Likeness& like);
/// What follows from a tangent at a speed of the point.
Touch touch(const Contact& contact, const Tangent& tangent, const Eigen::Vector3d& speed_mps);
/// How far impulse and slip are from the laws, as an impulse.
double unbalance(const Contact& contact, const Touch& at, const Likeness& like);

}  // namespace umbsim

#pragma once

#include <array>

#include "bench/fidelity/robots.h"
#include "core/pose2.h"

namespace umbsim::fidelity {

/// A robot on two wheels and a ball that slides or rolls down a plane: an integrator that shares nothing with sim/ but
/// the robot's masses. Rigid body in the plane, Coulomb's law at each contact, loads from the moment equations.
struct SlopeCase {
  Body body;
  double slope_rad = 0;
  double friction = 0;                        ///< of the wheels
  std::array<bool, 2> braked{true, true};     ///< left, right; a wheel that is not braked rolls freely
  double heading_rad = 0;                     ///< against downhill
};

struct SlopeState {
  Pose2 X_WB;             ///< of the axle's middle; x downhill
  double least_load_n = 0;  ///< of all contacts and times
};

/// From rest for `seconds`. Coulomb's law is smoothed below 10 um/s of slip; L-stable SDIRK of second order.
SlopeState integrate(const SlopeCase& c, double seconds);

}  // namespace umbsim::fidelity

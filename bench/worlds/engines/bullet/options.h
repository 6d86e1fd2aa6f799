#pragma once

#include <string>

namespace umbsim::worlds::bullet {

/// What users of Bullet's multibody world set.
struct BulletOptions {
  double step_s = 1.0 / 240;
  std::string solver = "sequential_impulse";  ///< sequential_impulse | dantzig
  int iterations = 50;
  std::string wheel = "cylinder";  ///< cylinder | sphere | convex: a prism of `sides`, as from a mesh
  int sides = 64;
  double torsion_m = 0;  ///< spinning friction over the sliding one
  double rolling_m = 0;  ///< rolling friction over the sliding one
  double erp = 0.2;      ///< share of an overlap that a step takes back
  double velocity_gain = 1;
  double body_damping = 0.04;  ///< share of the body's speed lost in a second
};

}  // namespace umbsim::worlds::bullet

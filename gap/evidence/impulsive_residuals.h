#pragma once

#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// A sudden change of the pose error at one moment of one run: something happened there.
struct Impulse {
  std::size_t run = 0;
  std::size_t sample = 0;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< along, across (m), heading (rad)
  double gain = 0;                                 ///< log evidence
};

/// A place on the floor where one wheel loses distance in every run that passes.
struct PlaceImpulse {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;  ///< of the robot where it passed nearest on a leg, else when it passed first
  int wheel = 0;           ///< 0 left, 1 right
  double lost_m = 0;
  int passes = 0;
  double gain = 0;
  std::vector<std::size_t> shown_by;  ///< the runs that show it most, best first
};

struct Impulses {
  std::vector<Impulse> moments;  ///< best first, one per run at most
  std::vector<PlaceImpulse>
      places;  ///< best first, at least 0.3 m apart (for a wheelbase of 0.36 m, else in proportion)
};

/// Log evidence of the strongest impulse, at a place or at a moment; 0 if there is none.
double strongest(const Impulses& impulses);

/// Matched filters for impulses along every run, over what a fit leaves.
Impulses find_impulses(const Model& model, const Fit& fit);

}  // namespace umbsim::gap

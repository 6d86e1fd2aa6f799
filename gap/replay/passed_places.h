#pragma once

#include <cstddef>
#include <vector>

#include "gap/replay/nominal_replay.h"
#include "recording/stretches.h"

namespace umbsim::gap {

/// One wheel nearest to a place as it comes by.
struct WheelPass {
  std::size_t run = 0;
  std::size_t sample = 0;  ///< of the run's truth
  int wheel = 0;           ///< 0 left, 1 right
};

/// A place on the floor that a wheel came across, and every pass of a wheel near it, by run and wheel.
struct PassedPlace {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;  ///< of the robot where it passed nearest on a leg, else where the place was found
  int wheel = 0;           ///< with which it was found
  std::vector<WheelPass> passes;
};

/// Lengths of a robot with a wheelbase of 0.36 m, times this, belong to this robot: 0.3 to 2.
double length_scale(const RecordedRobot& robot);

/// Places along the wheels' tracks of the first run of every condition and direction, each spot of 30 mm once; a pass
/// is within 50 mm (both times length_scale). `stretches`: of each run.
std::vector<PassedPlace> passed_places(const NominalReplay& nominal,
                                       const std::vector<std::vector<Stretch>>& stretches);

}  // namespace umbsim::gap

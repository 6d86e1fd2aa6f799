#pragma once

#include <string>
#include <vector>

#include "calibration/methods/fit.h"
#include "experiment/scenario/scenario.h"

namespace umbsim::bench {

/// A robot of the proof: what is wrong with it, and how it is driven and seen.
struct ProofRobot {
  double ratio = 0;        ///< right over left diameter, minus one
  double wheelbase = 0;    ///< relative error
  double scale = 0;        ///< of both radii
  double wheel_noise = 0;  ///< m per sqrt(m)
  double side_m = 0;
  double position_sd_m = 0;
  double heading_sd_rad = 0;
  std::uint64_t seed = 0;
};

/// A Latin hypercube over all of it.
std::vector<ProofRobot> proof_robots(int count, std::uint64_t seed);

/// Five runs each way on squares.
Scenario proof_scenario(const ProofRobot& robot);

/// The same robot on circles, as wide as its squares.
Scenario on_circles(Scenario scenario);

/// What a method should find.
calibration::LogFactors true_factors(const Scenario& scenario);

}  // namespace umbsim::bench

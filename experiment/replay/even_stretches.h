#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/pose2.h"
#include "recording/recording.h"

namespace umbsim {

/// Part of a drive in which both wheels turn so evenly that a robot that rolls goes through it in one time step.
struct EvenStretch {
  std::size_t end = 0;                  ///< its last sample
  std::array<double, 2> turned_rad{};   ///< by the shafts, left and right
  double peak_mps2 = 0;                 ///< largest acceleration of a wheel from sample to sample, unseen by one step
  Pose2 as_one_arc;                     ///< where dead reckoning comes to from its start in one step
  std::vector<Pose2> sample_by_sample;  ///< and through its samples
};

using EvenStretches = std::vector<EvenStretch>;

/// All of a drive. `turned_rad`: of each shaft up to the samples. `radius_m` and `wheelbase_m`: of the dead reckoning.
EvenStretches even_stretches(const std::vector<EncoderSample>& samples,
                             const std::array<std::vector<double>, 2>& turned_rad,
                             const std::array<double, 2>& radius_m, double wheelbase_m);

}  // namespace umbsim

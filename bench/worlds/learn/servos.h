#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "gap/trial/write/trial_folder.h"

namespace umbsim::worlds {

/// How the counts of one case follow their commands beyond what this simulator's motors do, mean of its runs: gain of
/// both wheels; of left over right; lag, s; speed beyond the command as the cosine of the heading from the start goes,
/// over the mean speed; the same of the sine, to the side of the turns; friction on the way and in turns in place, each
/// as a share of the weight, times the servo's time constant, s.
using ServoResponse = Eigen::Matrix<double, 7, 1>;
inline constexpr Eigen::Index kServoLag = 2;
inline constexpr Eigen::Index kServoFriction = 5;

struct ServoResponses {
  std::map<std::string, std::vector<ServoResponse>> by_engine;
  int refused = 0;  ///< recordings that a diagnosis refuses, such as for a gap in the truth
};

/// Of every case of a sealed folder in which nothing acts on counts. Cases without commands, or with effects that the
/// catalogue does not have, are left out. Throws InputError where answers do not name the worlds.
ServoResponses servo_responses(const TrialFolder& folder);

}  // namespace umbsim::worlds

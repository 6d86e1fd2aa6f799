#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "gap/trial/write/trial_folder.h"

namespace umbsim::worlds {

/// How the counts of one case follow their commands beyond what this simulator's motors do, mean of its runs.
struct ServoResponse {
  double gain = 0;        ///< of both wheels
  double wheel_gain = 0;  ///< left over right
  double lag_s = 0;
  double along = 0;  ///< speed beyond the command as the cosine of the heading from the start goes, over the mean speed
  double across = 0;  ///< the same of the sine, to the side of the turns
};

inline constexpr std::array kServoFigures{&ServoResponse::gain, &ServoResponse::wheel_gain, &ServoResponse::lag_s,
                                          &ServoResponse::along, &ServoResponse::across};

/// Of every case of a sealed folder in which nothing acts on counts, by engine. Cases without commands, with
/// effects that the catalogue does not have, or that a diagnosis refuses are left out. Throws InputError.
std::map<std::string, std::vector<ServoResponse>> servo_responses(const TrialFolder& folder);

}  // namespace umbsim::worlds

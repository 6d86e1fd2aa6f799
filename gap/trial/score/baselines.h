#pragma once

#include <string>
#include <vector>

#include "gap/trial/score/figures.h"
#include "recording/recording.h"

namespace umbsim {

/// A diagnosis that anybody could make: how often it is right, in the same cases as "first cause right among all
/// effects", and its false alarms.
struct Baseline {
  std::string key;
  std::string text;
  int right = 0;
  int cases = 0;
  int false_alarms = 0;
  int no_effect_cases = 0;
  std::string note;  ///< why it is not there
};

/// What the classical test names: wheelbase or wheel_radius_difference, whichever heading error of the plain squares
/// stands out more, if it is beyond its 95 % noise (Student's t over both directions' runs); else "none".
std::string umbmark_alone(const Recording& recording);

/// The commonest effect of the cases, UMBmark alone (`umbmark`: what it names in each case, in the same order), and the
/// cause with the largest drop of the squared error, where the diagnoses state it.
std::vector<Baseline> baselines(const std::vector<Verdict>& verdicts, const std::vector<std::string>& umbmark);

}  // namespace umbsim

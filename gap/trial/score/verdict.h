#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gap/trial/diagnose/diagnosis_file.h"
#include "gap/trial/write/answers.h"

namespace umbsim {

/// One strength parameter of a cause that was named rightly.
struct ParameterVerdict {
  std::string effect;
  std::string parameter;
  double truth = 0;
  double found = 0;
  double relative_error = 0;
  bool covered = false;  ///< the truth lies in the 95 % interval
};

/// One case: the truth beside the diagnosis.
struct Verdict {
  std::string name;
  Answer answer;
  bool failed = false;  ///< the process left no diagnosis: wrong in every respect
  double wall_s = 0;
  Diagnosis diagnosis;

  std::string truth;    ///< "none", an effect, or effects joined by "+"
  std::string named;    ///< the first cause; "failed" if there is none
  double probability = 0;
  bool detected = false;         ///< a cause other than "none" is named first
  bool right = false;            ///< the first cause is the truth; outside the catalogue: "unknown"
  bool right_or_tied = false;    ///< or the diagnosis's own list says that nobody can tell them apart
  bool distinguishable = true;   ///< no effect of the truth is in that list with another
  bool in_set = false;
  bool unknown = false;          ///< the first cause is "unknown"
  bool both_in_set = false;      ///< one member of the set has every effect of the truth
  bool one_in_set = false;       ///< some member has at least one of them
  std::optional<bool> stage_right;     ///< one effect of the catalogue only
  std::optional<bool> location_right;  ///< where the effect has a place, a run, or a pattern of its own
  std::vector<ParameterVerdict> parameters;
};

/// Compares a diagnosis with the truth. `diagnosis`: empty if the process failed.
Verdict judge(const std::string& name, const Answer& answer, const std::optional<Diagnosis>& diagnosis, double wall_s);

}  // namespace umbsim

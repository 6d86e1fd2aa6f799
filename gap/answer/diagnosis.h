#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// One explanation of the gap. "none": no fit's hypotheses; "unknown": not an effect at all.
struct Cause {
  std::string name;
  Fit fit;
  double score = 0;  ///< log evidence with prior costs, against none
  double probability = 0;
  double squared_error_drop = 0;   ///< share of the recorded tracks' squared position error that it removes
  std::vector<Fit> variants = {};  ///< of the same effects with other numbers free, and nearly as much evidence
};

struct SegmentScore {
  std::string run;
  int leg = 0;
  std::string part;  ///< start | cruise | stop | turn
  double score = 0;  ///< log evidence that the prediction errs there
  double at_x_m = 0;
  double at_y_m = 0;
  std::size_t first = 0;  ///< sample of the truth
  std::size_t last = 0;   ///< one past the part's last sample
};

/// Where the evidence against a fit sits, in words; empty where there is little of it.
struct LeftOver {
  std::string description;
  std::string where;  ///< of more than half of it: "in the turns", "along the legs", "in run cw-3"
};

/// By how much tracks and end headings of held-out runs come nearer with something than without it, root mean squares.
struct Worth {
  double mm = 0;
  double deg = 0;
};

/// Held-out closure: every condition predicted with parameters fitted on the others.
struct Closure {
  bool known = false;
  double fraction = 0;      ///< 1 - (after - floor) / (before - floor), mean squares of position, unclipped
  double ci95[2] = {0, 0};  ///< bootstrap over runs
  double before_mm = 0;     ///< root mean square position error along the held-out runs
  double after_mm = 0;
  double floor_mm = 0;       ///< of the run-to-run noise,
  double most_noise_mm = 0;  ///< and what it exceeds once in twenty times
  double before_deg = 0;     ///< root mean square heading error at the ends
  double after_deg = 0;
  std::vector<Worth> worth;  ///< of each of the fit's hypotheses, beside the others

  Worth together() const { return {before_mm - after_mm, before_deg - after_deg}; }
  bool takes_more_than_it_leaves() const { return known && together().mm > after_mm; }
};

/// What the twin leaves of the gap.
struct Remainder {
  double mm = 0;        ///< root mean square position error along the runs: held out where some could be, else of all
  double share = 1;     ///< of the squared error beyond noise
  std::string pattern;  ///< of the effect of the catalogue that would take most of it
  bool in_catalogue = false;  ///< that effect would take half of what errors of no particular cause could
};

/// A twin with radii or a wheelbase that are no cause, and foretell what the causes leave (answer/effective_twin.h).
struct EffectiveTwin {
  std::vector<std::string> dimensions;  ///< of them
  Fit fit;                              ///< of the causes that it holds, if any, and the dimensions
  Closure closure;
};

struct Diagnosis {
  bool detected = false;
  bool in_poses = false;  ///< and tracks stray beyond noise and what engines differ by; else counts alone may show it
  double p_value = 1;
  bool not_fitted = false;  ///< the first cause is found, but its numbers leave what is not explained
  std::string stage = "undecided";
  std::string pattern;
  std::vector<SegmentScore> segments;
  bool has_place = false;
  double place_m[2] = {0, 0};
  std::string place_wheel;    ///< that passes there: left, right, or empty
  std::vector<Cause> causes;  ///< ranked
  std::vector<std::string> set;
  std::vector<std::vector<std::string>> indistinguishable;
  bool unexplained = false;
  double unexplained_p = 1;
  LeftOver left_over;  ///< by what explains best
  Fit explanation;     ///< what explains best, whether or not it leads; none where there is no gap
  Fit twin;  ///< of its effects, those that foretell held-out runs; none where the twin is the scenario as it was
  Closure closure;  ///< of these effects
  Remainder remainder;
  std::optional<EffectiveTwin> effective;  ///< what is driven in the twin's place
  bool twin_is_nominal() const { return twin.hypotheses.empty(); }
  const Fit& driven_twin() const { return effective ? effective->fit : twin; }
  const Closure& twin_closure() const { return effective ? effective->closure : closure; }
  NoiseModel noise;  ///< as estimated from the runs
  double noise_floor_mm = 0;
  double before_mm = 0;             ///< root mean square position error of the scenario as it was
  double explainable_fraction = 0;  ///< of the evidence for a gap, what the first cause takes
  double overdispersion = 1;        ///< residual variance of the first cause's fit, over the noise model's
  bool elsewhere = false;           ///< another engine, or a real robot, made the recording
  std::vector<std::string> limits;  ///< what makes the answer smaller, in words
  double simulated_s = 0;
};

}  // namespace umbsim::gap

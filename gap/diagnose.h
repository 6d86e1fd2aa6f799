#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "gap/kicks.h"
#include "gap/model.h"

namespace umbsim::gap {

/// What the decisions rest on. Tuned on data of its own (docs/gap.md), not on what is diagnosed.
struct Thresholds {
  double detect = 8;                 ///< log evidence that a gap needs,
  double detect_rolling = 0.5;       ///< and where it is of what only rolls, counts and was asked for: no engines differ
  double effect_cost = 3;            ///< prior log odds against each further effect
  double addition = 10;              ///< log evidence that a further effect needs,
  double addition_share = 0.001;     ///< and the same as a share of what the others gained,
  double misfit_share = 0.05;        ///< and of the excess of the residual that the others leave,
  double local_misfit_share = 0.2;   ///< the same of a place or moment;
  double counts_share = 0.015;       ///< or, of what counts and habits gain, a share of what they gained before
  double counts_misfit_share = 0.2;  ///< and of what they miss
  double smallest = 0.25;          ///< displacement, in noise floors, below which an effect is a difference of engines,
  double least_seen = 0.15;        ///< if it is also below this share of the noise of single readings
  double smallest_addition = 0.5;  ///< as `smallest`, of a further effect
  double noise_error = 0.1;        ///< a misfit larger by this share is no news: three sd of two pairs of repeats
  double variant = 8;              ///< log evidence within which another wheel of the same effect may take part
  double tie = 6;                  ///< log evidence within which two explanations are not told apart
  double top = 1e-4;  ///< and, of a place or moment, the share of its evidence to which the search finds its top
  double known_share = 0.93;  ///< of the explainable evidence that named effects must explain, or the cause is unknown
  double known_share_of_toe = 0.7;       ///< the same of toed wheels, whose scrub depends on tyres that nobody knows
  double known_share_of_rolling = 0.99;  ///< the same of what follows from rolling and counting, whatever the contact,
  double left_by_rolling = 12;           ///< where this much log evidence is left
  double least_closure = 0.3;            ///< that the held-out closure's interval must reach,
  double most_left = 0.5;                ///< where what is explained is less than this share of what is left
  double misfit_left = 0.68;             ///< of the misfit beyond the noise, above which the cause is unknown, too
  double sudden = 40;  ///< log evidence of what is sudden, at a place or a moment, that a difference of engines makes,
  double late = 150;   ///< and the same of readings that do not go with the counts
  double sudden_or_late_left = 0.5;  ///< share of what is explained that may be left of these,
  double sudden_beside_local = 0.12;  ///< and of what is sudden, where a place or moment is named that is no cable
  double faint = 0.05;               ///< p-value of a single effect, below which it is in the set beside "none"
  double plainly_shown = 100;        ///< log evidence of counts and commands that leaves no doubt
  double beside_floor = 0.05;        ///< share of the misfit that an effect beside an uneven floor must explain
  double place_beside_floor = 0.3;   ///< the same of a place or moment
  int most_effects = 3;
};

/// Log evidence that an explanation may leave before it is called unknown, if it explains `explained`.
double may_be_left(const Fit& fit, double explained, const Thresholds& thresholds);

/// Log evidence, with prior costs, that effects need to be named where there might be no gap at all.
double enough_to_detect(const std::vector<std::string>& effects, const Thresholds& thresholds);

/// One explanation of the gap. "none": no fit's families; "unknown": not an effect at all.
struct Cause {
  std::string name;
  Fit fit;
  double score = 0;  ///< log evidence with prior costs, against none
  double probability = 0;
  double squared_error_drop = 0;   ///< share of the recorded tracks' squared position error that it removes
  std::vector<Fit> variants = {};  ///< of the same effects with other numbers free, and nearly as much evidence
};

/// The effects of a fit that can be simulated: without those of which only the strength is known.
std::vector<Effect> twin_effects(const Fit& fit);

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
  double before_deg = 0;  ///< root mean square heading error at the ends
  double after_deg = 0;
  std::vector<Worth> worth;  ///< of each of the fit's families, beside the others

  Worth together() const { return {before_mm - after_mm, before_deg - after_deg}; }
};

/// What the twin leaves of the gap.
struct Remainder {
  double mm = 0;        ///< root mean square position error along the runs: held out where some could be, else of all
  double share = 1;     ///< of the squared error beyond noise
  std::string pattern;  ///< of the effect of the catalogue that would take most of it
  bool in_catalogue = false;  ///< that effect would take half of what errors of no particular cause could
};

struct Diagnosis {
  bool detected = false;
  double p_value = 1;
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
  Fit twin;            ///< of its effects, those that foretell held-out runs; none where the twin is the scenario as it was
  Closure closure;     ///< of the twin
  Remainder remainder;
  bool twin_is_nominal() const { return twin.families.empty(); }
  NoiseModel noise;              ///< as estimated from the runs
  double noise_floor_mm = 0;
  double before_mm = 0;             ///< root mean square position error of the scenario as it was
  double explainable_fraction = 0;  ///< of the evidence for a gap, what the first cause takes
  double overdispersion = 1;        ///< residual variance of the first cause's fit, over the noise model's
  std::vector<std::string> limits;  ///< what makes the answer smaller, in words
  double simulated_s = 0;
};

/// Told of every stage, and of the share of it that is done.
using Say = std::function<void(const std::string& stage, double share)>;

/// Diagnoses a recording. `excluded`: effects taken out of the catalogue. Throws InputError, RunError.
Diagnosis diagnose(const Model& model, const std::set<std::string>& excluded, const Thresholds& thresholds,
                   const Say& say);

}  // namespace umbsim::gap

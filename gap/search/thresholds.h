#pragma once

#include <functional>
#include <string>

namespace umbsim::gap {

/// What the decisions rest on. Tuned on data of its own (docs/gap.md), not on what is diagnosed.
struct Thresholds {
  double detect = 8;                ///< log evidence that a gap needs,
  double detect_rolling = 0.5;      ///< and where it is kinematic or was asked for: no engines differ
  double effect_cost = 3;           ///< prior log odds against each further effect
  double addition = 10;             ///< log evidence that a further effect needs,
  double addition_share = 0.001;    ///< and the same as a share of what the others gained,
  double misfit_share = 0.05;       ///< and of the excess of the residual that the others leave,
  double local_misfit_share = 0.2;  ///< the same of a place or moment;
  double counts_share = 0.015;  ///< or, of what counts and command features gain, a share of what they gained before
  double counts_misfit_share = 0.2;  ///< and of what they miss
  double smallest = 0.25;          ///< displacement, in noise floors, below which an effect is a difference of engines,
  double least_seen = 0.15;        ///< if it is also below this share of the noise of single readings
  double smallest_addition = 0.5;  ///< as `smallest`, of a further effect
  double noise_error = 0.1;        ///< a misfit larger by this share is no news: three sd of two pairs of repeats
  double variant = 8;              ///< log evidence within which another wheel of the same effect may take part
  double tie = 6;                  ///< log evidence within which two explanations are not told apart
  double top = 1e-4;  ///< and, of a place or moment, the share of its evidence to which the search finds its top
  double known_share = 0.99;  ///< of the explainable evidence that named effects must explain, or the cause is unknown;
  double known_share_elsewhere = 0.85;  ///< the same of what contacts do in another engine,
  double known_share_of_shakes = 0.67;  ///< and beside what scatters, is sudden or late: there engines differ more
  double sudden = 40;   ///< log evidence of what is sudden, at a place or a moment, that a difference of engines makes,
  double late = 150;    ///< and the same of readings that do not go with the counts
  double faint = 0.05;  ///< p-value of a single effect, below which it is in the set beside "none"
  double plainly_shown = 100;  ///< log evidence of counts and commands that leaves no doubt
  double beside_floor = 0.05;  ///< share of the misfit that an effect beside an uneven floor must explain
  int most_effects = 3;
};

/// Told of every stage, and of the share of it that is done.
using ProgressCallback = std::function<void(const std::string& stage, double share)>;

}  // namespace umbsim::gap

#pragma once

#include <memory>

#include "gap/evidence/model.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// What a further effect must bring on top of a fit: log evidence.
struct Needed {
  double everywhere = 0;  ///< of an effect that acts on all runs
  double local = 0;       ///< of one place or moment, which finds something to mend in any misfit
  double counts = 0;      ///< or of counts against commands and of command features alone, where tracks say little
  double gained = 0;      ///< what the fit itself brought
  double left = 0;        ///< squares, in standard deviations, that the fit leaves beyond noise
  /// In which the fit's signatures may be off, made when it is asked for; log density of the fit there, over that in
  /// the model itself.
  mutable std::shared_ptr<const Model> beside{};
  mutable double base_beside = 0;
  double hint = 0;  ///< what the linear screen must see of it, for a fit to be tried
};

/// Share of what `base` brought that `fit`, with one effect more, must bring on top: above zero where that effect is
/// what an error of an effect's model in `base` looks like, such as slip beside coarse counts.
double lookalike_share(const Fit& base, const Fit& fit);

/// Whether counts speak against `fit`, or the runs scatter less than under it: it may not explain the tracks then.
bool contradicted(const Model& model, const Fit& base, const Fit& fit);

/// Sum of squares of what a fit changes in the whitened tracks.
double seen_between(const Model& model, const Fit& base, const Fit& fit);

/// `none`: the fit of no effect.
Needed addition_needed(const Model& model, const Fit& base, const Fit& none, const Thresholds& thresholds);

/// Whether `fit`, with `extra` effects more than `base`, brings what they must.
bool pays(const Model& model, const Fit& base, const Fit& fit, const Needed& needed, double extra = 1);

}  // namespace umbsim::gap

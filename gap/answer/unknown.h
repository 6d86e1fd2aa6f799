#pragma once

#include <string>
#include <vector>

#include "gap/answer/diagnosis.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// What a fit leaves that nothing of the catalogue explains, as log evidence.
struct LeftUnexplained {
  double steady = 0;  ///< errors of no particular cause, and counts that stray from commands
  double lack = 0;    ///< misfit beyond noise, where the noise is known from repeated runs
  double sudden = 0;  ///< an impulse at a place or at a moment, beyond what a difference of engines makes
  double late = 0;    ///< readings that do not go with the counts, the same
  double all() const;
};

LeftUnexplained left_unexplained(const Model& model, const Fit& fit, const Thresholds& thresholds);

/// Log evidence that an explanation may leave before it is called unknown, if it explains `explained`.
/// What is kinematic leaves next to nothing, unless it stands `beside_contacts` of another engine, which leave
/// something beside any effect.
double may_be_left(const Fit& fit, double explained, bool beside_contacts, const Thresholds& thresholds);

/// Log evidence, with prior costs, that effects need to be named on recordings of this engine where there might be no
/// gap at all.
double enough_to_detect(const std::vector<std::string>& effects, const Thresholds& thresholds);

/// Whether what a fit leaves says that it is not the cause. `closure`: of the fit; `none`: what no effect leaves.
bool is_unknown(const Model& model, const Fit& fit, double explained, const Closure& closure,
                const LeftUnexplained& left, const LeftUnexplained& none, const Thresholds& thresholds);

}  // namespace umbsim::gap

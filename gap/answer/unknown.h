#pragma once

#include <string>
#include <vector>

#include "gap/answer/diagnosis.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// What a fit leaves that nothing of the catalogue explains, as log evidence.
struct LeftUnexplained {
  double in_tracks = 0;  ///< errors of no particular cause
  double in_counts = 0;  ///< counts that stray from commands
  double lack = 0;       ///< misfit beyond noise, where the noise is known from repeated runs
  double sudden = 0;     ///< an impulse at a place or at a moment, beyond what a difference of engines makes
  double late = 0;       ///< readings that do not go with the counts, the same
  double density = 0;    ///< log density of the runs under the fit and errors of no particular cause

  double steady() const { return in_tracks + in_counts; }
  double all() const;
  /// Whether tracks hold something steady that engines do not differ by, however few millimetres it is: many readings
  /// show a shift that is smaller than the noise of one run.
  bool beyond_engines(const Thresholds& thresholds) const { return in_tracks > thresholds.detect; }
};

LeftUnexplained left_unexplained(const Model& model, const Fit& fit, const Thresholds& thresholds);

/// What a fit leaves that neither the catalogue explains nor what its own effects may do otherwise in another engine
/// (Model::unsure_of).
LeftUnexplained left_beside(const Model& model, const Fit& fit, const Thresholds& thresholds);

/// Log evidence that an explanation may leave so before it is called unknown, if it explains `explained`.
/// `contacts_differ`: Model::contacts_differ.
double may_be_left(double explained, bool contacts_differ, const Thresholds& thresholds);

/// Whether what is left says that the cause is another one. `none`: what no effect leaves.
bool is_unknown(const LeftUnexplained& left, const LeftUnexplained& none, double explained, bool contacts_differ,
                const Thresholds& thresholds);

/// Log evidence, with prior costs, that effects need to be named on recordings of this engine where there might be no
/// gap at all.
double enough_to_detect(const std::vector<std::string>& effects, const Thresholds& thresholds);

}  // namespace umbsim::gap

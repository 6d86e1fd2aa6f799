#pragma once

#include <vector>

#include "gap/evidence/model.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Whether nothing is left but noise, as well as it is known, and nothing sudden, which a few readings show. `none`:
/// the fit of no effect.
bool explains_all(const Model& model, const Fit& fit, const Fit& none, const Thresholds& thresholds);

/// Orders by evidence.
inline bool less_evidence(const Fit& a, const Fit& b) { return a.log_evidence < b.log_evidence; }

/// The fits of `frontier` on which further effects are tried: the best, and another that is nearly as good or explains
/// something quite different. What moves the robot alike within noise, as a contact's width and a wheelbase do, is no
/// other.
std::vector<Fit> bases(const Model& model, const Fit& none, std::vector<Fit> frontier, const Thresholds& thresholds);

}  // namespace umbsim::gap

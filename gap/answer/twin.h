#pragma once

#include <vector>

#include "gap/answer/diagnosis.h"
#include "gap/search/search.h"

namespace umbsim::gap {

/// Whether a fit says that another engine made the runs, and an effect moves robots as its contacts do: at a contact,
/// or with every metre or turn.
bool mends_contacts(const Model& model, const Fit& fit, const std::string& effect);

/// The closure of a twin that is the scenario as it was.
void add_nothing(Closure& closure);

/// Whether an explanation of runs that another engine, or a robot, made takes more millimetres off held-out runs than
/// it leaves, and leaves no more than noise makes; or else the part of it that foretells them (keep_what_foretells). If
/// the tracker's frame and clock are free either is enough: what is left of the evidence may be the tracker.
bool worth_more_than_rest(const Model& model, Fit fit, Closure closure);

/// Whether a fit by which another engine made the runs takes enough off held-out ones: each effect that may mend its
/// contacts as much as noise makes, and, if it acts everywhere, as much as is left. `closure`: of the fit.
bool takes_enough(const Model& model, const Fit& fit, const Closure& closure);

/// Takes out the effects that foretell held-out runs worse than the others do alone, and on another engine's runs those
/// beside them that mend its contacts and take away too little to be told from noise and from what nothing explains.
/// `closure` becomes that of what stays.
void keep_what_foretells(const Model& model, Fit& twin, Closure& closure);

/// What the twin leaves, and what the catalogue would make of it. `leftover`: log evidence for errors of no particular
/// cause.
Remainder remainder_of(const Model& model, const Screen& screen, const Fit& none, const Diagnosis& d, double leftover);

}  // namespace umbsim::gap

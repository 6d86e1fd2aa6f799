#pragma once

#include "gap/answer/context.h"

namespace umbsim::gap {

/// Whether there is a gap, named or not, and how probable it were by chance. Without one `none` goes first.
void detect(const Context& context, Diagnosis& d);

/// Causes, unknown among them, the closure, the twin and the remainder. `left`: by the best of the causes. `best`: that
/// one, which may become another.
void explain(const Context& context, const LeftUnexplained& left, Fit& best, Diagnosis& d);

}  // namespace umbsim::gap

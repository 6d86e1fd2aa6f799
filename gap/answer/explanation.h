#pragma once

#include "gap/answer/context.h"

namespace umbsim::gap {

/// Whether there is a gap, named or not, and how probable it were by chance. Without one `none` goes first.
void detect(const Context& context, Diagnosis& d);

/// Whether another engine made recordings whose tracks stray by no more than noise makes them. What contacts do is no
/// gap then: they differ from engine to engine.
bool hidden_in_noise(const Context& context, const Fit& fit, const Closure& closure);

/// Causes, unknown among them, the twin and the remainder. `left`: by the best of the causes.
/// `best`: that cause, which may become another; `d.closure` is its.
void explain(const Context& context, const LeftUnexplained& left, Fit& best, Diagnosis& d);

}  // namespace umbsim::gap

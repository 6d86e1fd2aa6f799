#pragma once

#include <string>
#include <vector>

#include "gap/plan/ties.h"

namespace umbsim::gap {

/// The diagnosis in a few sentences: what differs and by how much, what that takes away of the gap, what remains and
/// where, what it cannot be told from, and what to drive next.
std::string verdict(const Diagnosis& diagnosis, const std::vector<NextExperiment>& next);

/// A length as it is read: 45 mm, 4.5 mm, 0.45 mm.
std::string millimetres(double mm);

/// Texts as in "a, b or c".
std::string listed(const std::vector<std::string>& texts, const char* last);

}  // namespace umbsim::gap

#pragma once

#include <string>

namespace umbsim::fidelity {

/// Chapter 7. Only where MuJoCo is built in (UMBSIM_BENCH).
std::string peers_chapter();

}  // namespace umbsim::fidelity

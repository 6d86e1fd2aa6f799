#pragma once

#include <string>

#include "exchange/import/log.h"

namespace umbsim::exchange {

/// Whether a column of counts or angles holds what each sample added rather than the sum. `said`: of --counts
/// (cumulative | per-sample), may be empty. Throws InputError that asks for --counts where neither name nor numbers
/// tell.
bool is_per_sample(const WheelSignal& signal, bool name_says_so, const std::string& said, const std::string& file);

}  // namespace umbsim::exchange

#pragma once

#include <fmt/format.h>

#include <string>

#include "core/error.h"
#include "recording/recording.h"

namespace umbsim::intake {

/// A recording that cannot be diagnosed as it is: where, what is wrong with it, and what to do. Throws InputError.
[[noreturn]] inline void refuse(const std::string& directory, const RecordedRun& run, const std::string& what) {
  throw InputError(fmt::format("{}: run {}: {}", directory, run.id, what));
}

}  // namespace umbsim::intake

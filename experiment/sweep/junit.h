#pragma once

#include <string>
#include <vector>

#include "experiment/scenario/expect.h"

namespace umbsim {

/// A point that could not be driven, and why.
struct FailedPoint {
  std::int64_t number = 0;
  std::string label;
  std::string error;
};

/// JUnit XML, as CI systems read it: a test case for every point of every expectation, and an error for every point
/// that could not be driven. `suite`: the name of the scenario or sweep.
std::string junit_xml(const std::string& suite, const std::vector<Check>& checks,
                      const std::vector<FailedPoint>& failed);

}  // namespace umbsim

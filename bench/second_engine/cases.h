#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/second_engine/engine_options.h"
#include "effects/catalogue.h"
#include "gap/trial/platform.h"

namespace umbsim::second_engine {

/// One recording to be made.
struct Case {
  std::string name;
  std::string platform;
  std::vector<Effect> effects;
  std::vector<std::string> excluded;  ///< from the diagnoser's catalogue
};

/// A list of cases as its file describes it.
struct CaseList {
  std::string file;
  std::uint64_t seed = 1;
  EngineOptions engine;
  TrialNoise noise;
  std::map<std::string, Platform> platforms;
  std::vector<Case> cases;
};

/// Reads a list as strictly as a scenario. Throws InputError with file, line, column, key, value and bound.
CaseList read_cases(const std::string& file);

}  // namespace umbsim::second_engine

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/worlds/world/world.h"

namespace umbsim::worlds {

/// How many faults a case has, and whether the diagnosis may name them.
enum class CaseKind { none, single, pair, triple, outside, excluded };
constexpr CaseKind kCaseKinds[] = {CaseKind::none,   CaseKind::single,  CaseKind::pair,
                                   CaseKind::triple, CaseKind::outside, CaseKind::excluded};
const char* name(CaseKind kind);

/// A worlds file (format umbsim-worlds/1). The same file gives the same bytes.
struct WorldsPlan {
  std::string file;
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  std::vector<std::string> engines;   ///< default: all of this build
  std::vector<int> cases_per_engine;  ///< by kind
  Range severity{0.5, 10};            ///< in noise floors, drawn log-uniformly
  double decoy_exclusions = 0.25;     ///< share of the other cases that leave out an innocent effect
  WorldChoices choices;
};

/// Strict, as a scenario. Throws InputError.
WorldsPlan read_worlds(const std::string& file);
/// Every value written out, in the form that read_worlds takes.
std::string resolved_worlds(const WorldsPlan& plan);

/// One case before anything is drawn but its place in the plan.
struct WorldCase {
  std::string name;  ///< random
  std::uint64_t index = 0;
  std::string engine;
  CaseKind kind = CaseKind::none;
  int number = 0;                     ///< of its engine and kind: effects take turns
  std::vector<std::string> excluded;  ///< from the diagnoser's catalogue
};

/// Sorted by name.
std::vector<WorldCase> world_cases(const WorldsPlan& plan);

/// The faults of a case: the catalogue's (as far as the engine can express them) and the others take turns in a random
/// order.
std::vector<std::string> fault_names(const WorldsPlan& plan, const WorldCase& c);

}  // namespace umbsim::worlds

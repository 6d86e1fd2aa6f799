#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "gap/trial/write/trial_folder.h"

namespace umbsim::worlds {

/// What contacts do otherwise in another engine, as a diagnosis believes it of any (gap/noise/nuisances.h).
struct ContactFigure {
  const char* name;
  const char* unit;
  double per_unit;  ///< of the unit, in SI
  int digits;
};

inline constexpr std::size_t kContactFigures = 12;
extern const std::array<ContactFigure, kContactFigures> kContactFigure;

/// Found in the cases of one engine: each figure once a group of runs that shows it, in SI.
using ContactsOfEngine = std::array<std::vector<double>, kContactFigures>;

struct ContactsFound {
  std::map<std::string, ContactsOfEngine> by_engine;
  std::array<double, kContactFigures> believed{};  ///< standard deviations of the diagnosis, alike in all cases
  int refused = 0;                                 ///< recordings that a diagnosis refuses
};

/// Of every case of a sealed folder in which nothing is wrong: the diagnosis' own fit of no effect, with standard
/// deviations ten times as wide as it believes, but for leads, which the tracker's clock may be. A number counts where
/// its posterior one is below what is believed. Throws InputError where answers do not name the worlds.
ContactsFound contacts_found(const TrialFolder& folder);

}  // namespace umbsim::worlds

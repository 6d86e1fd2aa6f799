#pragma once

#include <string>
#include <vector>

#include "gap/evidence/signature_shares.h"
#include "gap/trial/write/answers.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim::worlds {

/// Shares of single motions that are tried (SignatureErrors::motion).
inline const std::vector<double> kMotions{0, 0.01, 0.03, 0.1, 0.3, 1};

/// What one case says of by how much its effect's signature is off.
struct CaseShares {
  std::string name;
  std::string effect;
  std::string engine;
  std::vector<gap::SignatureShares> by_motion;  ///< as kMotions; empty: the effect could not be fitted
};

Json shares_json(const CaseShares& shares);
CaseShares read_shares(const Json& json);

struct SharesFound {
  std::vector<CaseShares> cases;
  int refused = 0;  ///< recordings that a diagnosis refuses
};

/// Fits the effect of every case that has a single one of the catalogue, alone, and looks at the pieces of its
/// signature; keeps what it finds under shares/ of the folder, and does what is not done yet. Left out is what follows
/// from rolling alone. `jobs`: cases at the same time; 0: one per core. Throws InputError where answers do not name the
/// worlds, RunError.
SharesFound look_at_cases(const TrialFolder& folder, int jobs);

}  // namespace umbsim::worlds

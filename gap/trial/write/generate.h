#pragma once

#include <optional>
#include <string>

#include "gap/trial/write/answers.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim {

/// What a call has done.
struct GenerateResult {
  std::size_t cases = 0;     ///< of the whole trial
  std::size_t finished = 0;  ///< that stand now
  std::optional<std::string> seal;  ///< hash of the answers, once all cases stand
};

/// Draws the cases of a trial, drives them and writes their recordings; when the last one stands, seals the answers.
/// Goes on where an earlier call stopped. Cases are driven in parallel on `jobs` threads (0: all cores); the files do
/// not depend on their number, nor on how the cases were shared out among shards. Throws InputError if the folder holds
/// another trial, RunError.
GenerateResult generate_trial(const TrialPlan& plan, const TrialFolder& folder, const TrialSimulator& simulator,
                              Shard shard, int jobs);

}  // namespace umbsim

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "batch/claims.h"

namespace umbsim {

/// Many independent cases, each done once. Plain functions, so that the one who runs a batch knows nothing of its work.
struct Batch {
  using Commit = std::function<void()>;
  std::vector<std::int64_t> cases;                     ///< to be done, in this order
  std::function<bool(std::int64_t)> is_done;           ///< asked again right before the work: another process may have
  std::function<Commit(std::int64_t)> work;            ///< called from several threads at the same time
  std::function<void(std::int64_t, bool ours)> after;  ///< a case is done, by this process or another
};

/// Works through the cases on `jobs` threads (0: all cores). The commits that `work` returns are called one at a time,
/// each as soon as its case is done. Cases that another process has claimed are left to it, and taken over if it ends
/// without finishing them. Ends early when StopRequests has received a signal: what is in work is finished first.
/// Returns true if all cases are done. Exceptions of `work` and of commits pass through.
bool run_batch(const Batch& batch, Claims& claims, int jobs);

}  // namespace umbsim

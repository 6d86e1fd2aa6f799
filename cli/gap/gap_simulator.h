#pragma once

#include <string>
#include <utility>

#include "experiment/replay/replay.h"
#include "gap/output/diagnosis_progress.h"
#include "gap/replay/signature_cache.h"

namespace umbsim {

/// The replay as gap/ asks for it.
gap::Simulator gap_simulator(const Replay& replay);

/// The same, with its tracks kept in the user's cache folder; `no_cache`: only while the program runs.
gap::Simulator cached_gap_simulator(const Replay& replay, bool no_cache);

/// The stage of the work, how far the whole has come and the time left, on a terminal only; the line is wiped at the
/// end.
class GapStages {
 public:
  GapStages(std::size_t runs, std::vector<gap::UsualStage> usual);
  ~GapStages();
  GapStages(const GapStages&) = delete;
  GapStages& operator=(const GapStages&) = delete;

  /// The same simulator, counted. The stages must outlive it.
  gap::Simulator counted(const gap::Simulator& simulator) { return progress_.counted(simulator); }
  void report(const std::string& stage, double share) { progress_.stage(stage, share); }
  void done();

 private:
  void wipe() const;

  bool terminal_;
  bool done_ = false;
  gap::DiagnosisProgress progress_;
};

}  // namespace umbsim

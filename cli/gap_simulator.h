#pragma once

#include <string>
#include <utility>

#include "experiment/replay.h"
#include "gap/diagnosis_progress.h"
#include "gap/signature_cache.h"

namespace umbsim {

/// The replay as gap/ asks for it.
gap::Simulator gap_simulator(const Replay& replay);

/// The same, with its tracks kept in the user's cache folder; `no_cache`: only while the program runs.
gap::Simulator cached_gap_simulator(const Replay& replay, bool no_cache);

/// Stages of the work and the time left, on a terminal only; the line is wiped at the end.
class GapStages {
 public:
  explicit GapStages(std::size_t runs);
  ~GapStages();
  GapStages(const GapStages&) = delete;
  GapStages& operator=(const GapStages&) = delete;

  /// The same simulator, counted. The stages must outlive it.
  gap::Simulator counted(gap::Simulator simulator) { return progress_.counted(std::move(simulator)); }
  void say(const std::string& stage) { progress_.stage(stage); }
  void done();

 private:
  bool terminal_;
  gap::DiagnosisProgress progress_;
};

}  // namespace umbsim

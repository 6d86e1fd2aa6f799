#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "gap/output/progress_estimate.h"
#include "gap/replay/simulator.h"

namespace umbsim::gap {

/// What a line of progress shows.
struct ProgressShown {
  std::string stage;
  double elapsed_s = 0;
  double fraction = 0;  ///< of the whole work; never falls
  double left_s = -1;   ///< negative: not known yet
};

/// How far a diagnosis or a plan has come, from its stages and by counting simulations. Safe to use from several
/// threads.
class DiagnosisProgress {
 public:
  /// `show`: called at a new stage and a few times a second. `runs`: that are simulated.
  using Show = std::function<void(const ProgressShown&)>;
  DiagnosisProgress(std::size_t runs, std::vector<UsualStage> usual, Show show);

  /// The same simulator, counted. The progress must outlive it.
  Simulator counted(const Simulator& simulator);

  void stage(const std::string& name, double share);
  void finish();

 private:
  void one_more();
  void draw(bool at_once);
  double elapsed_s() const;

  double runs_;
  Show show_;
  std::chrono::steady_clock::time_point start_;
  double drawn_s_ = 0;
  std::string stage_;
  double simulated_ = 0;  // in this stage
  ProgressEstimate estimate_;
  std::mutex mutex_;
};

}  // namespace umbsim::gap

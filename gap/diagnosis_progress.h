#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>

#include "gap/simulator.h"

namespace umbsim::gap {

/// How far a diagnosis has come, by counting simulations against how many the stages usually take.
class DiagnosisProgress {
 public:
  /// `show`: called with the seconds so far, the stage and the seconds left, at a new stage and a few times a second;
  /// negative: not known yet. `runs`: of the recording.
  using Show = std::function<void(double elapsed_s, const std::string& stage, double left_s)>;
  DiagnosisProgress(std::size_t runs, Show show);

  /// The same simulator, counted. The progress must outlive it.
  Simulator counted(Simulator simulator);

  void stage(const std::string& name);

  /// Simulations still to come: `per_run` of each run, less those that the stage has done already.
  double expected_left() const;

 private:
  void one_more();
  void draw();

  std::size_t runs_;
  Show show_;
  std::chrono::steady_clock::time_point start_;
  double drawn_s_ = -1;
  std::string stage_ = "noise and nuisances";
  double done_ = 0;
  double done_before_stage_ = 0;
  mutable std::mutex mutex_;
};

}  // namespace umbsim::gap

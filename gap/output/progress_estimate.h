#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace umbsim::gap {

/// What a stage of some work usually takes.
struct UsualStage {
  std::string name;
  double time = 0;                 ///< in any unit that all stages share
  double comes = 1;                ///< probability that it comes at all, once the stage before it has begun
  double simulations_per_run = 0;  ///< where they are always as many, so that counting them says how far it is
};

/// How far work has come of which nobody knows beforehand how much there is. Each stage's usual time, weighted with
/// the probability that it comes, is stretched by how the stages so far compare to theirs: the geometric mean of their
/// ratios, for what one stage takes says little of the next.
class ProgressEstimate {
 public:
  explicit ProgressEstimate(std::vector<UsualStage> usual) : usual_(std::move(usual)) {}

  /// A stage of the table has come so far at a time since the work's start; a share of 0 begins it. Shares and times do
  /// not fall; stages come in the order of the table.
  void reached(const std::string& stage, double share, double now_s);
  void finished() { fraction_ = 1; }

  /// Seconds that are expected from `now_s` on; negative: not known yet.
  double left_s(double now_s) const;
  /// Share of all time that is over: never falls, and is 1 only when the work is finished.
  double fraction(double now_s);

  const UsualStage* current() const { return at_ < usual_.size() ? &usual_[at_] : nullptr; }

 private:
  double pace(double now_s) const;
  double log_ratio(double share, double now_s) const;

  std::vector<UsualStage> usual_;
  std::size_t at_ = 0;
  double share_ = 0;
  double began_s_ = 0;     // the stage
  double log_ratios_ = 0;  // sum over the stages before, of their times over the usual ones
  int ratios_ = 0;
  double fraction_ = 0;
};

/// Those of a diagnosis, in units of simulating the effects' signatures (docs/gap.md).
std::vector<UsualStage> stages_of_diagnosis();

/// The same of a plan.
std::vector<UsualStage> stages_of_plan();

}  // namespace umbsim::gap

#include "gap/output/progress_estimate.h"

#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

constexpr double kTrustUsual = 0.7;  // a stage's usual time weighs as much as that share of the stage itself
constexpr double kTellsPace = 0.1;   // usual time of a stage that says how fast the others are
constexpr int kFirst = 2;
constexpr double kHalfDone = 0.5;
constexpr double kShortest_s = 1e-3;
constexpr double kNeverWhole = 0.99;

}  // namespace

// Processor times of recordings of several kinds over that of the signatures (tests/gap/progress_traces.csv).
std::vector<UsualStage> stages_of_diagnosis() {
  return {{"noise and nuisances", 0.2, 1, 9},
          {"signatures of the effects", 1, 1, 41},
          {"fitting single effects", 2.3},
          {"fitting pairs of effects", 2.5, 0.8},
          {"fitting combinations of three", 3, 0.5},
          {"held-out runs", 0.01},
          {"what no effect explains", 0.2},
          {"what could be another effect", 0.1},
          {"what to drive next", 1, 0.4}};
}

std::vector<UsualStage> stages_of_plan() {
  return {{"driving the runs and the menu under every effect", 1}, {"choosing runs", 0.2}};
}

void ProgressEstimate::reached(const std::string& stage, double share, double now_s) {
  const auto there = std::find_if(usual_.begin() + std::ptrdiff_t(at_), usual_.end(),
                                  [&](const UsualStage& u) { return u.name == stage; });
  if (there == usual_.end()) return;
  const std::size_t next = std::size_t(there - usual_.begin());
  if (next == at_) {
    share_ = std::clamp(share, share_, 1.0);
    return;
  }
  if (usual_[at_].time >= kTellsPace) {
    log_ratios_ += log_ratio(1, now_s);
    ++ratios_;
  }
  at_ = next;
  share_ = share;
  began_s_ = now_s;
}

double ProgressEstimate::log_ratio(double share, double now_s) const {
  return std::log(std::max(kShortest_s, now_s - began_s_) / (share * usual_[at_].time));
}

// Seconds that a unit of the usual times takes here; 0: not known. The first stages count as soon as they are half
// done.
double ProgressEstimate::pace(double now_s) const {
  const bool counts = ratios_ < kFirst && share_ >= kHalfDone && usual_[at_].time >= kTellsPace;
  const int ratios = ratios_ + (counts ? 1 : 0);
  if (ratios == 0) return 0;
  return std::exp((log_ratios_ + (counts ? log_ratio(share_, now_s) : 0)) / ratios);
}

double ProgressEstimate::left_s(double now_s) const {
  const double s_per_unit = pace(now_s);
  if (s_per_unit == 0) return -1;
  const UsualStage& stage = usual_[at_];
  const double whole_s = (kTrustUsual * s_per_unit * stage.time + now_s - began_s_) / (kTrustUsual + share_);
  double left = (1 - share_) * whole_s;
  double chance = 1;
  for (std::size_t i = at_ + 1; i < usual_.size(); ++i) {
    chance = usual_[i].comes < 1 ? chance * usual_[i].comes : 1;
    left += chance * s_per_unit * usual_[i].time;
  }
  return left;
}

double ProgressEstimate::fraction(double now_s) {
  const double left = left_s(now_s);
  if (left >= 0 && now_s > 0) fraction_ = std::max(fraction_, std::min(kNeverWhole, now_s / (now_s + left)));
  return fraction_;
}

}  // namespace umbsim::gap

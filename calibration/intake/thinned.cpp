#include "calibration/intake/thinned.h"

#include <algorithm>
#include <cmath>

namespace umbsim::intake {
namespace {

// Clocks are written to some digits: a rate that is above by less than this is not above.
constexpr double kRounding = 1e-3;

// Of how many readings one is kept.
std::size_t stride_of(double rate_hz, double most_hz) {
  return std::size_t(std::max(1.0, std::ceil(rate_hz / most_hz - kRounding)));
}

template <typename Sample>
void keep_every(std::size_t stride, std::vector<Sample>& all) {
  if (stride == 1 || all.empty()) return;
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < all.size(); i += stride) kept.push_back(all[i]);
  if ((all.size() - 1) % stride != 0) kept.push_back(all.back());
  all = std::move(kept);
}

}  // namespace

Recording thinned_truth(Recording recording, double most_hz) {
  if (recording.truth_kind != "track") return recording;
  for (RecordedRun& run : recording.runs) {
    if (run.truth.size() < 2) continue;
    const double lasts_s = run.truth.back().time_s - run.truth.front().time_s;
    keep_every(stride_of(double(run.truth.size() - 1) / lasts_s, most_hz), run.truth);
  }
  return recording;
}

Recording thinned_counts(Recording recording, double most_hz) {
  const std::size_t stride = stride_of(recording.encoder_rate_hz, most_hz);
  for (RecordedRun& run : recording.runs) keep_every(stride, run.encoders);
  recording.encoder_rate_hz /= double(stride);
  return recording;
}

}  // namespace umbsim::intake

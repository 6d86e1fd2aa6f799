#include "gap/replay/thinned.h"

#include <cmath>

namespace umbsim::gap {
namespace {

// Clocks are written to some digits: a rate that is above by less than this is not above.
constexpr double kRounding = 1e-3;

std::vector<TruthSample> every(std::size_t stride, const std::vector<TruthSample>& all) {
  std::vector<TruthSample> kept;
  for (std::size_t i = 0; i < all.size(); i += stride) kept.push_back(all[i]);
  if ((all.size() - 1) % stride != 0) kept.push_back(all.back());
  return kept;
}

}  // namespace

Recording thinned(Recording recording, double most_hz) {
  if (recording.truth_kind != "track") return recording;
  for (RecordedRun& run : recording.runs) {
    if (run.truth.size() < 2) continue;
    const double lasts_s = run.truth.back().time_s - run.truth.front().time_s;
    const double stride = std::ceil(double(run.truth.size() - 1) / (lasts_s * most_hz) - kRounding);
    if (stride > 1) run.truth = every(std::size_t(stride), run.truth);
  }
  return recording;
}

}  // namespace umbsim::gap

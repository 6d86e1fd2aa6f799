#include "experiment/replay/even_stretches.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace umbsim {
namespace {

// What a stretch may be. With these replays take a quarter of the steps. What rolls is where it would be with the time
// steps of the samples; what creeping contacts do, whose forces are no multiple of the speed, is the same to 1 %.
constexpr double kLongest_s = 0.2;
constexpr double kLargestTurn_rad = 0.1;  // how far the robot turns in it
constexpr double kUneven_m = 5e-5;        // how far a wheel is from where it would be at an even speed
constexpr double kBeside_m = 2e-5;        // the same across the line on which both wheels' ways are in proportion

// Both wheels' ways from the start of a stretch.
struct Ways {
  double left_m;
  double right_m;
};

// Whether these are as uneven as one step may be, at a share of the time of `all`.
bool even_at(const Ways& part, const Ways& all, double share) {
  const double length_m = std::max(1e-12, std::hypot(all.left_m, all.right_m));
  const double along_m = (part.left_m * all.left_m + part.right_m * all.right_m) / length_m;
  const double beside_m = (part.left_m * all.right_m - part.right_m * all.left_m) / length_m;
  return std::abs(beside_m) < kBeside_m && std::abs(along_m - share * length_m) < kUneven_m;
}

// At each sample: the larger of both wheels' accelerations.
std::vector<double> accelerations_mps2(const std::vector<EncoderSample>& s,
                                       const std::array<std::vector<double>, 2>& way_m) {
  std::vector<double> largest(s.size());
  for (const std::vector<double>& way : way_m) {
    double before_mps = 0;
    for (std::size_t i = 1; i < s.size(); ++i) {
      const double period_s = s[i].time_s - s[i - 1].time_s, speed_mps = (way[i] - way[i - 1]) / period_s;
      largest[i] = std::max(largest[i], std::abs(speed_mps - before_mps) / period_s);
      before_mps = speed_mps;
    }
  }
  return largest;
}

// From the start of a stretch, by both wheels' ways.
Pose2 arc_of(const Ways& w, double wheelbase_m) {
  return arc((w.left_m + w.right_m) / 2, (w.right_m - w.left_m) / wheelbase_m);
}

}  // namespace

EvenStretches even_stretches(const std::vector<EncoderSample>& s, const std::array<std::vector<double>, 2>& turned_rad,
                             const std::array<double, 2>& radius_m, double wheelbase_m) {
  std::array<std::vector<double>, 2> way_m = turned_rad;
  for (std::size_t w = 0; w < 2; ++w) {
    for (double& m : way_m[w]) m *= radius_m[w];
  }
  const auto ways = [&](std::size_t from, std::size_t to) {
    return Ways{way_m[0][to] - way_m[0][from], way_m[1][to] - way_m[1][from]};
  };
  const auto even = [&](std::size_t from, std::size_t to) {
    const double all_s = s[to].time_s - s[from].time_s;
    const Ways all = ways(from, to);
    if (all_s > kLongest_s + 1e-9 || std::abs(all.right_m - all.left_m) > kLargestTurn_rad * wheelbase_m) return false;
    for (std::size_t k = from + 1; k < to; ++k) {
      if (!even_at(ways(from, k), all, (s[k].time_s - s[from].time_s) / all_s)) return false;
    }
    return true;
  };
  const std::vector<double> acceleration_mps2 = accelerations_mps2(s, way_m);
  EvenStretches stretches;
  for (std::size_t from = 0; from + 1 < s.size(); from = stretches.back().end) {
    EvenStretch stretch;
    std::size_t& to = stretch.end = from + 1;
    while (to + 1 < s.size() && even(from, to + 1)) ++to;
    for (std::size_t w = 0; w < 2; ++w) stretch.turned_rad[w] = turned_rad[w][to] - turned_rad[w][from];
    stretch.as_one_arc = arc_of(ways(from, to), wheelbase_m);
    Pose2 reckoned;
    for (std::size_t k = from + 1; k <= to; ++k) {
      stretch.peak_mps2 = std::max(stretch.peak_mps2, acceleration_mps2[k]);
      reckoned = reckoned * arc_of(ways(k - 1, k), wheelbase_m);
      stretch.sample_by_sample.push_back(reckoned);
    }
    stretches.push_back(std::move(stretch));
  }
  return stretches;
}

}  // namespace umbsim

#include "recording/stretches.h"

#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

constexpr double kWindow_s = 0.2;        // over which speeds are taken
constexpr double kStill_mps = 0.004;     // of either wheel
constexpr double kShortest_s = 0.25;     // shorter stretches belong to their neighbour
constexpr double kTurning = 0.15;        // half the difference of the wheels' speeds, over their mean

struct Motion {
  double left_m = 0;
  double right_m = 0;
};

Motion between(const RecordedRun& run, const RecordedRobot& robot, std::size_t a, std::size_t b) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  const EncoderSample& p = run.encoders[a];
  const EncoderSample& q = run.encoders[b];
  return {k * double(q.left_ticks - p.left_ticks), k * double(q.right_ticks - p.right_ticks)};
}

Stretch::Kind kind_at(const RecordedRun& run, const RecordedRobot& robot, std::size_t i, std::size_t half) {
  const std::size_t a = i > half ? i - half : 0;
  const std::size_t b = std::min(run.encoders.size() - 1, i + 1 + half);
  const Motion m = between(run, robot, a, b);
  const double dt = run.encoders[b].time_s - run.encoders[a].time_s;
  // A tick or two of jitter is no motion.
  const double tick_m = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  const double still_m = std::max(kStill_mps * dt, std::min(1.5 * tick_m, 0.02 * dt));
  if (std::abs(m.left_m) <= still_m && std::abs(m.right_m) <= still_m) return Stretch::Kind::still;
  const double turning_m = std::abs(m.right_m - m.left_m) / 2;
  return turning_m > kTurning * std::abs(m.right_m + m.left_m) / 2 + still_m ? Stretch::Kind::turn : Stretch::Kind::leg;
}

// Stretches too short to be anything go to the neighbour before them.
void merge_short(std::vector<Stretch>& all) {
  std::vector<Stretch> merged;
  for (const Stretch& s : all) {
    const bool tiny = s.end_s - s.start_s < (s.kind == Stretch::Kind::still ? 0.1 : kShortest_s);
    if (!merged.empty() && (tiny || merged.back().kind == s.kind)) {
      merged.back().last = s.last;
      merged.back().end_s = s.end_s;
    } else {
      merged.push_back(s);
    }
  }
  all = std::move(merged);
}

}  // namespace

const char* name(Stretch::Kind kind) {
  switch (kind) {
    case Stretch::Kind::still: return "still";
    case Stretch::Kind::leg: return "leg";
    case Stretch::Kind::turn: return "turn";
  }
  return "";
}

std::vector<Stretch> stretches(const RecordedRun& run, const RecordedRobot& robot) {
  std::vector<Stretch> all;
  const std::size_t n = run.encoders.size();
  if (n < 2) return all;
  const double period_s = (run.encoders.back().time_s - run.encoders.front().time_s) / double(n - 1);
  const std::size_t half = std::size_t(std::max(1L, std::lround(kWindow_s / period_s / 2)));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Stretch::Kind kind = kind_at(run, robot, i, half);
    if (all.empty() || all.back().kind != kind) {
      all.push_back({kind, 0, i, i + 1, run.encoders[i].time_s, run.encoders[i + 1].time_s, 0, 0});
    }
    all.back().last = i + 1;
    all.back().end_s = run.encoders[i + 1].time_s;
  }
  merge_short(all);
  int leg = 0;
  for (Stretch& s : all) {
    const Motion m = between(run, robot, s.first, s.last);
    s.length_m = (m.left_m + m.right_m) / 2;
    s.angle_rad = (m.right_m - m.left_m) / robot.wheelbase_m;
    if (s.kind == Stretch::Kind::leg) ++leg;
    s.leg = leg;
  }
  return all;
}

}  // namespace umbsim

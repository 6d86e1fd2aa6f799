#include "bench/worlds/world/tracker.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace umbsim::worlds {
namespace {

// A heading of this spread, unwrapped, is any heading: what the header of a tracker without one says.
constexpr double kNoHeading_rad = M_PI;

Pose2 measured(const Pose2& X_WB, const TrackerChoice& t, RandomStream& random) {
  const Pose2 X_TM = t.X_TW * X_WB * t.X_BM;
  const double x = random.normal(X_TM.x_m, t.position_sd_m), y = random.normal(X_TM.y_m, t.position_sd_m);
  return {x, y, t.sees_heading ? random.normal(X_TM.theta_rad, t.heading_sd_rad) : 0};
}

// Loses poses in stretches: a chain of two states whose share of lost ones is `dropout` (Gilbert 1960).
class Dropouts {
 public:
  explicit Dropouts(const TrackerChoice& t)
      : back_(std::min(1.0, 1 / (t.dropout_s * t.rate_hz))), away_(back_ * t.dropout / (1 - t.dropout)) {}
  bool lost(RandomStream& random) {
    const double u = random.uniform();
    lost_ = lost_ ? u >= back_ : u < away_;
    return lost_;
  }

 private:
  double back_;
  double away_;
  bool lost_ = false;
};

}  // namespace

TrackerChoice exact_tracker(const std::string& kind) {
  TrackerChoice t;
  t.kind = kind;
  if (kind == "camera") {
    t.rate_hz = 20;
    t.position_sd_m = 0.01;
    t.heading_sd_rad = 0.01;
  } else if (kind == "total_station") {
    t.rate_hz = 5;
    t.position_sd_m = 0.002;
    t.heading_sd_rad = kNoHeading_rad;
    t.sees_heading = false;
  } else if (kind == "tape") {
    t.position_sd_m = 0.002;
    t.heading_sd_rad = 0.3 * M_PI / 180;
    t.end_points = true;
  } else if (kind != "mocap") {
    throw InputError("no tracker '" + kind + "'");
  }
  return t;
}

TrackerChoice draw_tracker(const std::string& kind, RandomStream& random) {
  TrackerChoice t = exact_tracker(kind);
  t.X_TW = {random.normal(0, 0.005), random.normal(0, 0.005), random.normal(0, 0.01)};
  t.X_BM = {random.normal(0, 0.003), random.normal(0, 0.003), random.normal(0, 0.005)};
  const double u = random.uniform(), late = random.uniform(), drift = random.normal(), lost = random.uniform();
  if (kind == "camera") {
    t.rate_hz = std::round(10 + 20 * u);
    t.delay_s = 0.05 + 0.1 * late;
    t.clock_drift = 1e-4 * drift;  // a camera's free-running quartz and frame clock
    t.dropout = 0.1 * lost;
  }
  return t;
}

Pose2 pose_at(const std::vector<TruthSample>& dense, double time_s) {
  const auto after =
      std::lower_bound(dense.begin(), dense.end(), time_s, [](const TruthSample& s, double t) { return s.time_s < t; });
  if (after == dense.begin()) return dense.front().X_WB;
  if (after == dense.end()) return dense.back().X_WB;
  const TruthSample& a = *(after - 1);
  const double part = (time_s - a.time_s) / (after->time_s - a.time_s);
  const auto between = [part](double from, double to) { return from + part * (to - from); };
  return {between(a.X_WB.x_m, after->X_WB.x_m), between(a.X_WB.y_m, after->X_WB.y_m),
          between(a.X_WB.theta_rad, after->X_WB.theta_rad)};
}

std::vector<TruthSample> observe(const std::vector<TruthSample>& dense, const TrackerChoice& t, RandomStream random) {
  std::vector<TruthSample> seen;
  const double end_s = dense.back().time_s;
  if (t.end_points) {
    for (const TruthSample* s : {&dense.front(), &dense.back()})
      seen.push_back({s->time_s, measured(s->X_WB, t, random)});
    return seen;
  }
  const int last = int(std::floor(end_s * t.rate_hz + 1e-9));
  Dropouts dropouts(t);
  for (int k = 0; k <= last; ++k) {
    const double time_s = k / t.rate_hz;
    const Pose2 X_TM = measured(pose_at(dense, time_s), t, random);
    const bool lost = dropouts.lost(random);
    if (lost && k != 0 && k != last) continue;
    seen.push_back({time_s * (1 + t.clock_drift) + t.delay_s, X_TM});
  }
  return seen;
}

}  // namespace umbsim::worlds

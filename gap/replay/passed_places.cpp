#include "gap/replay/passed_places.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace umbsim::gap {
namespace {

constexpr std::size_t kStride = 2;     // truth samples between two candidates
constexpr double kWheelbase_m = 0.36;  // of a robot to which these lengths belong; others in proportion:
constexpr double kSpot_m = 0.03;
constexpr double kReach_m = 0.05;  // half length of what lies across the path

Pose2 wheel_place(const Pose2& X_WB, int wheel, double wheelbase_m) {
  return X_WB * Pose2{0, (wheel == 0 ? 0.5 : -0.5) * wheelbase_m, 0};
}

// One wheel of a run, at each sample of the truth.
struct WheelTrack {
  std::vector<Pose2> at;
  std::vector<double> rolled_m;  // as the counts say: it does not grow while a robot stands and a noisy tracker sees it
                                 // here and there
};

WheelTrack wheel_track(const NominalReplay& nominal, std::size_t r, int wheel) {
  const double b_m = nominal.recording->robot.wheelbase_m;
  const std::vector<Pose2>& believed = nominal.tracks[r];
  // Where the tracker saw the robot; between end points, where the wheels believed to be.
  const bool tracked = nominal.origin[r]->truth_kind != "endpoints";
  WheelTrack track;
  for (std::size_t k = 0; k < believed.size(); ++k) {
    const Pose2& X_WB = tracked ? nominal.recording->runs[r].truth[k].X_WB : believed[k];
    track.at.push_back(wheel_place(X_WB, wheel, b_m));
    if (k == 0) {
      track.rolled_m.push_back(0);
      continue;
    }
    const Pose2 a = wheel_place(believed[k - 1], wheel, b_m), b = wheel_place(believed[k], wheel, b_m);
    track.rolled_m.push_back(track.rolled_m.back() + std::hypot(b.x_m - a.x_m, b.y_m - a.y_m));
  }
  return track;
}

struct TrackedRun {
  std::array<WheelTrack, 2> wheels;
  std::vector<bool> straight;  // whether the robot is on a leg, at each sample
};

TrackedRun tracked_run(const NominalReplay& nominal, std::size_t r, const std::vector<Stretch>& stretches) {
  TrackedRun run{{wheel_track(nominal, r, 0), wheel_track(nominal, r, 1)}, {}};
  for (const TruthSample& sample : nominal.recording->runs[r].truth) {
    run.straight.push_back(std::any_of(stretches.begin(), stretches.end(), [&](const Stretch& s) {
      return s.kind == Stretch::Kind::leg && s.start_s <= sample.time_s && sample.time_s <= s.end_s;
    }));
  }
  return run;
}

std::vector<PassedPlace> candidates(const NominalReplay& nominal, const std::vector<TrackedRun>& runs) {
  const double spot_m = length_scale(nominal.recording->robot) * kSpot_m;
  std::vector<PassedPlace> places;
  std::set<std::string> seen;
  std::set<std::pair<long, long>> spots;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!seen.insert(nominal.conditions[r] + nominal.recording->runs[r].direction).second) continue;
    for (std::size_t k = 1; k < nominal.tracks[r].size(); k += kStride) {
      for (int w = 0; w < 2; ++w) {
        const Pose2& at = runs[r].wheels[std::size_t(w)].at[k];
        if (spots.insert({std::lround(at.x_m / spot_m), std::lround(at.y_m / spot_m)}).second)
          places.push_back({at.x_m, at.y_m, at.theta_rad, w, {}});
      }
    }
  }
  return places;
}

struct Approach {
  std::size_t sample = 0;
  double apart_m2 = 0;
};

// Nearest approaches of a wheel. A pass is over when the wheel has rolled on beyond its reach.
std::vector<Approach> approaches(const PassedPlace& place, const WheelTrack& wheel, double reach_m) {
  std::vector<Approach> passes;
  const Approach none{0, reach_m * reach_m};
  Approach nearest = none;
  const auto take = [&] {
    if (nearest.apart_m2 < none.apart_m2) passes.push_back(nearest);
    nearest.apart_m2 = none.apart_m2;
  };
  for (std::size_t k = 1; k < wheel.at.size(); ++k) {
    const double dx = wheel.at[k].x_m - place.x_m;
    const double dy = wheel.at[k].y_m - place.y_m;
    const double d = dx * dx + dy * dy;
    if (d < nearest.apart_m2)
      nearest = {k, d};
    else if (wheel.rolled_m[k] - wheel.rolled_m[nearest.sample] > 2 * reach_m)
      take();
  }
  take();
  return passes;
}

void note_passes(const std::vector<TrackedRun>& runs, double reach_m, PassedPlace& place) {
  double nearest_leg_m2 = 1e300;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (int w = 0; w < 2; ++w) {
      const WheelTrack& wheel = runs[r].wheels[std::size_t(w)];
      for (const Approach& pass : approaches(place, wheel, reach_m)) {
        place.passes.push_back({r, pass.sample, w});
        // What lies across the path lies across that of a leg, where there is one: in a corner headings are many.
        if (!runs[r].straight[pass.sample] || pass.apart_m2 >= nearest_leg_m2) continue;
        nearest_leg_m2 = pass.apart_m2;
        place.heading_rad = wheel.at[pass.sample].theta_rad;
      }
    }
  }
}

}  // namespace

double length_scale(const RecordedRobot& robot) { return std::clamp(robot.wheelbase_m / kWheelbase_m, 0.3, 2.0); }

std::vector<PassedPlace> passed_places(const NominalReplay& nominal,
                                       const std::vector<std::vector<Stretch>>& stretches) {
  std::vector<TrackedRun> runs;
  for (std::size_t r = 0; r < nominal.runs(); ++r) runs.push_back(tracked_run(nominal, r, stretches[r]));
  std::vector<PassedPlace> places = candidates(nominal, runs);
  const double reach_m = length_scale(nominal.recording->robot) * kReach_m;
  tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t i) { note_passes(runs, reach_m, places[i]); });
  return places;
}

}  // namespace umbsim::gap

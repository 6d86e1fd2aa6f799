#include "gap/replay/nominal_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "recording/encoder_clock.h"

namespace umbsim::gap {
namespace {

constexpr double kDensest_hz = 12;  // of a truth that is used whole
constexpr double kThinned_hz = 2;   // of one that is thinned

std::vector<std::array<double, 2>> travel(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  EncoderClock clock(run.encoders);
  std::vector<std::array<double, 2>> at;
  for (const TruthSample& t : run.truth) {
    const auto m = clock.at(t.time_s);
    const EncoderSample& a = run.encoders[m.before];
    const EncoderSample& b = run.encoders[m.before + 1];
    at.push_back({k * m.between(double(a.left_ticks), double(b.left_ticks)),
                  k * m.between(double(a.right_ticks), double(b.right_ticks))});
  }
  for (std::size_t j = at.size() - 1; j > 0; --j) {
    at[j][0] -= at[j - 1][0];
    at[j][1] -= at[j - 1][1];
  }
  at[0] = {0, 0};
  return at;
}

std::vector<Eigen::Vector3d> velocity(const std::vector<TruthSample>& truth, const std::vector<Pose2>& path) {
  std::vector<Eigen::Vector3d> result;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const std::size_t a = k > 0 ? k - 1 : 0;
    const std::size_t b = std::min(path.size() - 1, k + 1);
    const Pose2 u = inverse(path[a]) * path[b];
    const double dt = std::max(1e-6, truth[b].time_s - truth[a].time_s);
    result.emplace_back(u.x_m / dt, u.y_m / dt, u.theta_rad / dt);
  }
  return result;
}

std::vector<bool> seen(const Recording& recording, const RecordedRun& run) {
  const std::size_t n = run.truth.size();
  const double rate_hz = double(n - 1) / (run.truth.back().time_s - run.truth.front().time_s);
  const std::size_t every = rate_hz > kDensest_hz ? std::size_t(std::ceil(rate_hz / kThinned_hz)) : 1;
  std::vector<bool> result(n);
  for (std::size_t k = 0; k < n; ++k) {
    result[k] = k == 0 || k + 1 == n || (recording.truth_kind != "endpoints" && k % every == 0);
  }
  return result;
}

std::string condition(const RecordedRun& run, const RecordedPath& path) {
  return fmt::format("{} {} {} {}", run.linear_speed_mps.value_or(path.linear_speed_mps.value_or(0)),
                     run.payload_kg.value_or(0), run.turn.value_or(path.turn), run.start_heading_rad.value_or(0));
}

}  // namespace

namespace {

NominalReplay beside(const Recording& recording, std::vector<const Recording*> origin,
                     std::vector<std::vector<Pose2>> tracks) {
  NominalReplay n;
  n.recording = &recording;
  n.origin = std::move(origin);
  n.tracks = std::move(tracks);
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const RecordedRun& run = recording.runs[r];
    n.conditions.push_back(condition(run, n.origin[r]->path));
    n.truth.emplace_back();
    for (const TruthSample& t : run.truth) n.truth.back().push_back(t.X_WB);
    n.wheels_m.push_back(travel(run, recording.robot));
    n.rolled_m.emplace_back();
    for (const auto& d : n.wheels_m.back()) n.rolled_m.back().push_back((std::abs(d[0]) + std::abs(d[1])) / 2);
    n.velocity.push_back(velocity(run.truth, n.tracks[r]));
    n.seen.push_back(seen(*n.origin[r], run));
  }
  return n;
}

}  // namespace

NominalReplay beside(const Campaign& campaign, std::vector<std::vector<Pose2>> tracks) {
  std::vector<const Recording*> origin;
  for (std::size_t r = 0; r < campaign.all.runs.size(); ++r) origin.push_back(&campaign.of(r));
  return beside(campaign.all, std::move(origin), std::move(tracks));
}

NominalReplay beside(const Recording& recording, std::vector<std::vector<Pose2>> tracks) {
  const std::vector<const Recording*> origin(recording.runs.size(), &recording);
  return beside(recording, origin, std::move(tracks));
}

NominalReplay part_of(const NominalReplay& nominal, const Campaign& campaign, std::size_t part) {
  std::vector<std::vector<Pose2>> tracks;
  for (std::size_t r = 0; r < nominal.runs(); ++r) {
    if (campaign.part_of[r] == part) tracks.push_back(nominal.tracks[r]);
  }
  return beside(campaign.parts[part], std::move(tracks));
}

// Derivatives of ds = (l + r) / 2 and dtheta = (r - l) / b (NUMBERS.md, odometry).
Impulses3 radius_impulses(const NominalReplay& nominal, std::size_t run, int wheel) {
  const double b_m = nominal.recording->robot.wheelbase_m;
  Impulses3 impulses;
  for (const auto& way : nominal.wheels_m[run]) {
    const double d = way[std::size_t(wheel)];
    impulses.emplace_back(d / 2, 0, (wheel == 0 ? -d : d) / b_m);
  }
  return impulses;
}

std::vector<CoursePart> parts_of(const NominalReplay& nominal, std::size_t run) {
  constexpr double kSpeedingShare = 0.02;  // of the longest way in a sample, by which one is not like that before
  const auto& ways = nominal.wheels_m[run];
  double longest_m = 0;
  for (const auto& way : ways) longest_m = std::max({longest_m, std::abs(way[0]), std::abs(way[1])});
  std::vector<CoursePart> parts(ways.size(), kLeg);
  for (std::size_t k = 1; k < ways.size(); ++k) {
    const double ds_m = (ways[k][0] + ways[k][1]) / 2;
    const double turned_m = std::abs(ways[k][1] - ways[k][0]) / 2;
    double faster_m = 0;
    for (int w = 0; w < 2; ++w) faster_m = std::max(faster_m, std::abs(ways[k][w] - ways[k - 1][w]));
    parts[k] = faster_m > kSpeedingShare * longest_m ? kSpeeding
               : turned_m < 0.05 * std::abs(ds_m)    ? kLeg
               : std::abs(ds_m) > 0.3 * turned_m     ? kArc
                                                     : kInPlace;
  }
  return parts;
}

}  // namespace umbsim::gap

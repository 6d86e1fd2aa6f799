#include <algorithm>
#include <cmath>

#include "experiment/build_info.h"
#include "experiment/result_json.h"

namespace umbsim {
namespace {

// At most this many poses of a run go into the page, and of all runs together about so many.
constexpr std::size_t kRunPoses = 400;
constexpr std::size_t kPagePoses = 24000;
constexpr std::size_t kFewestRunPoses = 40;
// About as many ellipses of a run.
constexpr std::size_t kPageEllipses = 20;

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json path_json(const Pose2& p) { return Json::array({rounded(p.x_m), rounded(p.y_m), rounded(p.theta_rad)}); }

// Truth and odometry at the same moments, in the floor frame.
void add_paths(Json& json, const RecordedRun& run, const OdometryParameters& odometry, std::size_t most_poses) {
  json["truth"] = Json::array();
  json["odometry"] = Json::array();
  const std::size_t stride = 1 + run.truth.size() / most_poses;
  DeadReckoning reckoning(odometry, run.truth.front().X_WB, run.encoders.front().left_ticks,
                          run.encoders.front().right_ticks);
  std::size_t e = 0;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    for (; e < run.encoders.size() && run.encoders[e].time_s <= run.truth[i].time_s + 1e-9; ++e) {
      reckoning.update(run.encoders[e].left_ticks, run.encoders[e].right_ticks);
    }
    if (i % stride != 0 && i + 1 != run.truth.size()) continue;
    json["truth"].push_back(path_json(run.truth[i].X_WB));
    json["odometry"].push_back(path_json(reckoning.pose()));
  }
}

// 95 % ellipses along the way, [x, y, semi-axis a, b, angle of a, index of the pose in the path], in the floor frame,
// and the poses at which an absolute fix was taken.
void add_ellipses(Json& json, const RecordedRun& run, const PoseTrack& track, std::size_t most_poses) {
  const Pose2& X_WO = run.truth.front().X_WB;
  const std::size_t stride = 1 + track.samples.size() / most_poses, poses = json["odometry"].size();
  const std::size_t between = std::max<std::size_t>(1, poses / kPageEllipses);
  json["ellipses"] = Json::array();
  for (std::size_t i = 0; i < poses; ++i) {
    if (i % between != 0 && i + 1 != poses) continue;
    const UncertainPose& estimate = track.samples[std::min(i * stride, track.samples.size() - 1)].estimate;
    const Ellipse e = ellipse_95(estimate.covariance);
    const Pose2 centre = X_WO * estimate.X_OB;
    json["ellipses"].push_back(Json::array({rounded(centre.x_m), rounded(centre.y_m), rounded(e.a_m), rounded(e.b_m),
                                            rounded(e.angle_rad + X_WO.theta_rad), i}));
  }
  if (track.fixes.empty()) return;
  json["fixes"] = Json::array();
  for (const std::size_t sample : track.fixes) {
    json["fixes"].push_back(std::min((sample + stride - 1) / stride, poses - 1));
  }
}

void add_runs(Json& json, const Recording& recording, const OdometryParameters& odometry,
              const std::vector<PoseTrack>& tracks, const char* stage) {
  const std::size_t most_poses =
      std::clamp<std::size_t>(kPagePoses / std::max<std::size_t>(1, recording.runs.size()), kFewestRunPoses, kRunPoses);
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    const RecordedRun& run = recording.runs[i];
    const bool bumped = !run.bumps.empty() || run.inner_wheel_bumps;
    const ReturnError e = return_error(run, odometry);
    Json item{{"id", run.id},
              {"direction", run.direction},
              {"stage", bumped ? "bumped" : stage},
              {"error", {{"x_m", e.x_m}, {"y_m", e.y_m}, {"theta_rad", e.theta_rad}}}};
    add_paths(item, run, odometry, most_poses);
    if (!tracks[i].samples.empty()) add_ellipses(item, run, tracks[i], most_poses);
    json["runs"].push_back(std::move(item));
    for (const RecordedBump& b : run.bumps) {
      json["bumps"].push_back({{"run", run.id}, {"x_m", b.x_m}, {"y_m", b.y_m}, {"height_m", b.height_m}});
    }
  }
}

}  // namespace

Json report_json(const ExperimentResult& r) {
  Json json{{"title", r.recording.title},
            {"scenario", r.scenario.name},
            {"description", r.scenario.description},
            {"version", build_info().version},
            {"seed", r.scenario.seed},
            {"side_m", r.scenario.course.side_m},
            {"wheelbase_m", r.odometry.wheelbase_m},
            {"summary", summary_json(r)}};
  json["summary"]["cost"].erase("wall_s");  // the page is the same bytes on every run
  json["runs"] = Json::array();
  json["bumps"] = Json::array();
  add_runs(json, r.recording, r.odometry, r.tracks, "before");
  if (!r.passes.empty()) {
    const CalibrationPass& last = r.passes.back();
    add_runs(json, last.recording, last.odometry, last.tracks, "after");
  }
  return json;
}

}  // namespace umbsim

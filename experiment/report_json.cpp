#include <algorithm>
#include <cmath>

#include "experiment/build_info.h"
#include "experiment/result_json.h"

namespace umbsim {
namespace {

// About as many ellipses of a run.
constexpr std::size_t kPageEllipses = 20;

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json pose_json(const Pose2& p) { return Json::array({rounded(p.x_m), rounded(p.y_m), rounded(p.theta_rad)}); }

Json path_json(const std::vector<Pose2>& path) {
  Json json = Json::array();
  for (const Pose2& pose : path) json.push_back(pose_json(pose));
  return json;
}

// 95 % ellipses along the way, [x, y, semi-axis a, b, angle of a, index of the pose in the path], in the floor frame,
// and the poses at which an absolute fix was taken.
void add_ellipses(Json& json, const RunDigest& digest, const PoseTrack& track) {
  const Pose2& X_WO = digest.truth.front();
  const std::size_t poses = digest.estimates.size();
  const std::size_t between = std::max<std::size_t>(1, poses / kPageEllipses);
  json["ellipses"] = Json::array();
  for (std::size_t i = 0; i < poses; ++i) {
    if (i % between != 0 && i + 1 != poses) continue;
    const UncertainPose& estimate = digest.estimates[i];
    const Ellipse e = ellipse_95(estimate.covariance);
    const Pose2 centre = X_WO * estimate.X_OB;
    json["ellipses"].push_back(Json::array({rounded(centre.x_m), rounded(centre.y_m), rounded(e.a_m), rounded(e.b_m),
                                            rounded(e.angle_rad + X_WO.theta_rad), i}));
  }
  if (track.fixes.empty()) return;
  json["fixes"] = Json::array();
  for (const std::size_t sample : track.fixes) {
    json["fixes"].push_back(std::min((sample + digest.stride - 1) / digest.stride, poses - 1));
  }
}

void add_runs(Json& json, const DrivenRuns& driven, const char* stage) {
  for (std::size_t i = 0; i < driven.recording.runs.size(); ++i) {
    const RecordedRun& run = driven.recording.runs[i];
    const RunDigest& digest = driven.digests[i];
    const bool bumped = !run.bumps.empty() || run.inner_wheel_bumps;
    const ReturnError& e = digest.error;
    Json item{{"id", run.id},
              {"direction", run.direction},
              {"stage", bumped ? "bumped" : stage},
              {"error", {{"x_m", e.x_m}, {"y_m", e.y_m}, {"theta_rad", e.theta_rad}}},
              {"truth", path_json(digest.truth)},
              {"odometry", path_json(digest.odometry)}};
    if (!digest.estimates.empty()) add_ellipses(item, digest, driven.tracks[i]);
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
            {"wheelbase_m", r.odometry.wheelbase_m},
            {"summary", summary_json(r)}};
  if (r.scenario.course.shape == "square") json["side_m"] = r.scenario.course.side_m;
  json["summary"]["cost"].erase("wall_s");  // the page is the same bytes on every run
  json["runs"] = Json::array();
  json["bumps"] = Json::array();
  add_runs(json, r, "before");
  if (!r.passes.empty()) add_runs(json, r.passes.back(), "after");
  return json;
}

}  // namespace umbsim

#include "gap/output/tracks_json.h"

#include <algorithm>
#include <cmath>

#include "gap/evidence/track_misfit.h"

namespace umbsim::gap {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPoses = 300;  // of a run, at most, go into the page

double rounded(double value) { return std::round(value * 1e5) / 1e5; }

// The prediction as the tracker would see it, begun where it explains the recorded run best.
std::vector<Pose2> begun_right(const Model& model, std::size_t r, const std::vector<Pose2>& track) {
  const Eigen::Vector3d start = best_start(model, r, error_beside_mount(model, r, track));
  const Eigen::Vector3d mount = model.mount_error(r).head(3);
  const Pose2 motion = track[0] * Pose2{start[0], start[1], start[2]} * inverse(track[0]);
  std::vector<Pose2> result;
  for (const Pose2& p : track) result.push_back(motion * p * Pose2{mount[0], mount[1], mount[2]});
  return result;
}

// Every `stride`th pose and the last one.
Json thinned(const std::vector<Pose2>& track, std::size_t stride) {
  Json points = Json::array();
  for (std::size_t k = 0; k < track.size(); ++k) {
    if (k % stride != 0 && k + 1 != track.size()) continue;
    points.push_back({rounded(track[k].x_m), rounded(track[k].y_m), rounded(track[k].theta_rad)});
  }
  return points;
}

// Recorded minus predicted end, in the frame of the recorded start.
Json end_error(const RecordedRun& run, const std::vector<Pose2>& predicted) {
  const Pose2 X_BW = inverse(run.truth.front().X_WB);
  const Pose2 is = X_BW * run.truth.back().X_WB;
  const Pose2 said = X_BW * predicted.back();
  return {{"x_m", is.x_m - said.x_m}, {"y_m", is.y_m - said.y_m}, {"theta_rad", is.theta_rad - said.theta_rad}};
}

Json parts(const Diagnosis& d, const std::string& run, std::size_t stride) {
  Json all = Json::array();
  for (const SegmentScore& s : d.segments) {
    if (s.run != run || s.score <= 0) continue;
    all.push_back({{"leg", s.leg},
                   {"part", s.part},
                   {"score", s.score},
                   {"from", s.first / stride},
                   {"to", (s.last + stride - 1) / stride}});
  }
  return all;
}

}  // namespace

Json tracks_json(const Model& model, const Diagnosis& d) {
  const Fit& twin = d.driven_twin();
  Json runs = Json::array();
  for (std::size_t r = 0; r < model.recording().runs.size(); ++r) {
    const RecordedRun& run = model.recording().runs[r];
    const std::size_t stride = 1 + run.truth.size() / kPoses;
    std::vector<Pose2> recorded;
    for (const TruthSample& t : run.truth) recorded.push_back(t.X_WB);
    const std::vector<Pose2> before = begun_right(model, r, model.nominal().tracks[r]);
    Json item{{"id", run.id},
              {"direction", run.direction},
              {"recorded", thinned(recorded, stride)},
              {"before", thinned(before, stride)},
              {"parts", parts(d, run.id, stride)},
              {"end", {{"before", end_error(run, before)}}}};
    item["time_s"] = Json::array();
    for (std::size_t k = 0; k < run.truth.size(); ++k) {
      if (k % stride == 0 || k + 1 == run.truth.size()) item["time_s"].push_back(rounded(run.truth[k].time_s));
    }
    if (!twin.hypotheses.empty()) {
      const std::vector<Pose2> after = begun_right(model, r, twin.predicted.tracks[r]);
      item["after"] = thinned(after, stride);
      item["end"]["after"] = end_error(run, after);
    }
    runs.push_back(std::move(item));
  }
  return runs;
}

}  // namespace umbsim::gap

#include "experiment/drive/pose_track.h"

#include <algorithm>

#include "experiment/drive/drive_run.h"

namespace umbsim {

TrackKeeper::TrackKeeper(const Scenario& scenario, const RunSpec& spec, const Plan& plan, const Rows& rows)
    : on_(scenario.uncertainty.any()),
      in_memory_(rows.to == Rows::To::memory),
      X_SW_(inverse(Pose2{0, 0, scenario.runs.start_heading_rad})),
      random_(scenario.seed, "absolute fix", std::uint64_t(spec.number)) {
  for (const AbsoluteFix& fix : scenario.fixes) {
    const auto leg = plan.leg_segment(fix.leg);
    if (leg && *leg + 1 < plan.segments().size()) fixes_.push_back({int(*leg) + 1, fix.noise});
  }
  std::stable_sort(fixes_.begin(), fixes_.end(), [](const Fix& a, const Fix& b) { return a.segment < b.segment; });
}

void TrackKeeper::fix_if_due(int segment, const Pose2& X_WB, UncertainReckoning& reckoning) {
  for (; taken_ < fixes_.size() && segment >= fixes_[taken_].segment; ++taken_) {
    const FixNoise& noise = fixes_[taken_].noise;
    const Pose2 X_SB = X_SW_ * X_WB;
    const double x_m = random_.normal(X_SB.x_m, noise.position_sd_m);
    const double y_m = random_.normal(X_SB.y_m, noise.position_sd_m);
    reckoning.fix({x_m, y_m, random_.normal(X_SB.theta_rad, noise.heading_sd_rad)}, noise);
    track.fixes.push_back(noted_);
  }
}

std::optional<UncertainPose> TrackKeeper::note(const Pose2& X_WB, const UncertainReckoning& reckoning) {
  if (!on_) return std::nullopt;
  const TrackSample now{reckoning.estimate(), X_SW_ * X_WB};
  ++noted_;
  track.end = now;
  if (now.estimate.covariance(0, 0) != 0 || now.estimate.covariance(2, 2) != 0) {
    ++track.moved;
    track.moved_inside += inside_95(now.estimate, now.X_SB);
  }
  if (in_memory_) track.samples.push_back(now);
  return now.estimate;
}

UncertaintyFigures uncertainty_figures(const std::vector<const PoseTrack*>& tracks) {
  UncertaintyFigures f;
  double ends = 0, way = 0, poses = 0;
  for (const PoseTrack* track : tracks) {
    if (!track->end) continue;
    ++f.runs;
    f.end_covariance += track->end->estimate.covariance;
    ends += inside_95(track->end->estimate, track->end->X_SB);
    poses += double(track->moved);
    way += double(track->moved_inside);
  }
  if (f.runs == 0) return f;
  f.end_covariance /= f.runs;
  f.end_inside_95_share = ends / f.runs;
  f.way_inside_95_share = poses > 0 ? way / poses : 0;
  return f;
}

}  // namespace umbsim

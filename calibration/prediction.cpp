#include "calibration/prediction.h"

#include <algorithm>
#include <cmath>

namespace umbsim::calibration {
namespace {

double distance_mm(const Pose2& a, const Pose2& b) { return 1000 * std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

}  // namespace

Pose2 best_motion(const RecordedRun& run, const std::vector<Pose2>& track) {
  const double n = double(track.size());
  Pose2 mean_track, mean_truth;
  for (std::size_t k = 0; k < track.size(); ++k) {
    mean_track.x_m += track[k].x_m / n;
    mean_track.y_m += track[k].y_m / n;
    mean_truth.x_m += run.truth[k].X_WB.x_m / n;
    mean_truth.y_m += run.truth[k].X_WB.y_m / n;
  }
  double dot = 0, cross = 0;
  for (std::size_t k = 0; k < track.size(); ++k) {
    const double px = track[k].x_m - mean_track.x_m, py = track[k].y_m - mean_track.y_m;
    const double qx = run.truth[k].X_WB.x_m - mean_truth.x_m, qy = run.truth[k].X_WB.y_m - mean_truth.y_m;
    dot += px * qx + py * qy;
    cross += px * qy - py * qx;
  }
  const Pose2 turn{0, 0, std::atan2(cross, dot)};
  const Pose2 turned = turn * mean_track;
  return {mean_truth.x_m - turned.x_m, mean_truth.y_m - turned.y_m, turn.theta_rad};
}

RunError prediction_error(const RecordedRun& run, const std::vector<Pose2>& predicted) {
  RunError e;
  const Pose2 motion = best_motion(run, predicted);
  e.raw_final_mm = distance_mm(predicted.back(), run.truth.back().X_WB);
  e.final_mm = distance_mm(motion * predicted.back(), run.truth.back().X_WB);
  double squares = 0;
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    squares += std::pow(distance_mm(motion * predicted[k], run.truth[k].X_WB), 2);
  }
  e.along_mm = std::sqrt(squares / double(predicted.size()));
  e.frame_deg = degrees(motion.theta_rad);
  return e;
}

std::vector<Pose2> reckoned_track(const RecordedRun& run, const OdometryParameters& odometry) {
  const std::vector<EncoderSample>& s = run.encoders;
  DeadReckoning reckoning(odometry, run.truth.front().X_WB, s.front().left_ticks, s.front().right_ticks);
  std::vector<Pose2> at_samples{reckoning.pose()};
  for (std::size_t i = 1; i < s.size(); ++i) {
    reckoning.update(s[i].left_ticks, s[i].right_ticks);
    at_samples.push_back(reckoning.pose());
  }
  std::vector<Pose2> track;
  std::size_t i = 0;
  for (const TruthSample& t : run.truth) {
    while (i + 2 < s.size() && s[i + 1].time_s < t.time_s) ++i;
    const double part = std::clamp((t.time_s - s[i].time_s) / (s[i + 1].time_s - s[i].time_s), 0.0, 1.0);
    const Pose2 step = inverse(at_samples[i]) * at_samples[i + 1];
    track.push_back(at_samples[i] * Pose2{part * step.x_m, part * step.y_m, part * step.theta_rad});
  }
  return track;
}

Prediction reckoned(const std::string& name, const Recording& recording, const OdometryParameters& odometry) {
  Prediction p{name, {}};
  for (const RecordedRun& run : recording.runs) p.tracks.push_back(reckoned_track(run, odometry));
  return p;
}

}  // namespace umbsim::calibration

#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "experiment/run.h"
#include "tests/effects/labmate.h"
#include "tests/experiment/scenarios.h"
#include "umbmark/course.h"

namespace umbsim::testing {

/// The nominal LabMate's square with these effects (the YAML of the map `effects:`), 1e6 ticks per revolution.
inline ExperimentResult drive(const std::string& effects, std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(), "effects={" + effects + "}");
  return run_experiment(shipped("nominal", settings), 1);
}

inline const RecordedRun& run_of(const ExperimentResult& r, const std::string& id) {
  for (const RecordedRun& run : r.recording.runs) {
    if (run.id == id) return run;
  }
  throw std::runtime_error("no run " + id);
}

/// Legs and turns of the course, for the times at which they begin and end.
inline std::vector<Segment> segments(const ExperimentResult& r, Direction direction) {
  return Plan(r.scenario.course, direction).segments();
}

/// The absolute pose at the sample next to `time_s`.
inline Pose2 truth_at(const RecordedRun& run, double time_s) {
  const TruthSample* best = &run.truth.front();
  for (const TruthSample& s : run.truth) {
    if (std::abs(s.time_s - time_s) < std::abs(best->time_s - time_s)) best = &s;
  }
  return best->X_WB;
}

/// Where a leg or turn is over and the robot has come to rest: in the dwell after it.
inline double rest_after(const Segment& s, double dwell_s) { return s.start_s + s.duration_s + dwell_s; }

/// Poses as the odometry computes them from the recorded ticks.
inline std::vector<Pose2> calculated(const RecordedRun& run, const OdometryParameters& odometry) {
  DeadReckoning reckoning(odometry, {});
  std::vector<Pose2> poses;
  for (const EncoderSample& s : run.encoders) {
    reckoning.update(s.left_ticks, s.right_ticks);
    poses.push_back(reckoning.pose());
  }
  return poses;
}

/// Absolute minus calculated pose (floor frame) when a segment is over and the robot rests.
inline Pose2 error_after(const ExperimentResult& r, const std::string& id, const Segment& s, double dwell_s) {
  const RecordedRun& run = run_of(r, id);
  const double time_s = std::lround(rest_after(s, dwell_s) * 10) * 0.1;  // of a sample of the track, at 10 Hz
  const Pose2 odometry = calculated(run, r.odometry).at(std::size_t(std::lround(time_s * 50)));
  const Pose2 truth = truth_at(run, time_s);
  return {truth.x_m - odometry.x_m, truth.y_m - odometry.y_m, truth.theta_rad - odometry.theta_rad};
}

inline double wheel_rad(std::int64_t ticks, const OdometryParameters& o) {
  return ticks * 2 * M_PI / o.ticks_per_revolution;
}

inline std::string text(const ReturnError& e) {
  return fmt::format("({:.4f}, {:.4f}) mm, {:.5f} deg", 1000 * e.x_m, 1000 * e.y_m, degrees(e.theta_rad));
}

inline void expect_near(const ReturnError& a, const ReturnError& b, double metres, double radians,
                        const std::string& what) {
  EXPECT_NEAR(a.x_m, b.x_m, metres) << what;
  EXPECT_NEAR(a.y_m, b.y_m, metres) << what;
  EXPECT_NEAR(a.theta_rad, b.theta_rad, radians) << what;
}

/// A robot's mirror image errs to the other side.
inline ReturnError mirrored(const ReturnError& e) { return {e.run, e.x_m, -e.y_m, -e.theta_rad}; }

}  // namespace umbsim::testing

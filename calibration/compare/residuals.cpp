#include "calibration/compare/residuals.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "calibration/methods/squares/squares.h"
#include "calibration/prediction.h"

namespace umbsim::calibration {
namespace {

// Tracked minus reckoned at the chosen moments.
std::vector<Pose2> residuals(const TrainingRun& r, const OdometryParameters& odometry,
                             const std::vector<std::size_t>& moments) {
  const std::vector<Pose2> track = reckoned_track(*r.run, odometry);
  const Pose2 motion = r.tracked() ? best_motion(*r.run, track) : Pose2{};
  std::vector<Pose2> result;
  for (const std::size_t k : moments) {
    const Pose2 reckoned = motion * track[k], &tracked = r.run->truth[k].X_WB;
    result.push_back(
        {tracked.x_m - reckoned.x_m, tracked.y_m - reckoned.y_m, tracked.theta_rad - reckoned.theta_rad});
  }
  return result;
}

std::vector<std::size_t> spread_moments(std::size_t count, std::size_t most) {
  const std::size_t n = std::min(count, most);
  std::vector<std::size_t> moments{0};
  for (std::size_t i = 1; i < n; ++i) moments.push_back(i * (count - 1) / (n - 1));
  return moments;
}

RunResiduals residuals_of(const TrainingRun& r, const std::string& recording, bool test, const Comparison& c,
                          std::size_t most) {
  RunResiduals result{recording, r.run->id, r.run->direction, test, {}, {}, {}, {}, {}};
  const std::vector<std::size_t> moments = spread_moments(r.run->truth.size(), most);
  for (const std::size_t k : moments) {
    result.time_s.push_back(r.run->truth[k].time_s);
    result.tracked.push_back(r.run->truth[k].X_WB);
  }
  result.before = residuals(r, c.nominal, moments);
  result.after = residuals(r, c.results[c.winner].odometry, moments);
  for (const MethodResult& m : c.results) result.final_mm.push_back(run_error(r, m.odometry).final_mm);
  return result;
}

}  // namespace

std::vector<RunResiduals> run_residuals(const Task& task, const Comparison& c, std::size_t most) {
  const Runs train = training_runs(task.train, task.train_names), test = training_runs(task.test, task.test_names);
  std::vector<RunResiduals> all(train.size() + test.size());
  tbb::parallel_for(std::size_t(0), all.size(), [&](std::size_t i) {
    const bool is_test = i >= train.size();
    const TrainingRun& r = is_test ? test[i - train.size()] : train[i];
    const std::vector<std::string>& names = is_test ? task.test_names : task.train_names;
    all[i] = residuals_of(r, names[r.recording_index], is_test, c, most);
  });
  return all;
}

std::vector<SquaresBeforeAfter> squares_before_after(const Task& task, const Comparison& c) {
  const Runs runs = training_runs(task.train, task.train_names);
  std::vector<SquaresBeforeAfter> all;
  for (std::size_t i = 0; i < task.train.size(); ++i) {
    const auto before = squares_of(runs, i, c.nominal), after = squares_of(runs, i, c.results[c.winner].odometry);
    if (before && after) all.push_back({task.train_names[i], task.train[i].path.side_m, *before, *after});
  }
  return all;
}

}  // namespace umbsim::calibration

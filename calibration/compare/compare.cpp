#include "calibration/compare/compare.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <tuple>

#include "calibration/compare/held_out.h"
#include "calibration/methods/squares/squares.h"
#include "calibration/prediction.h"
#include "core/error.h"

namespace umbsim::calibration {
namespace {

constexpr double kLittleWay_m = 1;     // straight, of all runs together: too little for ratio and scale
constexpr double kLittleTurn_rad = 3;  // of all runs together: too little for the wheelbase

void check_one_robot(const Task& task) {
  const double ticks = task.nominal.ticks_per_revolution;
  const auto check = [&](const std::vector<Recording>& recordings, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      const double own = recordings[i].robot.ticks_per_revolution;
      if (std::abs(own / ticks - 1) < 1e-9) continue;
      throw InputError(
          fmt::format("{}: robot.ticks_per_revolution is {:g}, that of {} {:g}: not one robot. Calibrate "
                      "them apart",
                      names[i], own, task.train_names.front(), ticks));
    }
  };
  check(task.train, task.train_names);
  check(task.test, task.test_names);
}

std::vector<std::string> data_warnings(const Task& task, const Runs& runs) {
  std::vector<std::string> warnings;
  double way_m = 0, left_rad = 0, right_rad = 0;
  const OdometryParameters& o = task.nominal;
  for (const TrainingRun& r : runs) {
    const std::vector<EncoderSample>& s = r.run->encoders;
    for (std::size_t i = 1; i < s.size(); ++i) {
      const double left = double(s[i].left_ticks - s[i - 1].left_ticks) * o.left_metres_per_tick();
      const double right = double(s[i].right_ticks - s[i - 1].right_ticks) * o.right_metres_per_tick();
      way_m += std::abs(left + right) / 2;
      (right > left ? left_rad : right_rad) += std::abs(right - left) / o.wheelbase_m;
    }
  }
  if (way_m < kLittleWay_m)
    warnings.push_back(fmt::format("too little way: {:.2f} m in all; radii and their ratio are hardly told", way_m));
  if (left_rad + right_rad < kLittleTurn_rad)
    warnings.push_back(fmt::format("too little turning: {:.0f} deg in all; the wheelbase is hardly told",
                                   degrees(left_rad + right_rad)));
  else if (std::min(left_rad, right_rad) < 0.1 * std::max(left_rad, right_rad))
    warnings.push_back(fmt::format("the runs turn {} only: what differs between left and right turns stays unseen",
                                   left_rad > right_rad ? "left" : "right"));
  for (std::size_t i = 0; i < task.train.size(); ++i) {
    const RecordedRobot& robot = task.train[i].robot;
    const bool alike =
        std::abs(robot.wheelbase_m - o.wheelbase_m) < 1e-9 && std::abs(robot.wheel_radius_m - o.left_radius_m) < 1e-9;
    if (alike) continue;
    warnings.push_back(fmt::format("{} states another radius or wheelbase; {} is taken for nominal",
                                   task.train_names[i], task.train_names.front()));
  }
  return warnings;
}

std::vector<MeanError> errors(const std::vector<Recording>& recordings, const std::vector<std::string>& names,
                              const OdometryParameters& odometry) {
  std::vector<MeanError> means(recordings.size());
  std::vector<double> count(recordings.size(), 0);
  for (const TrainingRun& r : training_runs(recordings, names)) {
    const MeanError e = run_error(r, odometry);
    means[r.recording_index].final_mm += e.final_mm;
    means[r.recording_index].raw_final_mm += e.raw_final_mm;
    ++count[r.recording_index];
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    means[i].final_mm /= std::max(1.0, count[i]);
    means[i].raw_final_mm /= std::max(1.0, count[i]);
  }
  return means;
}

void judge(const Task& task, const Runs& runs, MethodResult& result) {
  result.train = errors(task.train, task.train_names, result.odometry);
  result.test = errors(task.test, task.test_names, result.odometry);
  for (std::size_t i = 0; i < task.train.size(); ++i) {
    const auto squares = squares_of(runs, i, result.odometry);
    if (squares) result.e_max_m = std::max(result.e_max_m.value_or(0), squares->e_max_syst_m);
  }
}

void name_trackers(Fit& fit, const std::vector<std::string>& names) {
  for (TrackerFit& t : fit.trackers) t.recording = names[std::stoul(t.recording)];
}

MethodResult fitted(const Task& task, const Runs& runs, const Method& method) {
  MethodResult result;
  result.method = &method;
  result.name = method.name;
  result.odometry = task.nominal;
  try {
    result.fit = fit_with(method, runs, task.nominal);
    result.odometry = fitted_odometry(task.nominal, *result.fit);
    name_trackers(*result.fit, task.train_names);
  } catch (const NotApplicable& no) {
    result.why_not = no.what();
  }
  return result;
}

}  // namespace

MeanError run_error(const TrainingRun& r, const OdometryParameters& odometry) {
  const std::vector<Pose2> track = reckoned_track(*r.run, odometry);
  const RunError e = prediction_error(*r.run, track);
  return {r.tracked() ? e.final_mm : e.raw_final_mm, e.raw_final_mm};
}

Comparison compare(const Task& task, const std::vector<const Method*>& chosen) {
  check_one_robot(task);
  const Runs runs = training_runs(task.train, task.train_names);
  Comparison c;
  c.nominal = task.nominal;
  c.warnings = data_warnings(task, runs);
  c.results.resize(1 + chosen.size());
  c.results[0].odometry = task.nominal;
  tbb::parallel_for(std::size_t(0), chosen.size(),
                    [&](std::size_t i) { c.results[i + 1] = fitted(task, runs, *chosen[i]); });
  if (chosen.size() == 1 && !c.results[1].fit)
    throw InputError(fmt::format("{}: {} {}", task.train_names.front(), chosen[0]->name, c.results[1].why_not));
  tbb::parallel_for(std::size_t(0), c.results.size(), [&](std::size_t i) { judge(task, runs, c.results[i]); });
  const Folds folds = folds_of(runs);
  c.held_out = folds.said;
  c.folds = int(folds.all.size());
  leave_out(folds, task.nominal, c.results);
  std::tie(c.winner, c.why) = choose(c.results, folds);
  if (chosen.size() == 1) {
    c.winner = 1;
    c.why = "asked for by name; " + c.why;
  }
  c.parts = fit_parts(runs, task.train_names, task.nominal);
  return c;
}

}  // namespace umbsim::calibration

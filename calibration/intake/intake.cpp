#include "calibration/intake/intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "calibration/intake/parts.h"
#include "calibration/intake/refusal.h"
#include "calibration/intake/samples.h"
#include "calibration/intake/thinned.h"
#include "calibration/intake/units.h"
#include "calibration/intake/unwrap.h"

namespace umbsim::intake {
namespace {

constexpr double kUncovered = 0.1;    // of a run's counts, which the truth may miss without a word
constexpr double kFarFromHome = 0.1;  // of a square's way, by which a run may miss its start without a word
constexpr double kOtherClock = 1.5;   // durations that differ so much over one way are in other units
constexpr double kSameWay = 0.3;      // log of how far ways may differ that are thought to be one

// Readings of the encoders per second that are used. What robots do is slower than a few hertz: more readings hardly
// tell more, and take memory and time.
constexpr double kCounts_hz = 100;

// How much of what the wheels turn lies after the truth's end or before its start.
double uncovered(const RecordedRun& run) {
  double all = 0;
  double missed = 0;
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample& a = run.encoders[i - 1];
    const EncoderSample& b = run.encoders[i];
    const double turned =
        std::abs(double(b.left_ticks - a.left_ticks)) + std::abs(double(b.right_ticks - a.right_ticks));
    all += turned;
    if (b.time_s > run.truth.back().time_s || a.time_s < run.truth.front().time_s) missed += turned;
  }
  return all > 0 ? missed / all : 0;
}

double tracked_way_m(const RecordedRun& run) {
  double way = 0;
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    const Pose2& a = run.truth[i - 1].X_WB;
    const Pose2& b = run.truth[i].X_WB;
    way += std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  }
  return way;
}

// Both files must be of the same time: the truth's may not run faster or slower, be of another run's, or of more.
void check_cover(const Recording& recording, const RecordedRun& run, const std::string& directory) {
  const double truth_s = run.truth.back().time_s - run.truth.front().time_s;
  const double counts_s = run.encoders.back().time_s - run.encoders.front().time_s;
  const double factor = truth_s / counts_s;
  if (recording.truth_kind == "track" && (factor < 1 / kOtherClock || factor > kOtherClock)) {
    const double all = counted(run, recording.robot).way_m;
    if (std::abs(std::log(tracked_way_m(run) / all)) < kSameWay) {
      refuse(directory, run,
             fmt::format(
                 "the truth takes {:.6g} s for the way that the wheels make in {:.6g} s: its time_s is {:.4g} times "
                 "what it should be. Both files must be in seconds of one clock.",
                 truth_s, counts_s, factor));
    }
  }
  if (run.truth.back().time_s > run.encoders.back().time_s + 1 ||
      run.truth.front().time_s < run.encoders.front().time_s - 1) {
    refuse(directory, run,
           fmt::format(
               "truth ({:.6g} s to {:.6g} s) and encoders ({:.6g} s to {:.6g} s) do not cover the same time: cut the "
               "longer one, or set both to one clock in seconds.",
               run.truth.front().time_s, run.truth.back().time_s, run.encoders.front().time_s,
               run.encoders.back().time_s));
  }
}

void check_run(const Recording& recording, const RecordedRun& run, const std::string& directory) {
  const RecordedRobot& robot = recording.robot;
  const bool tracked = recording.truth_kind == "track";
  if (run.encoders.size() < 10) refuse(directory, run, "fewer than 10 encoder samples.");
  if (run.truth.size() < 2) refuse(directory, run, "the truth has fewer than two poses.");
  check_times(directory, run, recording.encoder_rate_hz);
  check_cover(recording, run, directory);
  if (!tracked && uncovered(run) > kUncovered) {
    refuse(
        directory, run,
        fmt::format("its end point is of {:.6g} s, when {:.0f} % of the way were still to come: time_s must be that of "
                    "the end, in seconds of the encoders' clock.",
                    run.truth.back().time_s, 100 * uncovered(run)));
  }
  check_counts(directory, run, robot);
  check_truth(directory, run, robot);
  if (tracked) {
    check_scale(directory, run, recording);
    check_places(directory, run, robot, recording.truth_position_sd_m);
  } else {
    check_end_points(directory, run, recording);
  }
  check_commands(directory, run, robot);
  check_path(directory, run, recording);
}

}  // namespace

std::vector<std::string> check_recording(const Recording& recording, const std::string& directory) {
  for (const RecordedRun& run : recording.runs) check_run(recording, run, directory);
  std::vector<std::string> limits;
  std::set<std::string> directions;
  std::map<std::string, int> alike;
  for (const RecordedRun& run : recording.runs) {
    if (const double missed = uncovered(run); missed > kUncovered) {
      limits.push_back(fmt::format("run {}: the truth covers {:.0f} % of the way only; the rest is not judged", run.id,
                                   100 * (1 - missed)));
    }
    if (recording.truth_kind == "endpoints") {
      const Pose2 end = inverse(run.truth.front().X_WB) * run.truth.back().X_WB;
      const double way = counted(run, recording.robot).way_m;
      if (recording.path.shape == "square" && std::hypot(end.x_m, end.y_m) > kFarFromHome * way) {
        limits.push_back(fmt::format("run {}: it ends {:.3g} m from its start after {:.3g} m: are the units right?",
                                     run.id, std::hypot(end.x_m, end.y_m), way));
      }
    }
    directions.insert(run.direction);
    ++alike[fmt::format("{} {} {} {} {}", run.direction, run.linear_speed_mps.value_or(0), run.payload_kg.value_or(0),
                        run.turn.value_or(""), run.start_heading_rad.value_or(0))];
  }
  if (recording.runs.size() == 1) limits.push_back("one run only: nothing can be held out, and noise is guessed");
  if (recording.path.shape == "square" && (directions.count("cw") == 0 || directions.count("ccw") == 0)) {
    limits.push_back("one direction only: unequal wheels and a wrong wheelbase can hide each other");
  }
  if (std::none_of(alike.begin(), alike.end(), [](const auto& a) { return a.second > 1; })) {
    limits.push_back("no run was repeated: the run-to-run noise is guessed, not measured");
  }
  if (recording.truth_kind == "endpoints") {
    limits.push_back("end points only: six numbers for a pair of squares, most effects look like wheelbase or radii");
  }
  return limits;
}

Intake take_in(const std::string& directory) {
  Recording recording = read_recording(directory);
  std::vector<std::string> limits = unwrap_counters(recording);
  for (std::string& limit : check_recording(recording, directory)) limits.push_back(std::move(limit));
  return {thinned_counts(std::move(recording), kCounts_hz), std::move(limits)};
}

}  // namespace umbsim::intake

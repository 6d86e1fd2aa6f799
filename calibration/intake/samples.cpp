#include "calibration/intake/samples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "calibration/intake/parts.h"
#include "calibration/intake/refusal.h"

namespace umbsim::intake {
namespace {

constexpr double kRateFactor = 5;  // rows so much rarer or denser than the rate says have other units
constexpr double kJump = 3;        // times the way that a wheel usually makes in a row
constexpr double kJump_m = 0.01;
constexpr double kGap = 10;  // times the usual time between rows
constexpr double kTruthGap_s = 2;
constexpr double kCountsGap_s = 0.5;
constexpr double kGapWay_m = 0.02;    // what wheels may turn in rows that are missing
constexpr double kTrackJump_m = 0.1;  // beyond the wheels' way, from one pose to the next
constexpr double kTrackJump_mps = 4;  // no push is so quick and over in one step
constexpr double kOutlier_m = 0.05;
constexpr double kTurnJump_rad = 0.5;
constexpr double kOtherAngles = 10;  // times what the wheels turn: those are not radians

// Of `values`, which must not be empty.
double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

template <typename Sample>
std::vector<double> steps_s(const std::vector<Sample>& samples) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(samples[i].time_s - samples[i - 1].time_s);
  return steps;
}

// What the wheels turned from row i - 1 to row i, metres, without signs.
double way_m(const RecordedRun& run, std::size_t i, const RecordedRobot& robot) {
  const EncoderSample& a = run.encoders[i - 1];
  const EncoderSample& b = run.encoders[i];
  return metres_per_tick(robot) *
         std::max(std::abs(double(b.left_ticks - a.left_ticks)), std::abs(double(b.right_ticks - a.right_ticks)));
}

void check_jumps(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot, bool left) {
  const auto ticks = left ? &EncoderSample::left_ticks : &EncoderSample::right_ticks;
  const std::vector<double> dt = steps_s(run.encoders);
  const double usual_s = quantile(dt, 0.5);
  std::vector<double> counts, speeds;
  for (std::size_t i = 0; i < dt.size(); ++i) {
    counts.push_back(std::abs(double(run.encoders[i + 1].*ticks - run.encoders[i].*ticks)));
    speeds.push_back(counts[i] / std::max(dt[i], usual_s));  // rows may come unevenly
  }
  const double usual = quantile(speeds, 0.99);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double before = i > 0 ? counts[i - 1] : 0;
    const double after = i + 1 < counts.size() ? counts[i + 1] : 0;
    const double allowed = kJump * usual * std::max(dt[i], usual_s) + kJump + kJump_m / metres_per_tick(robot);
    if (counts[i] <= allowed || std::max(before, after) > counts[i] / 2) continue;
    const std::int64_t jump = run.encoders[i + 1].*ticks - run.encoders[i].*ticks;
    const bool overflow = std::abs(counts[i] - 65536) < 3000 || std::abs(counts[i] - 4294967296.0) < 1e6;
    refuse(directory, run,
           fmt::format("{} ticks jump by {} between {} s and {} s ({:.2f} m/s; usually below {:.2f} m/s). {}",
                       left ? "left" : "right", jump, run.encoders[i].time_s, run.encoders[i + 1].time_s,
                       metres_per_tick(robot) * speeds[i], metres_per_tick(robot) * usual,
                       overflow ? "A counter overflowed: unwrap it (add or subtract its range from there on)."
                                : "Cut the run there, or repair the counter."));
  }
}

// What the wheels made from one pose to the next, with two rows on either side for a clock that is a little off.
struct Rolled {
  double way_m = 0;
  double turn_rad = 0;  ///< absolute
};

Rolled rolled(const RecordedRun& run, const RecordedRobot& robot, double from_s, double to_s) {
  const auto later = [](const EncoderSample& s, double t) { return s.time_s < t; };
  const auto first = std::lower_bound(run.encoders.begin(), run.encoders.end(), from_s, later);
  const auto last = std::lower_bound(first, run.encoders.end(), to_s, later);
  const std::size_t from = std::size_t(std::max<std::ptrdiff_t>(first - run.encoders.begin() - 2, 1));
  const std::size_t to = std::min(std::size_t(last - run.encoders.begin()) + 2, run.encoders.size() - 1);
  Rolled r;
  for (std::size_t i = from; i <= to; ++i) {
    r.way_m += way_m(run, i, robot);
    const EncoderSample& a = run.encoders[i - 1];
    const EncoderSample& b = run.encoders[i];
    r.turn_rad += metres_per_tick(robot) / robot.wheelbase_m *
                  std::abs(double(b.right_ticks - a.right_ticks - b.left_ticks + a.left_ticks));
  }
  return r;
}

double distance_m(const TruthSample& a, const TruthSample& b) {
  return std::hypot(b.X_WB.x_m - a.X_WB.x_m, b.X_WB.y_m - a.X_WB.y_m);
}

// A pose from which the track comes back at once.
void check_outliers(const std::string& directory, const RecordedRun& run, double position_sd_m) {
  for (std::size_t i = 1; i + 1 < run.truth.size(); ++i) {
    const TruthSample& a = run.truth[i - 1];
    const TruthSample& b = run.truth[i];
    const TruthSample& c = run.truth[i + 1];
    if (c.time_s - a.time_s > 1) continue;
    const double there = std::min(distance_m(a, b), distance_m(b, c));
    if (there < std::max(kOutlier_m, 12 * position_sd_m) || there < 3 * distance_m(a, c)) continue;
    refuse(
        directory, run,
        fmt::format("the truth's pose at {} s lies {:.3g} m beside the track: the tracker was mistaken there. Delete "
                    "the row.",
                    b.time_s, there));
  }
}

// A step of the track between quiet ones.
void check_track_jumps(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot,
                       double position_sd_m) {
  const auto step_m = [&](std::size_t i) {
    return i > 0 && i < run.truth.size() ? distance_m(run.truth[i - 1], run.truth[i]) : 0.0;
  };
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    const TruthSample& a = run.truth[i - 1];
    const TruthSample& b = run.truth[i];
    const double dt = b.time_s - a.time_s;
    const double excess = step_m(i) - rolled(run, robot, a.time_s, b.time_s).way_m;
    if (dt > 1 || excess < std::max({kTrackJump_m, 12 * position_sd_m, kTrackJump_mps * dt})) continue;
    if (std::max(step_m(i - 1), step_m(i + 1)) > step_m(i) / 3) continue;
    refuse(
        directory, run,
        fmt::format("the truth jumps by {:.3g} m between {} s and {} s, the wheels do not: the tracker lost the robot "
                    "or was moved. Cut the run there, or leave it out.",
                    step_m(i), a.time_s, b.time_s));
  }
}

// The same of the heading: not unwrapped, or marks mistaken for each other. Headings in degrees are large at many steps
// in a row.
void check_turn_jumps(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  const auto turned = [&](std::size_t i) {
    return i > 0 && i < run.truth.size() ? run.truth[i].X_WB.theta_rad - run.truth[i - 1].X_WB.theta_rad : 0.0;
  };
  double all = 0;
  double largest = 0;
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    all += std::abs(turned(i));
    largest = std::max(largest, std::abs(turned(i)));
  }
  const double counted = rolled(run, robot, run.truth.front().time_s, run.truth.back().time_s).turn_rad;
  if (all - largest > kOtherAngles * counted) return;
  for (std::size_t i = 2; i + 1 < run.truth.size(); ++i) {
    const TruthSample& a = run.truth[i - 1];
    const TruthSample& b = run.truth[i];
    const double size = std::abs(turned(i));
    if (b.time_s - a.time_s > 1 || size < kTurnJump_rad + 2 * rolled(run, robot, a.time_s, b.time_s).turn_rad) continue;
    if (std::max(std::abs(turned(i - 1)), std::abs(turned(i + 1))) > size / 3) continue;
    refuse(directory, run,
           fmt::format("theta_rad jumps by {:.2f} at {} s, the wheels do not: {}", turned(i), b.time_s,
                       std::abs(size - 2 * M_PI) < 0.5
                           ? "unwrap it."
                           : "the tracker mistook its marks, or the heading is not in radians. Cut the run there, or "
                             "repair it."));
  }
}

}  // namespace

void check_times(const std::string& directory, const RecordedRun& run, double rate_hz) {
  const double usual = quantile(steps_s(run.encoders), 0.5);
  const double factor = usual * rate_hz;
  if (factor < kRateFactor && factor > 1 / kRateFactor) return;
  const auto near = [&](double suspected) { return std::abs(std::log(factor / suspected)) < 0.5; };
  refuse(directory, run,
         fmt::format("a row of encoders.csv every {:.3g} s, where encoders.rate_hz {:.6g} says every {:.3g} s: {}.",
                     usual, rate_hz, 1 / rate_hz,
                     near(1000)                ? "time_s is in milliseconds (divide by 1000)"
                     : near(1e6)               ? "time_s is in microseconds (divide by 1000000)"
                     : near(1e-3)              ? "time_s is too small by 1000 (multiply by 1000)"
                     : near(10) || near(0.1)   ? "time_s or rate_hz is wrong by 10"
                     : near(100) || near(0.01) ? "time_s or rate_hz is wrong by 100"
                                               : "check both"));
}

void check_counts(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  for (const bool left : {true, false}) check_jumps(directory, run, robot, left);
  const std::vector<double> dt = steps_s(run.encoders);
  const double usual = quantile(dt, 0.5);
  for (std::size_t i = 0; i < dt.size(); ++i) {
    if (dt[i] <= kGap * usual || dt[i] <= kCountsGap_s || way_m(run, i + 1, robot) < kGapWay_m) continue;
    refuse(
        directory, run,
        fmt::format("encoders.csv has a gap from {} s to {} s while the wheels turn by {:.3g} m (usually a row every "
                    "{:.3g} s). Split the run there, or leave it out.",
                    run.encoders[i].time_s, run.encoders[i + 1].time_s, way_m(run, i + 1, robot), usual));
  }
}

void check_truth(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  if (run.truth.size() < 10) return;
  const std::vector<double> dt = steps_s(run.truth);
  const double usual = quantile(dt, 0.5);
  const std::size_t worst = std::size_t(std::max_element(dt.begin(), dt.end()) - dt.begin());
  if (dt[worst] > kGap * usual && dt[worst] > kTruthGap_s) {
    refuse(directory, run,
           fmt::format("the truth has a gap from {} s to {} s (usually a pose every {:.3g} s). Split the run there, or "
                       "leave it out.",
                       run.truth[worst].time_s, run.truth[worst + 1].time_s, usual));
  }
  check_turn_jumps(directory, run, robot);
}

void check_places(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot,
                  double position_sd_m) {
  check_outliers(directory, run, position_sd_m);
  check_track_jumps(directory, run, robot, position_sd_m);
}

}  // namespace umbsim::intake

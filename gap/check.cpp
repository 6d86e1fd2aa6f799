#include "gap/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "odometry/dead_reckoning.h"

namespace umbsim::gap {
namespace {

constexpr double kFactor = 1.5;  // a scale this far from a suspected one is not taken for it

// Signed path lengths and rotations of one run, by odometry and by the tracker.
struct Totals {
  double counted_m = 0;
  double tracked_m = 0;
  double straight_product = 0;  // of counted and tracked forward motion
  double counted_turn_rad = 0;  // absolute
  double tracked_turn_rad = 0;
  double turn_product = 0;      // of counted and tracked rotation
};

Totals totals(const RecordedRun& run, const RecordedRobot& robot) {
  Totals t;
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  std::size_t i = 0;
  std::size_t before = 0;
  // Half-second pieces: noise of single poses does not add up.
  for (std::size_t j = 1; j < run.truth.size(); ++j) {
    const TruthSample& a = run.truth[before];
    const TruthSample& b = run.truth[j];
    if (b.time_s - a.time_s < 0.5 && j + 1 < run.truth.size()) continue;
    const std::size_t from = i;
    while (i + 1 < run.encoders.size() && run.encoders[i].time_s < b.time_s) ++i;
    const double left = k * double(run.encoders[i].left_ticks - run.encoders[from].left_ticks);
    const double right = k * double(run.encoders[i].right_ticks - run.encoders[from].right_ticks);
    const Pose2 moved = inverse(a.X_WB) * b.X_WB;
    const double forward = (left + right) / 2;
    const double turned = (right - left) / robot.wheelbase_m;
    t.counted_m += std::abs(forward);
    t.tracked_m += std::hypot(moved.x_m, moved.y_m);
    t.straight_product += forward * moved.x_m;
    t.counted_turn_rad += std::abs(turned);
    t.tracked_turn_rad += std::abs(moved.theta_rad);
    t.turn_product += turned * moved.theta_rad;
    before = j;
  }
  return t;
}

[[noreturn]] void refuse(const std::string& directory, const RecordedRun& run, const std::string& what) {
  throw InputError(fmt::format("{}: run {}: {}", directory, run.id, what));
}

bool near(double ratio, double suspected) { return ratio > suspected / kFactor && ratio < suspected * kFactor; }

void check_jumps(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  for (int w = 0; w < 2; ++w) {
    const auto ticks = w == 0 ? &EncoderSample::left_ticks : &EncoderSample::right_ticks;
    std::vector<double> speeds;
    for (std::size_t i = 1; i < run.encoders.size(); ++i) {
      const double dt = run.encoders[i].time_s - run.encoders[i - 1].time_s;
      speeds.push_back(std::abs(k * double(run.encoders[i].*ticks - run.encoders[i - 1].*ticks)) / dt);
    }
    std::vector<double> sorted = speeds;
    std::sort(sorted.begin(), sorted.end());
    const double usual = sorted[sorted.size() * 99 / 100];
    const std::size_t worst = std::size_t(std::max_element(speeds.begin(), speeds.end()) - speeds.begin());
    if (speeds[worst] > 8 * usual + 2.0) {
      const auto jump = run.encoders[worst + 1].*ticks - run.encoders[worst].*ticks;
      const bool wrap =
          std::abs(std::abs(double(jump)) - 65536) < 3000 || std::abs(std::abs(double(jump)) - 4294967296.0) < 1e6;
      refuse(directory, run,
             fmt::format("{} ticks jump by {} between {} s and {} s ({:.1f} m/s; usually below {:.2f} m/s). {}",
                         w == 0 ? "left" : "right", jump, run.encoders[worst].time_s, run.encoders[worst + 1].time_s,
                         speeds[worst], usual,
                         wrap ? "A counter overflowed: unwrap it (add or subtract its range from there on)."
                              : "Cut the run there, or repair the counter."));
    }
  }
}

void check_gaps(const std::string& directory, const RecordedRun& run) {
  if (run.truth.size() < 10) return;
  std::vector<double> steps;
  for (std::size_t i = 1; i < run.truth.size(); ++i) steps.push_back(run.truth[i].time_s - run.truth[i - 1].time_s);
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  const std::size_t worst = std::size_t(std::max_element(steps.begin(), steps.end()) - steps.begin());
  if (steps[worst] > 10 * usual && steps[worst] > 2) {
    refuse(directory, run,
           fmt::format("the truth has a gap from {} s to {} s (usually a pose every {:.3g} s). Split the run there, or "
                       "leave it out.",
                       run.truth[worst].time_s, run.truth[worst + 1].time_s, usual));
  }
  // A jump between two quiet steps; headings in degrees are large at many steps in a row.
  const auto turned = [&](std::size_t i) {
    return i > 0 && i < run.truth.size() ? run.truth[i].X_WB.theta_rad - run.truth[i - 1].X_WB.theta_rad : 0.0;
  };
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    const bool alone = std::abs(turned(i - 1)) < 1.5 && std::abs(turned(i + 1)) < 1.5;
    if (std::abs(turned(i)) > 3.5 && steps[i - 1] < 1 && alone) {
      refuse(directory, run,
             fmt::format("theta_rad jumps by {:.2f} at {} s: unwrap it, or give it in radians.", turned(i),
                         run.truth[i].time_s));
    }
  }
}

void check_scale(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  const Totals t = totals(run, robot);
  if (t.tracked_m < 0.05 && t.tracked_turn_rad < 0.3 && t.counted_m < 0.05 && t.counted_turn_rad < 0.3) {
    refuse(directory, run, "no motion: neither the wheels nor the tracker moved. Leave the run out.");
  }
  if (t.counted_m < 0.02 && t.counted_turn_rad < 0.1) {
    const double scale = robot.ticks_per_revolution / (2 * M_PI);
    refuse(directory, run,
           fmt::format(
               "the tracker moved {:.3g} m, the encoders hardly at all ({:.3g} m). Counts expected, radians (times "
               "{:.4g}) or revolutions (times {:.6g}) given?",
               t.tracked_m, t.counted_m, scale, robot.ticks_per_revolution));
  }
  if (t.tracked_m < 0.01 && t.tracked_turn_rad < 0.1)
    refuse(directory, run, "no motion in the truth, though the wheels turn.");
  // Path length is taken where there is some; both sides scale alike.
  const double ratio = t.tracked_m / std::max(t.counted_m, 1e-12);
  if (t.counted_m > 0.3 || t.tracked_m > 0.3) {
    const double ticks = robot.ticks_per_revolution;
    const struct {
      double factor;
      std::string meaning;
    } suspects[] = {
        {1000, "the truth is in millimetres (divide x and y by 1000), or wheel_radius_m is 1000 times too small"},
        {100, "the truth is in centimetres (divide by 100), or wheel_radius_m is 100 times too small"},
        {10, "a scale is wrong by 10: check wheel_radius_m, wheel diameter in its place, or ticks_per_revolution"},
        {0.001, "wheel_radius_m is in millimetres (divide by 1000), or the truth in kilometres"},
        {0.01, "wheel_radius_m is in centimetres (divide by 100)"},
        {0.1, "a scale is wrong by 10: check wheel_radius_m and ticks_per_revolution"},
        {ticks / (2 * M_PI), "the encoders' columns hold radians, not counts: multiply by ticks_per_revolution / 2 pi"},
        {0.5, "wheel_radius_m may be the diameter, or ticks_per_revolution half of what it is (quadrature)"},
        {0.25, "ticks_per_revolution is a quarter of what it is (quadrature: 4 counts a line)"},
        {4, "ticks_per_revolution is four times what it is (quadrature)"},
        {2, "wheel_radius_m may be half of what it is, or ticks_per_revolution twice"}};
    if (ratio < 0.67 || ratio > 1.5) {
      std::string guess = "check wheel_radius_m, ticks_per_revolution and the units of the truth";
      double best = std::log(kFactor);
      for (const auto& s : suspects) {
        if (near(ratio, s.factor) && std::abs(std::log(ratio / s.factor)) < best) {
          best = std::abs(std::log(ratio / s.factor));
          guess = s.meaning;
        }
      }
      refuse(directory, run,
             fmt::format("the truth's way is {:.4g} times the wheels' ({:.4g} m against {:.4g} m): {}.", ratio,
                         t.tracked_m, t.counted_m, guess));
    }
  }
  if (t.tracked_turn_rad > 1 || t.counted_turn_rad > 1) {
    const double turns = t.tracked_turn_rad / std::max(t.counted_turn_rad, 1e-12);
    if (near(turns, 180 / M_PI)) refuse(directory, run, "theta_rad is in degrees: multiply by pi / 180.");
    if (near(turns, M_PI / 180)) refuse(directory, run, "theta_rad is too small by 180 / pi.");
    if (turns > 1.6 || turns < 0.6) {
      refuse(
          directory, run,
          fmt::format("the truth turns {:.3g} times as much as the wheels: check wheelbase_m and theta_rad.", turns));
    }
    // Against each other: the signs. Negating both wheels turns both products around, exchanging them only the turns.
    if (t.turn_product < 0 && t.straight_product >= 0) {
      refuse(directory, run,
             "turns have the wrong sign: left_ticks and right_ticks are swapped; exchange the columns (or "
             "theta_rad grows clockwise).");
    }
    if (t.turn_product > 0 && t.straight_product < 0) {
      refuse(directory, run,
             "wheels run backwards though the turns are right: left and right are swapped and both count "
             "backwards; exchange the columns and negate them.");
    }
  }
  if (t.straight_product < 0) {
    refuse(directory, run, "the robot drives forward while the wheels count backwards: negate both ticks columns.");
  }
}

}  // namespace

Recording with_moments_between(Recording recording) {
  if (recording.truth_kind != "endpoints") return recording;
  constexpr double kStep_s = 0.1;
  for (RecordedRun& run : recording.runs) {
    if (run.truth.size() != 2) continue;
    const TruthSample first = run.truth.front();
    const TruthSample last = run.truth.back();
    run.truth = {first};
    for (double t = first.time_s + kStep_s; t < last.time_s - kStep_s / 2; t += kStep_s)
      run.truth.push_back({t, first.X_WB});
    run.truth.push_back(last);
  }
  return recording;
}

std::vector<std::string> check_recording(const Recording& recording, const std::string& directory) {
  for (const RecordedRun& run : recording.runs) {
    if (run.encoders.size() < 10) refuse(directory, run, "fewer than 10 encoder samples.");
    if (run.truth.size() < 2) refuse(directory, run, "the truth has fewer than two poses.");
    if (run.truth.back().time_s > run.encoders.back().time_s + 1 ||
        run.truth.front().time_s < run.encoders.front().time_s - 1) {
      refuse(directory, run, "truth and encoders do not cover the same time.");
    }
    check_jumps(directory, run, recording.robot);
    check_gaps(directory, run);
    // Two end points of a closed path say nothing of its length.
    if (recording.truth_kind == "track") check_scale(directory, run, recording.robot);
  }
  std::vector<std::string> limits;
  std::set<std::string> directions;
  std::map<std::string, int> alike;
  for (const RecordedRun& run : recording.runs) {
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

}  // namespace umbsim::gap

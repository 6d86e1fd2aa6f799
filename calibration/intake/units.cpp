#include "calibration/intake/units.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "calibration/intake/parts.h"
#include "calibration/intake/refusal.h"

namespace umbsim::intake {
namespace {

constexpr double kBetterWiring = 0.25;  // of correlation and scale, by which another wiring must be likelier
constexpr double kOverNoise = 10;       // times a reading's, that a piece moves: noise then lengthens no way
constexpr double kLongest_m = 0.2;      // and is long enough, whatever the header says of its noise,
constexpr double kTurned_rad = 0.3;     // or turns, so that its middle heading is that of its way
constexpr double kCoherent = 0.8;       // share of the way that lies along the truth's own heading

// What a wheel pair and the tracker say of one piece of a run, metres and radians.
struct Piece {
  double left_m = 0;
  double right_m = 0;
  Pose2 tracked;
};

// Whether the tracker saw more of a piece than its noise.
bool seen(const Pose2& moved, const Recording& recording) {
  return std::hypot(moved.x_m, moved.y_m) >= std::min(kLongest_m, kOverNoise * recording.truth_position_sd_m) ||
         std::abs(moved.theta_rad) >= kTurned_rad;
}

std::vector<Piece> pieces_of(const RecordedRun& run, const Recording& recording) {
  std::vector<Piece> pieces;
  const double k = metres_per_tick(recording.robot);
  std::size_t i = 0;
  std::size_t before = 0;
  for (std::size_t j = 1; j < run.truth.size(); ++j) {
    const TruthSample& a = run.truth[before];
    const TruthSample& b = run.truth[j];
    Piece p;
    p.tracked = inverse(a.X_WB) * b.X_WB;
    const bool ends = b.time_s - a.time_s >= kPiece_s && seen(p.tracked, recording);
    if (!ends && j + 1 < run.truth.size()) continue;
    const std::size_t from = i;
    while (i + 1 < run.encoders.size() && run.encoders[i].time_s < b.time_s) ++i;
    p.left_m = k * double(run.encoders[i].left_ticks - run.encoders[from].left_ticks);
    p.right_m = k * double(run.encoders[i].right_ticks - run.encoders[from].right_ticks);
    pieces.push_back(p);
    before = j;
  }
  return pieces;
}

// Of a whole run, without signs.
struct Totals {
  double counted_m = 0;
  double tracked_m = 0;
  double counted_turn_rad = 0;
  double tracked_turn_rad = 0;
  double squares_rad2 = 0, products_rad2 = 0;      ///< of counted turns, and with the tracked ones: these have signs
  double left_m = 0, right_m = 0;                  ///< as counted
  double tracked_left_m = 0, tracked_right_m = 0;  ///< as the tracker says that they must have rolled
};

Totals totals(const std::vector<Piece>& pieces, double wheelbase_m) {
  Totals t;
  for (const Piece& p : pieces) {
    t.counted_m += std::abs(p.left_m + p.right_m) / 2;
    t.tracked_m += std::hypot(p.tracked.x_m, p.tracked.y_m);
    t.counted_turn_rad += std::abs(p.right_m - p.left_m) / wheelbase_m;
    t.tracked_turn_rad += std::abs(p.tracked.theta_rad);
    t.squares_rad2 += std::pow((p.right_m - p.left_m) / wheelbase_m, 2);
    t.products_rad2 += (p.right_m - p.left_m) / wheelbase_m * p.tracked.theta_rad;
    t.left_m += std::abs(p.left_m);
    t.right_m += std::abs(p.right_m);
    t.tracked_left_m += std::abs(p.tracked.x_m - wheelbase_m / 2 * p.tracked.theta_rad);
    t.tracked_right_m += std::abs(p.tracked.x_m + wheelbase_m / 2 * p.tracked.theta_rad);
  }
  return t;
}

// How many times as far as the wheels say the robot turns, by least squares: a robot that slips, and turns where its
// wheels do not, has no other wheelbase.
double times_turned(const Totals& t) {
  return t.counted_turn_rad > kTurn_rad ? t.products_rad2 / t.squares_rad2
                                        : t.tracked_turn_rad / std::max(t.counted_turn_rad, 1e-12);
}

double times_rolled(const Totals& t) { return t.tracked_m / std::max(t.counted_m, 1e-12); }

// Whether another run goes and turns as its wheels say. Units are the same in all runs: then what falls short in one
// slips.
bool another_agrees(const RecordedRun& run, const Recording& recording) {
  return std::any_of(recording.runs.begin(), recording.runs.end(), [&](const RecordedRun& other) {
    if (&other == &run || other.encoders.empty() || other.truth.empty()) return false;
    const Totals t = totals(pieces_of(other, recording), recording.robot.wheelbase_m);
    const double turns = times_turned(t), rolls = times_rolled(t);
    return t.counted_m > kWay_m && rolls > kScaleLow && rolls < kScaleHigh &&
           (t.counted_turn_rad < kTurn_rad || (turns > kTurnLow && turns < kTurnHigh));
  });
}

double wiring_score(const std::vector<Piece>& pieces, const Totals& t, double wheelbase_m, const Wiring& w) {
  Agreement forward, turn;
  for (const Piece& p : pieces) {
    const double left = w.left_from_left * p.left_m + w.left_from_right * p.right_m;
    const double right = w.right_from_left * p.left_m + w.right_from_right * p.right_m;
    forward.add((left + right) / 2, p.tracked.x_m);
    turn.add((right - left) / wheelbase_m, p.tracked.theta_rad);
  }
  double score = 0;
  if (t.tracked_m > kWay_m) score += forward.score();
  if (t.tracked_turn_rad > kTurn_rad) score += turn.score();
  return score;
}

void check_wiring(const std::string& directory, const RecordedRun& run, const std::vector<Piece>& pieces,
                  const Totals& t, double wheelbase_m) {
  const double as_it_is = wiring_score(pieces, t, wheelbase_m, wirings()[0]);
  const Wiring* best = &wirings()[0];
  double best_score = as_it_is + kBetterWiring;
  for (const Wiring& w : wirings()) {
    const double score = wiring_score(pieces, t, wheelbase_m, w);
    if (score > best_score) {
      best = &w;
      best_score = score;
    }
  }
  if (best != &wirings()[0]) refuse(directory, run, fmt::format("{}.", best->meaning));
}

// The way that the truth takes must lie along the heading that it has, forwards or backwards.
void check_mirrored(const std::string& directory, const RecordedRun& run, const std::vector<Piece>& pieces) {
  std::complex<double> along = 0;     // as it should be
  std::complex<double> mirrored = 0;  // if y or theta had the other sign
  double way = 0;
  double turn_product = 0;
  double heading = run.truth.front().X_WB.theta_rad;
  for (const Piece& p : pieces) {
    const std::complex<double> moved(p.tracked.x_m, p.tracked.y_m);
    const double middle = heading + p.tracked.theta_rad / 2;
    const std::complex<double> in_floor = moved * std::polar(1.0, heading);
    const double sign = p.left_m + p.right_m < 0 ? -1 : 1;
    along += sign * in_floor * std::polar(1.0, -middle);
    mirrored += sign * in_floor * std::polar(1.0, middle);
    way += std::abs(moved);
    turn_product += (p.right_m - p.left_m) * p.tracked.theta_rad;
    heading += p.tracked.theta_rad;
  }
  if (way < 2 * kWay_m || std::abs(along) > kCoherent * way) return;
  if (std::abs(mirrored) < kCoherent * way) return;
  const double axis = std::abs(std::remainder(std::arg(mirrored), M_PI));
  refuse(directory, run,
         fmt::format("the truth is mirrored: its heading does not follow the way that x_m and y_m take. {}",
                     turn_product < 0  ? "theta_rad grows clockwise: negate it."
                     : axis > M_PI / 4 ? "x_m and y_m are exchanged: exchange the columns."
                                       : "y_m grows to the right: negate it."));
}

}  // namespace

void check_scale(const std::string& directory, const RecordedRun& run, const Recording& recording) {
  const RecordedRobot& robot = recording.robot;
  const std::vector<Piece> pieces = pieces_of(run, recording);
  const Totals t = totals(pieces, robot.wheelbase_m);
  const bool counted = t.counted_m > 0 || t.counted_turn_rad > 0;
  if (t.tracked_m < 0.05 && t.tracked_turn_rad < 0.3 && t.counted_m < 0.05 && t.counted_turn_rad < 0.3)
    refuse(directory, run, "no motion: neither the wheels nor the tracker moved. Leave the run out.");
  if (!counted) {
    refuse(directory, run,
           fmt::format("the tracker moved {:.3g} m, the encoders hardly at all: they were not read. Leave the run out.",
                       t.tracked_m));
  }
  if (t.tracked_m < 0.01 && t.tracked_turn_rad < 0.1)
    refuse(directory, run,
           "no motion in the truth, though the wheels turn: the tracker saw nothing. Leave the run out.");
  for (const bool left : {true, false}) {
    const double wheel = left ? t.left_m : t.right_m;
    const double other = left ? t.right_m : t.left_m;
    const double must = left ? t.tracked_left_m : t.tracked_right_m;
    const double other_must = left ? t.tracked_right_m : t.tracked_left_m;
    if (must > kWay_m && wheel < kDead * other && wheel / must < 0.05 * other / other_must) {
      refuse(directory, run,
             fmt::format(
                 "the {} wheel hardly counts, though the tracker says that it rolled {:.3g} m: its counter is dead "
                 "or its column is missing.",
                 left ? "left" : "right", must));
    }
  }
  check_mirrored(directory, run, pieces);
  check_wiring(directory, run, pieces, t, robot.wheelbase_m);
  // Path length is taken where there is some; both sides scale alike.
  const double ratio = times_rolled(t);
  if ((t.counted_m > kWay_m || t.tracked_m > kWay_m) &&
      (ratio > kScaleHigh || (ratio < kScaleLow && !another_agrees(run, recording)))) {
    refuse(directory, run,
           fmt::format("the truth's way is {:.4g} times the wheels' ({:.4g} m against {:.4g} m): {}.", ratio,
                       t.tracked_m, t.counted_m, why_lengths_differ(ratio, robot, "the truth's x_m and y_m are")));
  }
  if (t.tracked_turn_rad > kTurn_rad || t.counted_turn_rad > kTurn_rad) {
    const double turns = times_turned(t);
    if (turns > kTurnHigh || (turns < kTurnLow && !another_agrees(run, recording))) {
      refuse(directory, run,
             fmt::format("the truth turns {:.3g} times as much as the wheels: {}.", turns, why_turns_differ(turns)));
    }
  }
}

}  // namespace umbsim::intake

#include "gap/check_units.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "gap/refusal.h"
#include "odometry/dead_reckoning.h"

namespace umbsim::gap {
namespace {

constexpr double kPiece_s = 0.5;    // of a run: noise of single poses does not add up
constexpr double kScaleLow = 0.67;  // of the tracker's way over the wheels'
constexpr double kScaleHigh = 1.5;
constexpr double kTurnLow = 0.6;
constexpr double kTurnHigh = 1.6;
constexpr double kNear = 0.25;          // log of how far a scale may be from one that is suspected
constexpr double kBetterWiring = 0.25;  // of correlation and scale, by which another wiring must be likelier
constexpr double kCoherent = 0.8;       // share of the way that lies along the truth's own heading
constexpr double kWrapped = 3;          // full turns that a heading at the end may lack
constexpr double kFarOff = 5;           // a speed, a side: wrong units, not another robot
constexpr double kWay_m = 0.3;          // below, a run says nothing of lengths
constexpr double kTurn_rad = 1;         // nor of angles
constexpr double kDead = 0.01;          // of what the other wheel counts

// What a wheel pair and the tracker say of one piece of a run, metres and radians.
struct Piece {
  double left_m = 0;
  double right_m = 0;
  Pose2 tracked;
};

double metres_per_tick(const RecordedRobot& robot) {
  return 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
}

std::vector<Piece> pieces_of(const RecordedRun& run, const RecordedRobot& robot) {
  std::vector<Piece> pieces;
  const double k = metres_per_tick(robot);
  std::size_t i = 0;
  std::size_t before = 0;
  for (std::size_t j = 1; j < run.truth.size(); ++j) {
    const TruthSample& a = run.truth[before];
    const TruthSample& b = run.truth[j];
    if (b.time_s - a.time_s < kPiece_s && j + 1 < run.truth.size()) continue;
    Piece p;
    const std::size_t from = i;
    while (i + 1 < run.encoders.size() && run.encoders[i].time_s < b.time_s) ++i;
    p.left_m = k * double(run.encoders[i].left_ticks - run.encoders[from].left_ticks);
    p.right_m = k * double(run.encoders[i].right_ticks - run.encoders[from].right_ticks);
    p.tracked = inverse(a.X_WB) * b.X_WB;
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
    t.left_m += std::abs(p.left_m);
    t.right_m += std::abs(p.right_m);
    t.tracked_left_m += std::abs(p.tracked.x_m - wheelbase_m / 2 * p.tracked.theta_rad);
    t.tracked_right_m += std::abs(p.tracked.x_m + wheelbase_m / 2 * p.tracked.theta_rad);
  }
  return t;
}

// A suspected factor, and what it means.
struct Suspect {
  double factor;
  std::string meaning;
};

std::string likeliest(double ratio, const std::vector<Suspect>& suspects, const std::string& otherwise) {
  const auto off = [&](const Suspect& s) { return std::abs(std::log(ratio / s.factor)); };
  const auto best = std::min_element(suspects.begin(), suspects.end(),
                                     [&](const Suspect& a, const Suspect& b) { return off(a) < off(b); });
  return off(*best) < kNear ? best->meaning : otherwise;
}

// `ratio`: of the way that `whose` lengths say to the wheels'.
std::string why_lengths_differ(double ratio, const RecordedRobot& robot, const std::string& whose) {
  const double ticks = robot.ticks_per_revolution;
  const double tick_m = metres_per_tick(robot);
  return likeliest(
      ratio,
      {{1000, fmt::format("{} in millimetres (divide by 1000), or wheel_radius_m is 1000 times too small, or "
                          "ticks_per_revolution 1000 times too large",
                          whose)},
       {100, fmt::format("{} in centimetres (divide by 100), or wheel_radius_m is 100 times too small", whose)},
       {10, "a scale is wrong by 10: check wheel_radius_m (10 times too small?) and ticks_per_revolution"},
       {0.001, "wheel_radius_m is in millimetres (divide by 1000)"},
       {0.01, "wheel_radius_m is in centimetres (divide by 100)"},
       {0.1, "a scale is wrong by 10: check wheel_radius_m (10 times too large?) and ticks_per_revolution"},
       {ticks / (2 * M_PI), "the encoders' columns hold radians, not counts: multiply by ticks_per_revolution / 2 pi"},
       {ticks / 360, "the encoders' columns hold degrees, not counts: multiply by ticks_per_revolution / 360"},
       {ticks, "the encoders' columns hold revolutions, not counts: multiply by ticks_per_revolution"},
       {0.001 / tick_m,
        "the encoders' columns hold millimetres, not counts: divide by 2 pi 1000 wheel_radius_m / "
        "ticks_per_revolution"},
       {0.5, "wheel_radius_m may be the diameter, or ticks_per_revolution half of what it is (quadrature)"},
       {0.25, "ticks_per_revolution is a quarter of what it is (quadrature: 4 counts a line)"},
       {4, "ticks_per_revolution is four times what it is (quadrature)"},
       {2, "wheel_radius_m may be half of what it is, or ticks_per_revolution twice"}},
      "check wheel_radius_m, ticks_per_revolution and the units of the truth");
}

// `ratio`: of the truth's turns to the wheels', where lengths agree.
std::string why_turns_differ(double ratio) {
  return likeliest(ratio,
                   {{180 / M_PI, "theta_rad is in degrees: multiply by pi / 180"},
                    {M_PI / 180, "theta_rad is too small by 180 / pi"},
                    {1000, "wheelbase_m is in millimetres (divide by 1000)"},
                    {100, "wheelbase_m is in centimetres (divide by 100)"},
                    {10, "wheelbase_m is 10 times too large"},
                    {2, "wheelbase_m is twice what it is, or theta_rad"},
                    {0.5, "wheelbase_m is half of what it is (from the middle to a wheel?), or theta_rad"},
                    {0.1, "wheelbase_m is 10 times too small"},
                    {0.01, "wheelbase_m is 100 times too small"},
                    {0.001, "wheelbase_m is 1000 times too small (given in kilometres?)"}},
                   "check wheelbase_m and theta_rad");
}

// How the two counters may be wired wrongly.
struct Wiring {
  int left_from_left, left_from_right, right_from_left, right_from_right;
  const char* meaning;
};

const Wiring kWirings[] = {
    {1, 0, 0, 1, ""},
    {0, 1, 1, 0,
     "left_ticks and right_ticks are swapped: turns have the wrong sign; exchange the columns (or theta_rad and y_m "
     "grow clockwise)"},
    {-1, 0, 0, -1, "both wheels count backwards: negate both ticks columns"},
    {0, -1, -1, 0, "left and right are swapped and both count backwards: exchange the columns and negate them"},
    {-1, 0, 0, 1, "the left wheel counts backwards: negate left_ticks"},
    {1, 0, 0, -1, "the right wheel counts backwards: negate right_ticks"}};

// Sums of products of what is counted and tracked.
struct Agreement {
  double counted2 = 0, tracked2 = 0, product = 0;
  void add(double counted, double tracked) {
    counted2 += counted * counted;
    tracked2 += tracked * tracked;
    product += counted * tracked;
  }
  /// Correlation, less a tenth of how far (log, at most 3) the scale is from one.
  double score() const {
    if (counted2 == 0 || tracked2 == 0) return 0;
    const double scale = 0.5 * std::abs(std::log(tracked2 / counted2));
    return product / std::sqrt(counted2 * tracked2) - 0.1 * std::min(scale, 3.0);
  }
};

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
  const double as_it_is = wiring_score(pieces, t, wheelbase_m, kWirings[0]);
  const Wiring* best = &kWirings[0];
  double best_score = as_it_is + kBetterWiring;
  for (const Wiring& w : kWirings) {
    const double score = wiring_score(pieces, t, wheelbase_m, w);
    if (score > best_score) {
      best = &w;
      best_score = score;
    }
  }
  if (best != &kWirings[0]) refuse(directory, run, fmt::format("{}.", best->meaning));
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

// What the counters say of a whole run, if they are wired so.
struct Counted {
  double way_m = 0;                ///< without sign
  double turn_rad = 0;             ///< in all
  double left_m = 0, right_m = 0;  ///< without sign
};

Counted counted_ways(const RecordedRun& run, const RecordedRobot& robot, const Wiring& w) {
  Counted c;
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const double l = double(run.encoders[i].left_ticks - run.encoders[i - 1].left_ticks);
    const double r = double(run.encoders[i].right_ticks - run.encoders[i - 1].right_ticks);
    const double left = metres_per_tick(robot) * (w.left_from_left * l + w.left_from_right * r);
    const double right = metres_per_tick(robot) * (w.right_from_left * l + w.right_from_right * r);
    c.way_m += std::abs(left + right) / 2;
    c.turn_rad += (right - left) / robot.wheelbase_m;
    c.left_m += std::abs(left);
    c.right_m += std::abs(right);
  }
  return c;
}

// Without a track a square must do for one: its sides and as many full turns as the end says.
void check_square(const std::string& directory, const RecordedRun& run, const Recording& recording,
                  double tracked_turn_rad) {
  const double laps = std::max(1.0, std::round(std::abs(tracked_turn_rad) / (2 * M_PI)));
  // Headings may be in degrees.
  const double around = laps > 20 ? 1 : laps;
  const double way = 4 * recording.path.side_m * around;
  const double turn = 2 * M_PI * around;
  const bool clockwise = std::abs(tracked_turn_rad) > kTurn_rad ? tracked_turn_rad < 0 : run.direction == "cw";
  const auto off = [&](const Counted& c) {
    return std::abs(std::log(std::max(c.way_m, 1e-9) / way)) +
           std::abs(std::log(std::max(std::abs(c.turn_rad), 1e-9) / turn)) + ((c.turn_rad < 0) == clockwise ? 0 : 0.8);
  };
  const Counted as_it_is = counted_ways(run, recording.robot, kWirings[0]);
  if (std::min(as_it_is.left_m, as_it_is.right_m) < kDead * std::max(as_it_is.left_m, as_it_is.right_m)) {
    refuse(directory, run,
           fmt::format("the {} wheel hardly counts on a square: its counter is dead or its column is missing.",
                       as_it_is.left_m < as_it_is.right_m ? "left" : "right"));
  }
  for (const Wiring& w : kWirings) {
    if (off(as_it_is) > 1 && off(counted_ways(run, recording.robot, w)) < 0.5)
      refuse(directory, run, fmt::format("{}.", w.meaning));
  }
  const double ratio = way / std::max(as_it_is.way_m, 1e-12);
  if (ratio < kScaleLow || ratio > kScaleHigh) {
    refuse(directory, run,
           fmt::format(
               "the square's way is {:.4g} times the wheels' ({:.4g} m against {:.4g} m): {}; or path.side_m is wrong.",
               ratio, way, as_it_is.way_m, why_lengths_differ(ratio, recording.robot, "path.side_m is")));
  }
  const double turns = turn / std::max(std::abs(as_it_is.turn_rad), 1e-12);
  if (turns > kTurnHigh || turns < kTurnLow) {
    refuse(directory, run,
           fmt::format("a square turns {:.3g} times as much as the wheels: {}.", turns, why_turns_differ(turns)));
  }
}

double counted_turn_rad(const RecordedRun& run, const RecordedRobot& robot) {
  const EncoderSample& a = run.encoders.front();
  const EncoderSample& b = run.encoders.back();
  return metres_per_tick(robot) / robot.wheelbase_m *
         double(b.right_ticks - a.right_ticks - b.left_ticks + a.left_ticks);
}

// The larger side of the box that the wheels say they drove through.
double counted_extent_m(const RecordedRun& run, const RecordedRobot& robot) {
  DeadReckoning odometry({robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, robot.ticks_per_revolution},
                         {}, run.encoders.front().left_ticks, run.encoders.front().right_ticks);
  double x[2] = {0, 0}, y[2] = {0, 0};
  for (const EncoderSample& s : run.encoders) {
    odometry.update(s.left_ticks, s.right_ticks);
    x[0] = std::min(x[0], odometry.pose().x_m);
    x[1] = std::max(x[1], odometry.pose().x_m);
    y[0] = std::min(y[0], odometry.pose().y_m);
    y[1] = std::max(y[1], odometry.pose().y_m);
  }
  return std::max(x[1] - x[0], y[1] - y[0]);
}

// Near the fastest that the robot went for a second or more.
double counted_speed_mps(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = metres_per_tick(robot) / 2;
  double fastest = 0;
  std::size_t from = 0;
  for (std::size_t i = 0; i < run.encoders.size(); ++i) {
    const EncoderSample& b = run.encoders[i];
    if (b.time_s - run.encoders[from].time_s < 1) continue;
    while (b.time_s - run.encoders[from + 1].time_s >= 1) ++from;
    const EncoderSample& a = run.encoders[from];
    fastest = std::max(fastest, k * std::abs(double(b.left_ticks + b.right_ticks - a.left_ticks - a.right_ticks)) /
                                    (b.time_s - a.time_s));
  }
  return fastest;
}

}  // namespace

void check_scale(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  const std::vector<Piece> pieces = pieces_of(run, robot);
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
  const double ratio = t.tracked_m / std::max(t.counted_m, 1e-12);
  if ((t.counted_m > kWay_m || t.tracked_m > kWay_m) && (ratio < kScaleLow || ratio > kScaleHigh)) {
    refuse(directory, run,
           fmt::format("the truth's way is {:.4g} times the wheels' ({:.4g} m against {:.4g} m): {}.", ratio,
                       t.tracked_m, t.counted_m, why_lengths_differ(ratio, robot, "the truth's x_m and y_m are")));
  }
  if (t.tracked_turn_rad > kTurn_rad || t.counted_turn_rad > kTurn_rad) {
    const double turns = t.tracked_turn_rad / std::max(t.counted_turn_rad, 1e-12);
    if (turns > kTurnHigh || turns < kTurnLow) {
      refuse(directory, run,
             fmt::format("the truth turns {:.3g} times as much as the wheels: {}.", turns, why_turns_differ(turns)));
    }
  }
}

void check_end_points(const std::string& directory, const RecordedRun& run, const Recording& recording) {
  const RecordedRobot& robot = recording.robot;
  const Pose2 tracked = inverse(run.truth.front().X_WB) * run.truth.back().X_WB;
  const double far = std::hypot(tracked.x_m, tracked.y_m);
  const Counted counted = counted_ways(run, robot, kWirings[0]);
  if (counted.way_m == 0 && counted.turn_rad == 0)
    refuse(directory, run, "no motion: the wheels did not turn. Leave the run out.");
  if (far < 1e-9 && std::abs(tracked.theta_rad) < 1e-9)
    refuse(directory, run,
           "start and end are the same pose to the last digit: the tracker saw nothing. Leave the run out.");
  if (recording.path.shape == "square") check_square(directory, run, recording, tracked.theta_rad);
  const double off = tracked.theta_rad - counted.turn_rad;
  if (std::abs(counted.turn_rad) > kTurn_rad &&
      std::abs(tracked.theta_rad + counted.turn_rad) < 0.1 * std::abs(counted.turn_rad)) {
    refuse(
        directory, run,
        fmt::format("the truth turns by {:.3g} rad, the wheels by {:.3g} rad: left_ticks and right_ticks are swapped; "
                    "exchange the columns (or theta_rad grows clockwise).",
                    tracked.theta_rad, counted.turn_rad));
  }
  const double laps = std::round(off / (2 * M_PI));
  if (laps != 0 && std::abs(laps) <= kWrapped && std::abs(off - 2 * M_PI * laps) < 0.1 * std::abs(counted.turn_rad)) {
    refuse(directory, run,
           fmt::format(
               "the truth turns by {:.3g} rad, the wheels by {:.3g} rad: theta_rad is not unwrapped; add {:g} times "
               "2 pi at the end.",
               tracked.theta_rad, counted.turn_rad, -laps));
  }
  const double turns = std::abs(tracked.theta_rad / counted.turn_rad);
  if (std::abs(counted.turn_rad) > kTurn_rad && (turns > kTurnHigh || turns < kTurnLow)) {
    refuse(directory, run,
           fmt::format("the truth turns {:.3g} times as much as the wheels: {}.", turns, why_turns_differ(turns)));
  }
  if (far > 1.2 * counted.way_m + kWay_m) {
    refuse(directory, run,
           fmt::format(
               "it ends {:.4g} m from its start, by a way of {:.4g} m: the truth is in millimetres or centimetres, or "
               "wheel_radius_m is too small.",
               far, counted.way_m));
  }
}

void check_commands(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  if (!run.has_commands) return;
  Agreement own, difference;
  double left = 0, right = 0;  // commanded angles of this piece
  std::size_t from = 0;
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample& a = run.encoders[from];
    const EncoderSample& b = run.encoders[i];
    const double dt = b.time_s - run.encoders[i - 1].time_s;
    left += dt * run.encoders[i - 1].left_command_radps;
    right += dt * run.encoders[i - 1].right_command_radps;
    if (b.time_s - a.time_s < kPiece_s) continue;
    const double k = 2 * M_PI / robot.ticks_per_revolution;
    const double turned_left = k * double(b.left_ticks - a.left_ticks);
    const double turned_right = k * double(b.right_ticks - a.right_ticks);
    own.add(left, turned_left);
    own.add(right, turned_right);
    // What is alike in both says nothing of which is which.
    difference.add(right - left, turned_right - turned_left);
    left = right = 0;
    from = i;
  }
  if (own.tracked2 == 0) return;
  if (own.counted2 == 0) {
    refuse(directory, run,
           "all commands are zero, though the wheels turn: leave out the columns left_command_radps and "
           "right_command_radps.");
  }
  if (own.product > 0 && difference.product < -0.5 * std::sqrt(difference.counted2 * difference.tracked2) &&
      difference.tracked2 > 0.01 * own.tracked2) {
    refuse(directory, run, "left_command_radps and right_command_radps are swapped: exchange the columns.");
  }
  if (own.product < 0) {
    refuse(directory, run,
           "the commands have the wrong sign: the wheels turn against them. Negate left_command_radps and "
           "right_command_radps.");
  }
  const double gain = std::sqrt(own.tracked2 / own.counted2);
  if (gain > kScaleLow && gain < kScaleHigh) return;
  refuse(
      directory, run,
      fmt::format("the wheels turn {:.4g} times as fast as commanded: {}.", gain,
                  likeliest(gain,
                            {{1 / robot.wheel_radius_m, "the commands are in m/s (divide by wheel_radius_m)"},
                             {0.001 / robot.wheel_radius_m, "the commands are in mm/s (divide by 1000 wheel_radius_m)"},
                             {2 * M_PI / 60, "the commands are in revolutions per minute (multiply by 2 pi / 60)"},
                             {2 * M_PI, "the commands are in revolutions per second (multiply by 2 pi)"},
                             {M_PI / 180, "the commands are in degrees per second (multiply by pi / 180)"},
                             {2 * M_PI / robot.ticks_per_revolution,
                              "the commands are in counts per second (multiply by 2 pi / ticks_per_revolution)"},
                             {10, "the commands are 10 times too small"},
                             {0.1, "the commands are 10 times too large"},
                             {1000, "the commands are 1000 times too small"},
                             {0.001, "the commands are 1000 times too large"}},
                            "left_command_radps and right_command_radps must be in rad/s; leave them out if unknown")));
}

void check_path(const std::string& directory, const RecordedRun& run, const Recording& recording) {
  const RecordedPath& path = recording.path;
  const double turned = counted_turn_rad(run, recording.robot);
  if (path.shape != "free" && run.direction != "free" && std::abs(turned) > 3 &&
      (turned > 0) != (run.direction == "ccw")) {
    refuse(
        directory, run,
        fmt::format("its direction is {}, but the robot turned {} by {:.0f} degrees: set direction: {}.", run.direction,
                    turned > 0 ? "left" : "right", std::abs(turned) * 180 / M_PI, turned > 0 ? "ccw" : "cw"));
  }
  const auto far_off = [](double ratio) { return ratio > kFarOff || ratio < 1 / kFarOff; };
  const auto wrong_by = [](double ratio) {
    return likeliest(ratio,
                     {{10, "10 times too small"},
                      {100, "in other units (multiply by 100)"},
                      {1000, "in other units (multiply by 1000)"},
                      {0.1, "10 times too large"},
                      {0.01, "in centimetres (divide by 100)"},
                      {0.001, "in millimetres (divide by 1000)"}},
                     "not that of this run");
  };
  if (path.shape == "square" && std::abs(turned) > 3) {
    const double side = counted_extent_m(run, recording.robot);
    if (far_off(side / path.side_m)) {
      refuse(directory, run,
             fmt::format("the robot drove a square of {:.3g} m, path.side_m says {:.6g} m: it is {}.", side,
                         path.side_m, wrong_by(side / path.side_m)));
    }
  }
  const std::optional<double> asked = run.linear_speed_mps ? run.linear_speed_mps : path.linear_speed_mps;
  if (!asked) return;
  const double speed = counted_speed_mps(run, recording.robot);
  if (speed > 0 && far_off(speed / *asked)) {
    refuse(directory, run,
           fmt::format(
               "the robot drove at up to {:.3g} m/s, linear_speed_mps says {:.6g} m/s: it is {}, or time_s is not in "
               "seconds.",
               speed, *asked, wrong_by(speed / *asked)));
  }
}

}  // namespace umbsim::gap

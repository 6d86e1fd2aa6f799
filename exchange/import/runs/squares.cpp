#include "exchange/import/runs/squares.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "recording/stretches.h"

namespace umbsim::exchange {
namespace {

constexpr double kCorner_rad = 0.35;  // 20 degrees that a corner may miss 90 by, as the wheels count it
constexpr double kSide = 0.1;         // of the mean, that a leg may be longer or shorter
constexpr double kLeastLeg_m = 0.05;

/// A leg or a turn with all that belongs to it: turns that stutter are one turn.
struct Part {
  bool turn = false;
  double from_s = 0, to_s = 0;
  double length_m = 0, angle_rad = 0;
};

std::vector<Part> parts_of(const std::vector<Stretch>& all) {
  std::vector<Part> parts;
  for (const Stretch& s : all) {
    if (s.kind == Stretch::Kind::still) continue;
    const bool turn = s.kind == Stretch::Kind::turn;
    const bool rest = !turn && std::abs(s.length_m) < kLeastLeg_m;  // a hop at the end of a turn
    if (!parts.empty() && (parts.back().turn == turn || rest)) {
      parts.back().to_s = s.end_s;
      parts.back().length_m += s.length_m;
      parts.back().angle_rad += s.angle_rad;
    } else if (!rest) {
      parts.push_back({turn, s.start_s, s.end_s, s.length_m, s.angle_rad});
    }
  }
  return parts;
}

// Whether leg, turn, leg, turn, ... from `first` on make a square; its mean side then, else 0.
double square_at(const std::vector<Part>& parts, std::size_t first) {
  if (first + 8 > parts.size()) return 0;
  double side = 0;
  for (std::size_t i = 0; i < 8; i += 2) side += parts[first + i].length_m / 4;
  const double sense = parts[first + 1].angle_rad > 0 ? 1 : -1;
  for (std::size_t i = 0; i < 8; ++i) {
    const Part& p = parts[first + i];
    if (p.turn != (i % 2 == 1)) return 0;
    if (p.turn && std::abs(p.angle_rad * sense - M_PI / 2) > kCorner_rad) return 0;
    if (!p.turn && std::abs(p.length_m - side) > kSide * std::abs(side)) return 0;
  }
  return side > kLeastLeg_m ? side : 0;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

// Sides are laid out in whole centimetres; a wheel that is a little too large does not make another square of it.
double rounded_side(double side_m) {
  const double cm = std::round(side_m * 100) / 100;
  return std::abs(cm - side_m) < 0.02 * side_m ? cm : side_m;
}

// The fastest that the wheels say for most of a leg, or turn.
double speed_of(const Part& p) { return (p.turn ? std::abs(p.angle_rad) : p.length_m) / (p.to_s - p.from_s); }

void add_sizes(const std::vector<Part>& legs, const std::vector<Part>& turns, Cut& cut) {
  std::vector<double> sides, speeds, rates;
  for (const Part& p : legs) {
    sides.push_back(p.length_m);
    speeds.push_back(speed_of(p));
  }
  for (const Part& p : turns) rates.push_back(speed_of(p));
  cut.side_m = rounded_side(median(sides));
  cut.linear_speed_mps = std::round(median(speeds) * 1000) / 1000;
  cut.angular_speed_radps = std::round(median(rates) * 1000) / 1000;
}

}  // namespace

Cut squares_in(const RecordedRun& log, const RecordedRobot& robot) {
  Cut cut{"squares", {}, {}, {}, {}, {}};
  const std::vector<Part> parts = parts_of(stretches(log, robot));
  std::vector<Part> legs, turns;
  std::map<std::string, int> count;
  const auto end_of_log = [&] { return log.encoders.back().time_s; };
  double free_from = log.encoders.front().time_s;
  for (std::size_t i = 0; i < parts.size();) {
    if (square_at(parts, i) == 0) {
      cut.left_out.push_back(fmt::format("{:.1f} s to {:.1f} s: {}", parts[i].from_s, parts[i].to_s,
                                         parts[i].turn
                                             ? fmt::format("a turn by {:.0f} degrees", parts[i].angle_rad * 180 / M_PI)
                                             : fmt::format("{:.2f} m", parts[i].length_m)));
      free_from = parts[i].to_s;
      ++i;
      continue;
    }
    const std::string direction = parts[i + 1].angle_rad > 0 ? "ccw" : "cw";
    const double next = i + 8 < parts.size() ? parts[i + 8].from_s : end_of_log() + kRestOfRun_s;
    const double end = parts[i + 7].to_s;
    Piece piece{fmt::format("{}-{}", direction, ++count[direction]),
                direction,
                std::max(free_from, parts[i].from_s - kRestOfRun_s),
                std::min(end + kRestOfRun_s, (end + next) / 2),
                0,
                0};
    piece.to_s = std::min(piece.to_s, end_of_log());
    free_from = piece.to_s;
    cut.pieces.push_back(piece);
    for (std::size_t k = 0; k < 8; ++k) (parts[i + k].turn ? turns : legs).push_back(parts[i + k]);
    i += 8;
  }
  if (!legs.empty()) add_sizes(legs, turns, cut);
  return cut;
}

void add_square_size(const RecordedRun& log, const RecordedRobot& robot, Cut& cut) {
  std::vector<Part> legs, turns;
  for (Piece& piece : cut.pieces) {
    const RecordedRun run = run_of(log, piece);
    if (run.encoders.size() < 2) return;
    const std::vector<Part> parts = parts_of(stretches(run, robot));
    std::size_t at = 0;
    while (at < parts.size() && square_at(parts, at) == 0) ++at;
    if (at >= parts.size()) return;
    if (piece.direction == "free") piece.direction = parts[at + 1].angle_rad > 0 ? "ccw" : "cw";
    for (std::size_t k = 0; k < 8; ++k) (parts[at + k].turn ? turns : legs).push_back(parts[at + k]);
  }
  if (!legs.empty()) add_sizes(legs, turns, cut);
}

}  // namespace umbsim::exchange

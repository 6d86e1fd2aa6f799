#include "exchange/import/runs/cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "exchange/import/runs/runs_file.h"
#include "exchange/import/runs/squares.h"
#include "recording/stretches.h"

namespace umbsim::exchange {
namespace {

constexpr double kLeast_m = 0.1;  // what a wheel turns less is no run

// What the wheels made of a piece.
void measure(const RecordedRun& log, const RecordedRobot& robot, Piece& piece) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  const EncoderSample* before = nullptr;
  for (const EncoderSample& s : log.encoders) {
    if (s.time_s < piece.from_s || s.time_s > piece.to_s) continue;
    if (before) {
      const double left = k * double(s.left_ticks - before->left_ticks);
      const double right = k * double(s.right_ticks - before->right_ticks);
      piece.way_m += std::abs(left + right) / 2;
      piece.turn_rad += (right - left) / robot.wheelbase_m;
    }
    before = &s;
  }
}

bool parts_runs(const Stretch& s, double still_s) {
  return s.kind == Stretch::Kind::still && s.end_s - s.start_s >= still_s;
}

Cut at_standstills(const RecordedRun& log, const RecordedRobot& robot, double still_s) {
  Cut cut{"standstills", {}, {}, {}, {}, {}};
  const std::vector<Stretch> all = stretches(log, robot);
  bool moving = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (parts_runs(all[i], still_s)) {
      if (moving) cut.pieces.back().to_s = std::min(all[i].end_s, all[i].start_s + std::min(kRestOfRun_s, still_s / 2));
      moving = false;
    } else {
      if (!moving) {
        const double rest = i > 0 ? std::min(kRestOfRun_s, still_s / 2) : 0;
        cut.pieces.push_back({"", "free", all[i].start_s - rest, all[i].end_s, 0, 0});
      }
      cut.pieces.back().to_s = all[i].end_s;
      moving = true;
    }
  }
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  std::erase_if(cut.pieces, [&](const Piece& p) {
    double most = 0;
    const EncoderSample* first = nullptr;
    for (const EncoderSample& s : log.encoders) {
      if (s.time_s < p.from_s || s.time_s > p.to_s) continue;
      if (!first) first = &s;
      most = std::max({most, k * std::abs(double(s.left_ticks - first->left_ticks)),
                       k * std::abs(double(s.right_ticks - first->right_ticks))});
    }
    return most < kLeast_m;
  });
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) cut.pieces[i].id = fmt::format("run-{}", i + 1);
  if (cut.pieces.empty()) {
    throw InputError(fmt::format("nothing moves between standstills of {:g} s: the log holds no runs", still_s));
  }
  return cut;
}

Cut whole(const RecordedRun& log) {
  const double from = std::max(log.encoders.front().time_s, log.truth.front().time_s);
  const double to = std::min(log.encoders.back().time_s, log.truth.back().time_s);
  return {"whole", {{"run-1", "free", from, to, 0, 0}}, {}, {}, {}, {}};
}

}  // namespace

Cut cut_of(const RecordedRun& log, const RecordedRobot& robot, const ImportOptions& options) {
  Cut cut;
  if (!options.runs_file.empty()) {
    cut = {"times of " + options.runs_file, read_runs_file(options.runs_file), {}, {}, {}, {}};
    add_square_size(log, robot, cut);
  } else if (options.cut == "standstills") {
    cut = at_standstills(log, robot, options.still_s);
  } else if (options.cut == "none") {
    cut = whole(log);
  } else {
    cut = squares_in(log, robot);
    if (cut.pieces.empty() && options.cut == "squares") {
      throw InputError(
          "no square was found: four legs of one length with turns of 90 degrees, all the same way; give "
          "--runs FILE or another --cut");
    }
    if (cut.pieces.empty()) cut = whole(log);
  }
  if (options.side_m) cut.side_m = options.side_m;
  for (Piece& piece : cut.pieces) {
    measure(log, robot, piece);
    const RecordedRun run = run_of(log, piece);
    if (run.encoders.size() < 2 || run.truth.size() < 2) {
      throw InputError(
          fmt::format("run {} ({:.3f} s to {:.3f} s): the log has no rows of both wheels and truth there (it goes "
                      "from {:.3f} s to {:.3f} s)",
                      piece.id, piece.from_s, piece.to_s, log.encoders.front().time_s, log.encoders.back().time_s));
    }
  }
  return cut;
}

RecordedRun run_of(const RecordedRun& log, const Piece& piece) {
  RecordedRun run;
  run.id = piece.id;
  run.direction = piece.direction;
  run.has_commands = log.has_commands;
  constexpr double kEdge_s = 1e-9;
  for (EncoderSample s : log.encoders) {
    if (s.time_s < piece.from_s - kEdge_s || s.time_s > piece.to_s + kEdge_s) continue;
    s.time_s -= piece.from_s;
    run.encoders.push_back(s);
  }
  for (TruthSample s : log.truth) {
    if (s.time_s < piece.from_s - kEdge_s || s.time_s > piece.to_s + kEdge_s) continue;
    s.time_s -= piece.from_s;
    run.truth.push_back(s);
  }
  if (run.encoders.empty()) return run;
  const auto [time, left, right, left_command, right_command] = run.encoders.front();
  for (EncoderSample& s : run.encoders) {
    s.left_ticks -= left;
    s.right_ticks -= right;
  }
  return run;
}

}  // namespace umbsim::exchange

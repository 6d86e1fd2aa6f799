#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exchange/import/options.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// A standstill that is kept at either end of a run.
constexpr double kRestOfRun_s = 1;

/// A run to be cut from a log.
struct Piece {
  std::string id;
  std::string direction = "free";  ///< cw | ccw | free
  double from_s = 0, to_s = 0;     ///< of the log
  double way_m = 0, turn_rad = 0;  ///< by the wheels
};

/// How a log falls into runs.
struct Cut {
  std::string how;  ///< "squares", "standstills", "times of runs.csv", "whole"
  std::vector<Piece> pieces;
  std::optional<double> side_m;  ///< of squares
  std::optional<double> linear_speed_mps, angular_speed_radps;
  std::vector<std::string> left_out;  ///< what was driven but belongs to no run
};

/// By options.runs_file, else as options.cut says; `auto` takes squares where there are some, else the whole log.
/// Throws InputError: no squares, no standstill, times outside the log, runs that overlap.
Cut cut_of(const RecordedRun& log, const RecordedRobot& robot, const ImportOptions& options);

/// The piece as a run that begins at time 0 with counts of 0.
RecordedRun run_of(const RecordedRun& log, const Piece& piece);

}  // namespace umbsim::exchange

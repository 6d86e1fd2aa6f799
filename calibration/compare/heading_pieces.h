#pragma once

#include <vector>

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// A part of a run: how far both wheels rolled by nominal odometry, and how far the tracker saw the robot turn.
struct HeadingPiece {
  std::size_t run = 0;
  double left_m = 0;
  double right_m = 0;
  double tracked_rad = 0;
};

/// The runs of one recording, cut by what they do.
struct HeadingPieces {
  std::vector<HeadingPiece> whole;   ///< start to end
  std::vector<HeadingPiece> turns;   ///< in place, from the middle of one leg to the middle of the next
  std::vector<HeadingPiece> legs;    ///< the middle part of each leg
  std::vector<HeadingPiece> curves;  ///< parts of curves that are driven rolling
  std::vector<HeadingPiece> first;   ///< start to the middle of the first leg
  std::vector<HeadingPiece> later;   ///< start to middle of each later leg
};

HeadingPieces heading_pieces(const Runs& runs, std::size_t recording, const OdometryParameters& nominal);

}  // namespace umbsim::calibration

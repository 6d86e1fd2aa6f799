#pragma once

#include "exchange/import/runs/cut.h"

namespace umbsim::exchange {

/// The squares in a log: four legs of one length, after each a turn by 90 degrees, all the same way. Pieces are called
/// cw-1, ccw-1, ... in the order in which they were driven.
Cut squares_in(const RecordedRun& log, const RecordedRobot& robot);

/// Side and speeds of the squares that the pieces of a cut hold, where all of them hold one.
void add_square_size(const RecordedRun& log, const RecordedRobot& robot, Cut& cut);

}  // namespace umbsim::exchange

#pragma once

#include <Eigen/Core>
#include <vector>

namespace umbsim::gap {

/// Numbers of a hypothesis at a place or a moment with which its search begins.
using Starts = std::vector<Eigen::VectorXd>;

/// Height and way further along, of a cable that costs a wheel of this radius about `lost_m`.
Starts cable_starts(double lost_m, double wheel_radius_m);

/// Length and place, as seen from the impulse. A few per cent of length decide how far a wheel gets that pulls against
/// the other in a corner. A short lift is felt where it lies under a wheel's track, and the impulse tells its place to
/// some centimetres only. `closely`: where it is most likely.
Starts lift_starts(bool closely);

/// Friction, radius and place, as seen from the impulse. `grips`: friction at which the robot just does not slip; a few
/// per cent of it decide as much as of a length.
Starts patch_starts(double grips, bool closely);

/// Impulse, in proportion to the robot's mass, and delay. Tyres hold until a push is stronger than they are: a little
/// more makes all the difference.
Starts push_starts(double robot_kg);

}  // namespace umbsim::gap

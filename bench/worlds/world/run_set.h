#pragma once

#include <string>
#include <vector>

#include "bench/worlds/drivers/driver.h"
#include "bench/worlds/world/robot.h"
#include "effects/rig.h"
#include "recording/recording.h"

namespace umbsim::worlds {

/// Which runs a world's recording has.
constexpr const char* kRunSets[] = {"plain_2", "plain_5", "recommended", "circles", "eights", "free", "one_way"};

/// A recording before it is driven, and the way of each of its runs.
struct PlannedRuns {
  std::string set;
  Recording recording;  ///< header and runs without data
  std::vector<Way> ways;
};

/// Courses and speeds that suit the robot. Squares are recorded as such; circles, figures of eight and free driving
/// too, as far as the format can say it.
PlannedRuns plan_runs(const std::string& set, const WorldRobot& robot, double rate_hz, RandomStream& random);

/// The sets that are squares.
constexpr const char* kSquareSets[] = {"plain_2", "plain_5", "recommended", "one_way"};

/// The same for a set of squares, with this course; rolling turns have the radius `rolling_radius_m`.
PlannedRuns plan_squares(const std::string& set, const WorldRobot& robot, const Course& course, double rolling_radius_m,
                         double rate_hz);

/// The way of run `number` as the effects' commanded motion asks for it.
Way commanded_way(const PlannedRuns& planned, std::size_t number, const CommandedMotion& motion);

/// Standstill to standstill by the robot's own limits, with dwells.
double duration_s(const Way& way);

}  // namespace umbsim::worlds

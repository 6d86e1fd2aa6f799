#pragma once

#include <array>
#include <string>

#include "bench/speed/tasks.h"

namespace umbsim::bench {

/// What this simulator is timed on by itself.
struct Case {
  enum class Floor { flat, cable, uneven };
  const char* name;
  const char* robot_urdf;
  Floor floor;
};

inline const std::array<Case, 4> kCases{{
    {"flat", UMBSIM_ROBOTS_DIR "/labmate.urdf", Case::Floor::flat},
    {"cable", UMBSIM_ROBOTS_DIR "/labmate.urdf", Case::Floor::cable},
    {"caster", UMBSIM_CASTER_URDF, Case::Floor::flat},
    {"uneven", UMBSIM_ROBOTS_DIR "/labmate.urdf", Case::Floor::uneven},
}};

inline Setup setup(const Case& c, const RobotModel& robot, double step_s, double fine_step_s) {
  Setup s = c.floor == Case::Floor::cable    ? with_cable(robot, step_s)
            : c.floor == Case::Floor::uneven ? uneven(robot, step_s)
                                             : flat(robot, step_s);
  s.fine_step_s = fine_step_s;
  return s;
}

inline Outcome drive(const Case& c, Engine& engine, const RobotModel& robot, double side_m = 4) {
  return c.floor == Case::Floor::cable ? cross_cable(engine, robot) : drive_square(engine, robot, side_m);
}

}  // namespace umbsim::bench

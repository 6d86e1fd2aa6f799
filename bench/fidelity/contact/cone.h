#pragma once

#include <string>
#include <vector>

#include "bench/fidelity/robots.h"

namespace umbsim::fidelity {

/// All supports with the same friction, both wheels braked: against "straight downhill with g (sin a - mu cos a)".
struct DownhillSlide {
  double heading_rad = 0;
  double direction_error_rad = 0;
  double turned_rad = 0;
  double acceleration_ratio = 0;  ///< measured over closed form
};
DownhillSlide slide_downhill(const RobotModel& robot, double heading_rad, const PhysicsOptions& options);

/// Frictionless ball, both wheels braked, heading straight down (sense +1) or up (-1): acceleration over closed form.
double ball_share_ratio(const RobotModel& robot, int sense, const PhysicsOptions& options);

/// Distance and turn between the ends of two slides.
struct EndError {
  double off_m = 0;
  double off_rad = 0;
};

/// World against the independent integrator (plane_dynamics.h) after 0.7 s from rest.
struct TurningSlide {
  double heading_rad = 0;
  double path_m = 0;            ///< distance of the end from the start
  double turned_rad = 0;
  EndError default_step;
  EndError fine_step;           ///< 1 ms
  EndError extrapolated;        ///< to step zero, from 1 and 2 ms
  double least_load_n = 0;      ///< of the integrator: it takes all contacts as closed
};
TurningSlide slide_and_turn(const RobotModel& robot, bool left_free, double heading_rad);

std::vector<double> slide_headings(Grid grid);
std::string cone_chapter(Grid grid);

}  // namespace umbsim::fidelity

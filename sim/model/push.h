#pragma once

namespace umbsim {

/// A horizontal push against the robot's body, given as its impulse.
struct Push {
  double time_s = 0;        ///< since the start of the run
  double duration_s = 0.1;  ///< > 0; the force is constant over it
  double impulse_ns = 0;
  double direction_rad = 0;  ///< robot frame; 0 forward, pi/2 from the right to the left
  double ahead_m = 0;        ///< where it acts: ahead of the axle's middle
  double height_m = 0;       ///< above the axle
};

/// What pulls at the robot's body from outside: a horizontal force through a point of the body, and a torque about the
/// floor's normal. Directions in the floor frame, the point in the base frame.
struct Pull {
  double force_x_n = 0;
  double force_y_n = 0;
  double ahead_m = 0;  ///< of the axle's middle
  double left_m = 0;
  double height_m = 0;  ///< above the axle
  double yaw_nm = 0;    ///< counter-clockwise
};

}  // namespace umbsim

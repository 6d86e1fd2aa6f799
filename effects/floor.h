#pragma once

#include <string>

#include "effects/rig.h"

namespace umbsim {

/// Friction of the whole floor.
struct SlipperyFloor {
  double friction = 0;  ///< 0: the scenario's
};
void apply(const SlipperyFloor& effect, Rig& rig);

/// Friction inside a disc, an oil patch.
struct SlipperyPatch {
  double x_m = 0;
  double y_m = 0;
  double radius_m = 0;
  double friction = 0.1;
};
void apply(const SlipperyPatch& effect, Rig& rig);

/// A cable on the floor, in every run.
struct Bump {
  double height_m = 0;
  double x_m = 0;
  double y_m = 0;
  double direction_rad = 1.5707963267948966;
  double length_m = 0.1;
};
void apply(const Bump& effect, Rig& rig);

/// A smooth random height field, the same in every run.
struct UnevenFloor {
  double rms_m = 0;
  double wavelength_m = 0.3;
  double seed = 1;
};
void apply(const UnevenFloor& effect, Rig& rig);

/// The floor is tilted against gravity.
struct FloorSlope {
  double slope_rad = 0;
  double downhill_rad = 0;
};
void apply(const FloorSlope& effect, Rig& rig);

/// A carpet's pile carries rolling wheels sideways.
struct CarpetDrift {
  double metres_per_metre = 0;
  double direction_rad = 0;
};
void apply(const CarpetDrift& effect, Rig& rig);

/// Someone pushes the robot.
struct PushEffect {
  std::string run;  ///< id of the run; empty: all
  double leg = 1;
  double seconds_into_leg = 0;
  double impulse_newton_seconds = 0;
  double direction_rad = 1.5707963267948966;  ///< robot frame; pi/2: to the left
  double ahead_m = 0.2;
  double duration_s = 0.1;
};
void apply(const PushEffect& effect, Rig& rig);

/// A stretch of floor where a wheel's load is carried by something that gives no traction.
struct WheelLift {
  double x_m = 0;
  double y_m = 0;
  double length_m = 0;
};
void apply(const WheelLift& effect, Rig& rig);

}  // namespace umbsim

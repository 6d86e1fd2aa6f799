#pragma once

#include "effects/rig.h"

namespace umbsim {

/// Both radii are 1 + relative times the nominal ones.
struct WheelRadiusScale {
  double relative = 0;
};
void apply(const WheelRadiusScale& effect, Rig& rig);

/// Right radius over left radius is 1 + relative; the mean radius stays.
struct WheelRadiusDifference {
  double relative = 0;
};
void apply(const WheelRadiusDifference& effect, Rig& rig);

/// The wheels stand 1 + relative times the nominal wheelbase apart.
struct Wheelbase {
  double relative = 0;
};
void apply(const Wheelbase& effect, Rig& rig);

/// Toe: each wheel's plane is turned about the vertical, counter-clockwise positive.
struct WheelMisalignment {
  double left_toe_rad = 0;
  double right_toe_rad = 0;
};
void apply(const WheelMisalignment& effect, Rig& rig);

/// The rim's centre is off the axle; phase 0: it points forward at the start of a run.
struct WheelEccentricity {
  double left_m = 0;
  double right_m = 0;
  double left_phase_rad = 0;
  double right_phase_rad = 0;
};
void apply(const WheelEccentricity& effect, Rig& rig);

/// A payload that is a point mass on the base, at a place seen from the axle's middle.
struct LoadShift {
  double payload_kg = 0;
  double ahead_m = 0;
  double left_m = 0;
  double height_m = 0.1;
};
void apply(const LoadShift& effect, Rig& rig);

/// Radii change from run to run: run number n (from 0) has 1 + n times the rate.
struct Wear {
  double left_relative_per_run = 0;
  double right_relative_per_run = 0;
};
void apply(const Wear& effect, Rig& rig);

}  // namespace umbsim

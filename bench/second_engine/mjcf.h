#pragma once

#include <string>

#include "bench/second_engine/engine_options.h"
#include "effects/rig.h"

namespace umbsim::second_engine {

/// The rig as a MuJoCo model. Wheels 0 and 1: bodies "wheel<i>" with geoms "tyre<i>"; joints "motor<i>" carry motor and
/// encoder, behind a play also "play<i>". Where the floor is uneven, support k (wheels, then casters) has a plane
/// "floor<k>" of its own on a mocap body, to be laid tangent to the floor under it.
std::string model_xml(const Rig& rig, const EngineOptions& options, double start_heading_rad);

/// Friction numbers of a wheel's contact: along and across, torsion, rolling.
struct TyreFriction {
  double sliding = 0;
  double torsion_m = 0;
};
TyreFriction tyre_friction(const Wheel& wheel, double friction);

}  // namespace umbsim::second_engine

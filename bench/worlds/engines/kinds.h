#pragma once

#include "bench/worlds/engines/engine.h"

namespace umbsim::worlds {

/// This simulator (sim/world.h).
EngineKind our_engine();
/// A vehicle model of the plane (planar/robot.h).
EngineKind planar_engine();
/// Bullet's own multibody world (bullet/robot.h).
EngineKind bullet_engine();

#ifdef UMBSIM_WORLDS_MUJOCO
/// MuJoCo (mujoco/robot.h).
EngineKind mujoco_engine();
#endif

}  // namespace umbsim::worlds

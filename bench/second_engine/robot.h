#pragma once

#include <array>
#include <memory>

#include "bench/second_engine/engine_options.h"
#include "core/pose2.h"
#include "core/random.h"
#include "effects/rig.h"

namespace umbsim::second_engine {

/// A rig in MuJoCo. Every effect is physics there: shapes, masses, joints, friction, gravity, forces on the body.
class Robot {
 public:
  /// `heading_walk`: random walk of the heading in radians per square root of a metre rolled. Stands at the origin,
  /// settled. Throws RunError if MuJoCo refuses the model.
  Robot(const Rig& rig, const EngineOptions& options, double start_heading_rad, double heading_walk,
        RandomStream random);
  ~Robot();
  Robot(Robot&&) noexcept;

  /// Time 0 of the pushes of this leg.
  void begin_leg(int leg);
  /// One control period with these wheel speeds. Throws RunError if the state becomes non-finite.
  void advance(double left_radps, double right_radps, double period_s);

  /// Of the axle's middle, heading unwrapped.
  Pose2 pose() const;
  /// Radians since the start, where the encoder sits.
  double encoder_angle(int wheel) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace umbsim::second_engine

#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/pose2.h"
#include "effects/catalogue.h"
#include "recording/command_features.h"

namespace umbsim::gap {

/// Absolute poses of one recorded run at its truth's times, driven again from its ticks under `effects`, the mean of a
/// floor with grains of this roughness (as Replay::poses; 0: smooth) and of its mirror image.
using ReplayTicks = std::function<std::vector<Pose2>(std::size_t run, const std::vector<Effect>& effects,
                                                     double roughness_m_per_sqrt_m)>;

/// Shaft angles (left, right), radians, at the encoder samples of one run driven from its commands under `effects`.
using ReplayCommands =
    std::function<std::vector<std::array<double, 2>>(std::size_t run, const std::vector<Effect>& effects)>;

/// How the simulator reaches the diagnosis. Both must be safe to call from several threads.
struct Simulator {
  ReplayTicks ticks;
  ReplayCommands commands;
  std::function<CommandFeatures(const std::vector<Effect>&)>
      command_features;  ///< as recording/command_features.h, under effects
  /// Whether wheels scrub under effects, so that the floor's roughness moves their mean path; none: never.
  std::function<bool(const std::vector<Effect>&)> scrubs = {};
  double wheel_width_m = 0;  ///< of the drive wheels, as the robot's description says; 0: not known
  double mass_kg = 0;        ///< of the robot, to which pushes are in proportion
};

}  // namespace umbsim::gap

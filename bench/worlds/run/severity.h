#pragma once

#include "bench/worlds/run/world_run.h"
#include "gap/trial/draw/severity.h"

namespace umbsim::worlds {

/// Severities in one world, in noise floors, as in a trial (docs/trial.md): in the signal in which an effect shows
/// more.
class WorldScale {
 public:
  /// Drives the world's runs with nothing wrong, without noise and, in `guide`, with noise. Throws as drive_world does.
  WorldScale(const World& world, const World& guide, std::uint64_t seed);

  struct Seen {
    double severity = 0;
    Signal signal = Signal::odometry;
  };
  /// Infinite if the robot cannot be driven so.
  Seen severity(const Faults& faults) const;
  /// What they change in one signal. Throws as drive_world does.
  SignalTrack change(const Faults& faults, Signal signal) const;
  /// Sizes of the noise, by signal.
  const SignalSize& noise(Signal signal) const { return noise_[std::size_t(signal)]; }
  /// How far the world itself is from what its counts say, in noise floors.
  double of_the_world() const { return of_the_world_; }
  const DrivenWorld& nominal() const { return nominal_run_; }

 private:
  Drive clean() const;

  const World& world_;
  std::uint64_t seed_;
  DrivenWorld nominal_run_;
  std::array<SignalTrack, 2> nominal_;
  std::array<SignalSize, 2> noise_{};
  double of_the_world_ = 0;
};

/// The same world in this simulator with the defaults: quick, and a good guide to how strong an effect must be.
World guide_of(const World& world);

}  // namespace umbsim::worlds

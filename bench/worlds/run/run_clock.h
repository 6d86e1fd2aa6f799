#pragma once

#include <array>
#include <vector>

#include "bench/worlds/world/world.h"

namespace umbsim::worlds {

/// Advances an engine in slices. Between two slices: what acts from outside, rough tyres, pushes; and the true pose is
/// noted.
class RunClock {
 public:
  RunClock(Engine& engine, const Rig& rig, const std::vector<OutsideEffect>& outside, double roughness_m_per_sqrt_m,
           std::uint64_t seed, std::size_t number);

  /// One control period. `jump`: set-points are there at once, else they ramp over the period.
  void advance(const WheelSpeeds& command, double period_s, bool jump);
  /// Time 0 of the pushes of this leg.
  void begin_leg(int leg, const std::vector<LegPush>& pushes);
  /// Radians that the encoders have seen: effects may make some count more or less than once.
  const std::array<double, 2>& shaft_rad() const { return shaft_rad_; }
  const std::vector<TruthSample>& truth() const { return truth_; }

 private:
  void slice(const WheelSpeeds& command, double slice_s);
  Acts acts(const Moment& now);
  Pull pushed(double slice_s) const;
  double rough(std::size_t wheel, double planned_m);

  struct Grain {
    RandomStream random;
    double left_m = 0;
    double factor = 1;
  };

  Engine& engine_;
  const Rig& rig_;
  std::vector<OutsideEffect> outside_;
  std::vector<Memory> memories_;
  double roughness_;
  std::array<Grain, 2> grains_;
  double weight_n_;
  std::vector<Push> pushes_;
  double time_s_ = 0;
  std::array<double, 2> wheel_rad_{};
  std::array<double, 2> wheel_radps_{};
  std::array<double, 2> encoder_rad_{};
  std::array<double, 2> shaft_rad_{};
  std::array<double, 2> rolling_{1, 1};
  std::array<double, 2> drift_;
  WheelSpeeds last_;
  bool pulled_ = false;
  std::vector<TruthSample> truth_;
};

/// Control periods that the recorder of a run waits, whatever the robot does.
int recorded_periods(const World& world, std::size_t number);

}  // namespace umbsim::worlds

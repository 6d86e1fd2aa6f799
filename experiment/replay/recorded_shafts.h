#pragma once

#include <array>
#include <vector>

#include "odometry/encoder.h"
#include "recording/recording.h"

namespace umbsim {

/// How a run's wheels follow their commands: first order plus dead time.
struct CommandLag {
  double dead_s = 0;  ///< nothing happens: set-points that jump, a bus
  double slow_s = 0;  ///< time constant
  double all_s() const { return dead_s + slow_s; }
};

/// All of it is how late the counts are (recording/counts_behind.h), and how much of that is dead what leaves the least
/// of the counts; none without commands. `steps`: time steps of the simulator per sample.
CommandLag measured_lag(const RecordedRun& run, const RecordedRobot& robot, int steps);

/// Speeds (rad/s) of a shaft at the encoder samples, from what arrived of its rotation through an encoder that reads
/// late, latches, and misses counts (put back in the mean). Commands, where there are some, give the fine structure
/// (`lag` late), counts the drift; otherwise the counts are smoothed. `count_step`: of counts coarser than they seem
/// (recording/coarse_counts.h), 1 otherwise; beside commands counts bound the angle by half of it.
std::vector<double> shaft_speeds(const RecordedRun& run, const EncoderSpec& spec, const EncoderFaults& faults,
                                 bool left, const CommandLag& lag, int steps, double count_step);

/// Angles (rad) that a shaft has turned by at each sample, at speeds (rad/s) that ramp from one sample to the next in
/// `steps` time steps.
std::vector<double> turned_by(const std::vector<EncoderSample>& samples, const std::vector<double>& radps, int steps);

/// What such an encoder makes of shaft angles (left, right; radians) at its samples. `step_rad`: to which it rounds; 0:
/// not at all.
std::vector<std::array<double, 2>> arrived(const std::vector<std::array<double, 2>>& shaft,
                                           const std::vector<EncoderSample>& s, const EncoderSpec& spec,
                                           double step_rad);

}  // namespace umbsim

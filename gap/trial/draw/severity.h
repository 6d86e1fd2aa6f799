#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gap/trial/draw/effect_draws.h"
#include "gap/trial/draw/platform.h"

namespace umbsim {

/// What the simulator is asked to drive. All of it is known to the generator only.
struct TrialDrive {
  TrialRobot robot;
  Recording planned;            ///< header and runs without data
  std::vector<Effect> effects;
  double heading_walk_rad_per_sqrt_m = 0;
  double radius_scatter = 0;
  double motor_scatter = 0;
  std::uint64_t seed = 1;
};

/// Fills in the runs of `planned`. Supplied by the program, so that gap/ does not depend on the simulator. Throws
/// RunError where a robot cannot be driven so.
using TrialSimulator = std::function<Recording(const TrialDrive& drive)>;

/// What a diagnosis can look at: how far two records of the same motion lie apart.
enum class Signal {
  odometry,  ///< the absolute pose against the integrated ticks
  motors,    ///< the integrated ticks against the integrated commands
};
const char* name(Signal signal);

/// Differences of a signal in x, y (m) and heading (rad) at moments spread evenly over each run, in the frame of the
/// run's start; by run.
using SignalTrack = std::vector<std::vector<std::array<double, 3>>>;
SignalTrack signal_track(const Recording& recording, Signal signal);

/// Root mean squares in x, y and heading over all runs and moments, at two scales: of the differences themselves, where
/// what adds up along the way stands out, and of their steps from one moment to the next, where what comes and goes
/// stands out.
struct SignalSize {
  std::array<double, 3> whole{};
  std::array<double, 3> steps{};
};

/// Of a - b; without b: of a.
SignalSize signal_size(const SignalTrack& a, const SignalTrack* b);

/// max over both scales of sqrt(mean over x, y, heading of mean(change^2) / mean(noise^2)).
double severity(const SignalSize& change, const SignalSize& noise);

/// Severities on one platform with one set of runs. An effect's severity is
///   s = max over both scales of sqrt( mean over x, y, heading of  mean(change^2) / mean(noise^2) ),
/// inner means over all runs and moments. The change is the signal of a drive with the effect minus that of a drive
/// without, both without noise and with the same random numbers; the noise is the signal of noisy drives of the nominal
/// robot minus that of the drive without noise. Where a diagnosis has only start and end, there is one moment, the end.
class SeverityScale {
 public:
  /// Drives the nominal robot, without noise and with the trial's at level 1.
  SeverityScale(const TrialPlan& plan, const Platform& platform, Recording planned, const TrialSimulator& simulator);

  /// Infinite if the robot cannot be driven so.
  double severity(const Effect& effect, Signal signal) const;
  const SignalSize& noise(Signal signal) const { return noise_[std::size_t(signal)]; }

 private:
  TrialDrive drive_;
  const TrialSimulator& simulator_;
  std::array<SignalTrack, 2> nominal_;
  std::array<SignalSize, 2> noise_{};
};

/// Below this an effect cannot be expected to show: half the noise floor.
constexpr double kLeastSeverity = 0.5;

/// An effect at its drawn strength.
struct ScaledEffect {
  Effect effect;
  double drawn = 0;     ///< severity that was drawn
  double severity = 0;  ///< severity that it has
  Signal signal = Signal::odometry;
  bool undetectable = false;  ///< no strength up to the plausible maximum reaches kLeastSeverity
};

/// Finds the amplitude with the drawn severity (root of log severity over log amplitude), in units of the noise floor
/// at `noise_level`, in the first signal in which the plausible maximum reaches the end of `drawn_from`, else in the
/// one in which it reaches farthest; then the drawn severity's place in `drawn_from` becomes the same place in the
/// range up to there. Where it reaches less than kLeastSeverity, the amplitude is drawn log-uniformly from the
/// plausible range and the effect counts as undetectable.
ScaledEffect scale_effect(const DrawnEffect& drawn, double severity, const Range& drawn_from, double noise_level,
                          const SeverityScale& scale, RandomStream& random);

}  // namespace umbsim

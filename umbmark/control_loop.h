#pragma once

#include <optional>

namespace umbsim {

/// Gains of the driver's pose correction, per second. Across the path the error obeys y'' + heading y' + across^2 y = 0
/// at any speed above slow_mps: critically damped.
struct DriverGains {
  double along = 4;
  double heading = 6;
  double across = 3;
  double slow_mps = 0.1;
};
inline constexpr DriverGains kDriver;

/// The driver's gain from an error across the path to turning, rad/s per m.
double across_gain(double speed_mps);

/// What passes between an error of the pose and its correction.
struct LoopTiming {
  double period_s = 0.02;  ///< of the control loop
  double sampling_s = 0;   ///< the counters are latched this often; 0: every period
  double latency_s = 0;    ///< a reading is this old when it arrives
  double lag_s = 0;        ///< time constant of the motors
  double droop_s = 0;      ///< the same of motors that give way under the robot's inertia
  double step_s = 0.02;    ///< of the motors' set-points on their ramp over a period, at most
};

/// Whether the driver's corrections die out at this speed. Beyond the limit every correction comes so late that it adds
/// to the error that it is to remove. Without sampling and lag this is where a dead time of latency_s + period_s / 2
/// takes the phase margin of (heading s + across^2) / s^2; with sampling alone where heading * sampling_s = 2.
bool settles(const LoopTiming& timing, double speed_mps);

/// The furthest value of one of the timing's members with which the loop settles, the others as they are, to 1e-6 of
/// it; none where it does not even settle at `good`.
std::optional<double> limit(LoopTiming timing, double LoopTiming::*member, double good, double speed_mps);

/// The most that the driver accelerates while its course speeds up evenly from rest for `ramp_s`, as a multiple of what
/// the course asks for. Motors follow half a period late, and the driver corrects what is missing. `gain`: of the
/// correction, along the path or of the heading.
double overshoot(const LoopTiming& timing, double gain, double ramp_s);

}  // namespace umbsim

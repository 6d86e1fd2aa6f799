#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/random.h"
#include "umbmark/course.h"

namespace umbsim::worlds {

/// The way of a run: legs and turns, each from standstill to standstill, and the speeds that are allowed.
struct Way {
  Course limits;  ///< speeds, accelerations, dwell; shapes count, not its side
  std::vector<Segment> segments;
};

/// Who drives, and what he sees.
constexpr const char* kDriverKinds[] = {"own", "heading", "pursuit", "jumps", "s_curve", "joystick"};

struct DriverChoice {
  std::string kind = "own";
  double rate_hz = 50;            ///< of control
  bool open_loop = false;         ///< what he sees are his own commands, added up
  double heading_gain_1ps = 1.5;  ///< heading, joystick
  double across_gain_radpms = 1;  ///< the same
  double look_ahead_m = 0.4;      ///< pursuit
  double dead_time_s = 0.25;      ///< joystick: between what the eye sees and what the hand does
  double tremor_radps = 0.03;     ///< joystick: standard deviation of the hand's error in turning
  bool jumps = false;             ///< set-points jump at the start of a period, whatever the kind
};

DriverChoice draw_driver(const std::string& kind, RandomStream& random);

/// What a driver may look at, in the frame of the run's start.
struct Seen {
  Pose2 X_SB_odometry;
  Pose2 X_SB_eye;  ///< where the robot really is: for a human beside it
};

/// Turns what is seen into wheel speeds, one control period after the other.
class Driver {
 public:
  virtual ~Driver() = default;
  /// Wheel speeds for the period that begins at `time_s`.
  virtual WheelSpeeds command(double time_s, const Seen& seen) = 0;
  virtual bool done() const = 0;
  /// Of the segment that is being driven: an index into the way's segments.
  virtual int segment() const = 0;
  /// Whether set-points jump at the start of a period; else they ramp over it.
  virtual bool jumps() const { return false; }
};

std::unique_ptr<Driver> make_driver(const DriverChoice& choice, const Way& way, const DriveGeometry& believed,
                                    RandomStream random);

}  // namespace umbsim::worlds

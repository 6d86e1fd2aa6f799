#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/pose2.h"
#include "core/random.h"
#include "core/text/yaml_reader.h"
#include "effects/catalogue.h"
#include "effects/rig.h"
#include "umbmark/course.h"

/// The proving ground of the gap diagnosis: docs/worlds.md.
namespace umbsim::worlds {

/// One robot on one floor in one simulator, at rest at the start. An engine knows nothing of effects, drivers, encoders
/// and trackers: the loop (world_run.h) drives it, reads it, and says from moment to moment what acts from outside.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Simulates `duration_s` > 0 in whole steps, none longer than the engine's own. The commanded wheel speeds go in a
  /// straight line from the last ones (zero at the start) to `command`; the rig's motors (gain, deadband, lag, torque
  /// limit: engines/set_point.h) stand between command and wheel. Throws RunError if the state becomes non-finite.
  virtual void advance(const WheelSpeeds& command, double duration_s) = 0;

  /// Of the axle's middle, in the floor frame (the place and heading given at the start are included), heading
  /// unwrapped.
  virtual Pose2 pose() const = 0;
  /// Radians since the start, relative to the base, forward positive. 0 left, 1 right.
  virtual double wheel_angle(int wheel) const = 0;
  /// The same on the motor's side of any backlash, where the encoder sits.
  virtual double encoder_angle(int wheel) const = 0;
  /// Of the base's upright against the floor's. An engine of the plane says 0.
  virtual double tilt_rad() const = 0;
  virtual std::int64_t steps() const = 0;

  /// Acts from now on until set anew.
  virtual void set_pull(const Pull& pull) = 0;
  /// From now on the wheel rolls as if its radius were `factor` times as large: rough tyres, heat, a lump, a bent axle.
  /// Within a few per cent of 1, changed up to every 10 ms; geometry may stay as it is (the extra way can be given to
  /// the base as a displacement along the wheel's heading).
  virtual void set_rolling_factor(int wheel, double factor) = 0;
  /// From now on the floor carries wheels by this much per metre that they roll, floor frame; in the place of the rig's
  /// floor.drift_x and drift_y (with which the engine starts).
  virtual void set_carpet_drift(double x, double y) = 0;
};

/// One thing that users of an engine set. Drawn from `min` to `max`, or from the choices.
struct EngineOption {
  enum class Draw { uniform, log_uniform, choice };
  std::string name;
  std::string unit;  ///< "1" for a ratio; empty for choices
  Draw draw = Draw::uniform;
  double min = 0;
  double max = 0;
  std::vector<std::string> choices;
  std::string text;  ///< one line: what it does, and whose practice the range is
};

/// Values of an engine's options, by name.
struct EngineOptions {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> choices;
};

/// What a run is built from.
struct EngineSetup {
  Rig rig;                 ///< with all effects applied; rig.pushes is the loop's, not the engine's
  Pose2 X_WB;              ///< where the axle's middle starts
  std::uint64_t seed = 1;  ///< for engines that need random numbers of their own
  double tuned_kg = 0;     ///< robot that the motors' control is tuned for, without a payload; 0: the rig as it stands
};

/// One engine of the proving ground: a line of the table `engines()`.
struct EngineKind {
  std::string name;  ///< as in a worlds file: ours | bullet | mujoco | planar
  std::string text;  ///< one line
  std::vector<EngineOption> options;
  /// What a list of cases may ask of an option; where it is not named, the range that is drawn from.
  std::map<std::string, Bounds> allowed;
  /// How each effect of the catalogue is physics here, one line each. An effect that is not listed cannot be expressed
  /// and is never drawn in this engine.
  std::map<std::string, std::string> expresses;
  /// Settled at rest. Throws RunError where the robot does not stand, InputError where the engine cannot build it.
  std::function<std::unique_ptr<Engine>(const EngineSetup& setup, const EngineOptions& options)> build;
};

/// The one table of engines, in the order of the report. MuJoCo is there where the build found it.
const std::vector<EngineKind>& engines();

/// Throws InputError with the list of names.
const EngineKind& find_engine(const std::string& name);

/// Every option drawn on its own from its range.
EngineOptions draw_options(const EngineKind& kind, RandomStream& random);

/// The middle of every range, and the first of every choice: the most exact, where they differ in that.
EngineOptions middle_options(const EngineKind& kind);

}  // namespace umbsim::worlds

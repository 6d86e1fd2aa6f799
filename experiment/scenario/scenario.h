#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "effects/catalogue.h"
#include "experiment/scenario/expect.h"
#include "odometry/dead_reckoning.h"
#include "odometry/uncertainty.h"
#include "sim/model/suspension.h"
#include "sim/world.h"
#include "umbmark/course.h"

namespace umbsim {

struct RobotChoice {
  std::string urdf = "labmate.urdf";  ///< beside the scenario, or in robots/
  DriveJoints joints;
  WheelSize wheel_size;  ///< 0: the URDF's
  SuspensionChoice suspension;
  double caster_friction = 0;  ///< of fixed balls against the floor
  double torque_limit_nm = 0;  ///< at each wheel; 0: the URDF's effort limit, else what the tyres can pass on
};

/// The odometry's beliefs where they differ from the URDF's nominal dimensions.
struct OdometryChoice {
  std::optional<double> left_radius_m;
  std::optional<double> right_radius_m;
  std::optional<double> wheelbase_m;
  double scrub = 0;
};

/// Which runs are driven.
struct RunChoice {
  std::vector<Direction> directions{Direction::cw, Direction::ccw};
  int per_direction = 5;
  double start_heading_rad = 0;
};

enum class BumpWheel { inner, outer, left, right };

/// Cables that the experimenter lays just ahead of a wheel, where that wheel really is.
struct LaidBumps {
  BumpWheel wheel = BumpWheel::inner;
  int leg = 1;
  int count = 0;
  double height_m = 0.010;
};

struct BumpChoice {
  LaidBumps laid;
  std::vector<Cable> fixed;  ///< cables at given places
  bool any() const { return laid.count > 0 || !fixed.empty(); }
};

constexpr double kRoughest_m_per_sqrt_m = 0.005;  ///< noise.wheel_noise_m_per_sqrt_m at most

/// What differs from run to run. All zero: every run of a direction is the same.
struct NoiseChoice {
  double floor_rms_m = 0;  ///< root mean square height of an uneven floor, a new place on it for each run
  double floor_wavelength_m = 0.3;
  double radius_scatter = 0;            ///< standard deviation of each wheel's relative radius from run to run
  double motor_scatter = 0;             ///< the same of each motor's gain: wheel speed over commanded speed
  double wheel_noise_m_per_sqrt_m = 0;  ///< rough rolling: the variance of a wheel's path is this squared, per metre
};

/// The pose is measured at the end of this leg, before the turn, and corrects the odometry that the driver uses.
struct AbsoluteFix {
  int leg = 1;
  FixNoise noise;
};

struct TruthChoice {
  std::string kind = "track";  ///< track | endpoints
  double rate_hz = 10;         ///< track only
  double position_sd_m = 0;
  double heading_sd_rad = 0;
};

enum class Calibrate { none, endpoint, heading };

struct CalibrationChoice {
  Calibrate method = Calibrate::heading;
  int max_passes = 2;  ///< a second pass only if E_max > 3 standard errors
};

/// An experiment as a file describes it. Every field has a default; scenario.resolved.yaml writes all of them out.
struct Scenario {
  std::string file;  ///< where it was read from
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  RobotChoice robot;
  EncoderSpec encoders;
  double floor_friction = 0.9;
  Course course;
  RunChoice runs;
  BumpChoice bumps;
  NoiseChoice noise;
  TruthChoice truth;
  OdometryChoice odometry;
  PathNoise uncertainty;  ///< what the odometry believes of its own random errors
  std::vector<AbsoluteFix> fixes;
  CalibrationChoice calibration;
  PhysicsOptions physics;
  std::vector<Effect> effects;
  std::vector<Expectation> expect;  ///< what its figures must be
};

/// Reads a scenario file. Throws InputError with file, line, column, key, value and bound.
/// `settings` are `key.path=value` texts (`course.side_m=2`) that replace or add values of the file first.
Scenario read_scenario(const std::string& file, const std::vector<std::string>& settings = {});

/// The same from a document that is loaded already; its file() is where the scenario stands.
Scenario read_scenario(const YamlValue& document);

/// Every value written out, in the form that read_scenario takes.
std::string resolved_yaml(const Scenario& scenario);

/// The URDF that the scenario names, found beside the scenario or in the shipped robots/.
std::string scenario_urdf(const Scenario& scenario);

/// Its text; with the drive wheels' shapes in it where these come from a mesh or from the scenario.
std::string scenario_urdf_text(const Scenario& scenario);

/// Writes a scenario that runs wherever its folder is taken to: every value written out, the robot's URDF beside it.
void write_scenario(Scenario scenario, const std::filesystem::path& file);

/// The robot that the scenario names, found beside the scenario or in the shipped robots/, on its suspension.
/// `remarks`: what a reader of the URDF wants to be told.
RobotModel load_scenario_robot(const Scenario& scenario, std::vector<Remark>* remarks = nullptr);

/// What was assumed of the scenario's robot because its URDF does not say it, as warnings.
std::vector<std::string> assumed_of_robot(const Scenario& scenario);

/// The odometry that the scenario starts with: nominal dimensions unless it gives others.
OdometryParameters initial_odometry(const Scenario& scenario, const RobotModel& nominal);

const char* name(BumpWheel wheel);
const char* name(Calibrate method);

}  // namespace umbsim

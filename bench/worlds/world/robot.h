#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"
#include "sim/model/robot_model.h"

namespace umbsim::worlds {

/// The LabMate's wheel, from which robots are scaled.
constexpr double kLabmateRadius_m = 0.075;

/// The multiple of `grain` next to `value`: figures of a drawn robot are round.
inline double rounded(double value, double grain) { return std::round(value / grain) * grain; }

/// How a drawn robot is held up beside its wheels.
constexpr const char* kCasterKinds[] = {"ball_ahead", "ball_behind", "two_balls", "swivel_ahead", "swivel_behind"};

/// Dimensions of a drawn robot, as on a data sheet.
struct RobotDimensions {
  double base_mass_kg = 40;
  double wheel_radius_m = 0.075;
  double wheel_width_m = 0.03;
  double wheelbase_m = 0.34;
  std::string casters = "ball_ahead";
  double caster_m = 0.25;              ///< from the axle to the caster, along
  double mass_centre_share = 0.25;     ///< of the way from the axle to the caster
  double mass_centre_height_m = 0.05;  ///< above the axle
};

/// A robot of a world: what its experimenter believes, and its URDF, which goes with every recording.
struct WorldRobot {
  std::string name;  ///< "drawn", or the file in robots/
  std::string urdf;  ///< the whole text
  RobotModel model;
  double ticks_per_revolution = 0;
};

/// 2 to 200 kg on wheels of 3 to 15 cm; larger robots have larger wheels.
RobotDimensions draw_dimensions(RandomStream& random);

/// As a URDF: inertias of a box, motors scaled from the LabMate's with mass and wheel (robots/labmate.urdf).
std::string robot_urdf(const RobotDimensions& dimensions);

/// A robot from `urdf` text. Throws InputError as load_robot does.
WorldRobot make_robot(const std::string& name, const std::string& urdf, double ticks_per_revolution);

/// A drawn robot three times of four, else a file of `folder`; 200 to 20 000 counts a revolution.
WorldRobot draw_robot(const std::string& folder, RandomStream& random);

}  // namespace umbsim::worlds

#pragma once

#include "sim/world.h"

namespace umbsim::fidelity {

constexpr double kG_mps2 = 9.81;  // as in PhysicsOptions

/// How finely a chapter's grid is measured: coarse for the test of every change, full for the document.
enum class Grid { coarse, full };

/// The shipped robots, without what their urdfs could change later: wheel radius and wheelbase as given.
RobotModel labmate(double radius_m = 0.075, double wheelbase_m = 0.340);
RobotModel optiodom(double radius_m = 0.042, double wheelbase_m = 0.2);

/// A robot on three points as one rigid body: what statics and plane dynamics need. Frame: below the axle's middle on
/// the floor, x forward, y left, z up.
struct Body {
  double mass_kg = 0;
  Eigen::Vector3d com_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_kgm2 = Eigen::Matrix3d::Zero();  ///< about the centre of mass, wheels locked
  double half_m = 0;            ///< wheels at y = half_m and -half_m
  double ball_x_m = 0;
  double ball_y_m = 0;
  double ball_friction = 0;
  double radius_m = 0;
  double spin_kgm2 = 0;         ///< of one wheel about its axle
};
Body body_of(const RobotModel& robot);

/// Contacts without the softness of the default settings.
PhysicsOptions rigid(double step_s = PhysicsOptions{}.step_s);

/// One control period of 20 ms after another at one command.
void hold(World& world, double left_radps, double right_radps, double seconds);

/// From rest to a command in `ramp_s`, along it for `seconds`, and back to rest.
void trip(World& world, double left_radps, double right_radps, double seconds, double ramp_s = 1);

}  // namespace umbsim::fidelity

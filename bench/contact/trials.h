#pragma once

#include "sim/world.h"

/// Small experiments with one contact law each, on the robot of round numbers (40 kg, R 75 mm, b 340 mm). Each returns
/// the figure that the law has in closed form.
namespace umbsim::contact {

constexpr double kMu = 0.9;

PhysicsOptions with_step(double step_s);

/// A robot at 0.2 m/s under a steady force at its axle.
struct Slip {
  double traction = 0;           ///< F / N of both wheels, N by statics
  double slip = 0;               ///< sideways or forward, per metre of the odometry
  double acceleration_mps2 = 0;  ///< over the last two seconds
  double intended_mps2 = 0;      ///< 0 below the limit, else from m a = F - mu N
  long fallbacks = 0;
};
Slip slip_along(double creep, double force_n, const PhysicsOptions& options = {});
Slip slip_across(double creep, double force_n, const PhysicsOptions& options = {});

/// A figure and what the law says.
struct Figure {
  double measured = 0;
  double intended = 0;
};

/// Share of a turn on the spot, and of a gentle curve, that a contact patch takes.
Figure turn_lost(double creep, double width_m, const PhysicsOptions& options = {});
Figure curve_lost(double creep, double width_m, const PhysicsOptions& options = {});
/// Heading per metre across a slope, from a straight start.
Figure slope_heading(double creep, double slope_rad, const PhysicsOptions& options = {});
/// Distance error of a straight leg by tyre compliance.
Figure compliance(double metres_per_newton, const PhysicsOptions& options = {});
/// Yaw per metre by a caster that drags beside the middle.
Figure drag_yaw(double creep, const PhysicsOptions& options = {});
/// Sideways shift by a carpet over a leg and four turns in place, per metre rolled.
Figure carpet(const PhysicsOptions& options = {});
/// Heading kick of a swivelling caster after a quarter turn. Nothing intended: only compared between steps.
double swivel_kick(const PhysicsOptions& options = {});

}  // namespace umbsim::contact

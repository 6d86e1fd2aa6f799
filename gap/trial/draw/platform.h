#pragma once

#include <string>

#include "gap/trial/draw/trial_plan.h"
#include "recording/recording.h"

namespace umbsim {

/// Dimensions of a drawn robot.
struct TrialRobot {
  double wheel_radius_m = 0;
  double wheelbase_m = 0;
  double base_mass_kg = 0;
  double caster_ahead_m = 0;        ///< of the axle
  double mass_centre_ahead_m = 0;
  double mass_centre_height_m = 0;  ///< above the axle
};

/// A robot and its course.
struct Platform {
  TrialRobot robot;
  double ticks_per_revolution = 0;
  double side_m = 0;
  double linear_speed_mps = 0;
  double angular_speed_radps = 0;
};

/// File name of the robot's URDF, beside recording.yaml.
constexpr const char* kTrialUrdf = "robot.urdf";

/// Of every robot's drive wheels; no contact is wider.
constexpr double kTrialWheelWidth_m = 0.03;

/// Number `index` of the trial's platforms.
Platform draw_platform(const TrialPlan& plan, int index);

/// The robot as a URDF: two wheels and one ball without friction, of the LabMate's build (robots/labmate.urdf), its
/// inertias and motors scaled with mass and size.
std::string robot_urdf(const TrialRobot& robot);

/// The recording of a case before it is driven: everything but ticks and poses.
Recording planned_recording(const TrialPlan& plan, const Platform& platform, const std::vector<PlannedRun>& runs);

/// The plain runs only.
std::vector<PlannedRun> plain_runs(const std::vector<PlannedRun>& runs);

}  // namespace umbsim

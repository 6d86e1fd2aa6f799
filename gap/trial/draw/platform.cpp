#include "gap/trial/draw/platform.h"

#include <fmt/format.h>

#include <cmath>

#include "core/random.h"

namespace umbsim {
namespace {

constexpr double kEncoderRate_hz = 50;
constexpr double kLinearAcceleration_mps2 = 0.25;
constexpr double kAngularAcceleration_radps2 = 1.5;

// The LabMate's own figures, from which others are scaled.
constexpr double kLabmateMass_kg = 40;
constexpr double kLabmateRadius_m = 0.075;
constexpr double kLabmateWheelbase_m = 0.34;
constexpr double kLabmateEffort_nm = 20;

constexpr double kWheelMass_kg = 1;
constexpr double kCasterRadius_m = 0.03;

// To the tenth of a millimetre, gram and so on, as on a data sheet.
double draw(RandomStream& random, const Range& range, double grain) {
  return std::round(random.uniform(range.min, range.max) / grain) * grain;
}

std::string wheel(const char* side, const TrialRobot& r, double y_m) {
  const double spin = kWheelMass_kg * r.wheel_radius_m * r.wheel_radius_m / 2;
  const double across =
      kWheelMass_kg * (3 * r.wheel_radius_m * r.wheel_radius_m + kTrialWheelWidth_m * kTrialWheelWidth_m) / 12;
  const double effort =
      kLabmateEffort_nm * r.base_mass_kg / kLabmateMass_kg * r.wheel_radius_m / kLabmateRadius_m;
  return fmt::format(R"(  <link name="{0}_wheel">
    <inertial>
      <mass value="{1}"/>
      <inertia ixx="{2:.9f}" ixy="0" ixz="0" iyy="{3:.9f}" iyz="0" izz="{2:.9f}"/>
    </inertial>
    <collision>
      <origin rpy="1.5707963267948966 0 0"/>
      <geometry><cylinder radius="{4:.4f}" length="{5}"/></geometry>
    </collision>
  </link>
  <joint name="{0}_wheel_joint" type="continuous">
    <parent link="base_link"/>
    <child link="{0}_wheel"/>
    <origin xyz="0 {6:.5f} 0"/>
    <axis xyz="0 1 0"/>
    <limit effort="{7:.3f}" velocity="30"/>
  </joint>
)",
                     side, kWheelMass_kg, across, spin, r.wheel_radius_m, kTrialWheelWidth_m, y_m, effort);
}

}  // namespace

Platform draw_platform(const TrialPlan& plan, int index) {
  const PlatformRanges& p = plan.platforms;
  RandomStream random(plan.seed, "trial platform", std::uint64_t(index));
  Platform drawn;
  drawn.robot.wheel_radius_m = draw(random, p.wheel_radius_m, 1e-4);
  drawn.robot.wheelbase_m = draw(random, p.wheelbase_m, 1e-4);
  drawn.robot.base_mass_kg = draw(random, p.base_mass_kg, 0.1);
  drawn.robot.caster_ahead_m = draw(random, p.caster_ahead_m, 1e-3);
  drawn.robot.mass_centre_ahead_m = drawn.robot.caster_ahead_m * draw(random, p.mass_centre_share, 1e-2);
  drawn.robot.mass_centre_height_m = draw(random, p.mass_centre_height_m, 1e-3);
  drawn.ticks_per_revolution = draw(random, p.ticks_per_revolution, 4);  // quadrature: four counts a line
  drawn.side_m = draw(random, p.side_m, 0.1);
  drawn.linear_speed_mps = draw(random, p.linear_speed_mps, 0.01);
  drawn.angular_speed_radps = draw(random, p.angular_speed_radps, 0.01);
  return drawn;
}

std::string robot_urdf(const TrialRobot& r) {
  const double size = r.wheelbase_m / kLabmateWheelbase_m;
  const double scale = r.base_mass_kg / kLabmateMass_kg * size * size;
  std::string text = fmt::format(R"(<?xml version="1.0"?>
<robot name="trial_robot">
  <link name="base_link">
    <inertial>
      <origin xyz="{:.5f} 0 {:.5f}"/>
      <mass value="{:.3f}"/>
      <inertia ixx="{:.6f}" ixy="0" ixz="0" iyy="{:.6f}" iyz="0" izz="{:.6f}"/>
    </inertial>
  </link>
)",
                                 r.mass_centre_ahead_m, r.mass_centre_height_m, r.base_mass_kg, 0.9 * scale,
                                 0.9 * scale, 1.4 * scale);
  text += wheel("left", r, r.wheelbase_m / 2) + wheel("right", r, -r.wheelbase_m / 2);
  return text + fmt::format(R"(  <link name="caster">
    <collision>
      <geometry><sphere radius="{}"/></geometry>
    </collision>
  </link>
  <joint name="caster_joint" type="fixed">
    <parent link="base_link"/>
    <child link="caster"/>
    <origin xyz="{:.4f} 0 {:.4f}"/>
  </joint>
</robot>
)",
                            kCasterRadius_m, r.caster_ahead_m, kCasterRadius_m - r.wheel_radius_m);
}

Recording planned_recording(const TrialPlan& plan, const Platform& p, const std::vector<PlannedRun>& runs) {
  Recording r;
  r.title = "trial recording";
  r.robot = {kTrialUrdf, p.robot.wheel_radius_m, p.robot.wheelbase_m, p.ticks_per_revolution, robot_urdf(p.robot)};
  r.path.side_m = p.side_m;
  r.path.linear_speed_mps = p.linear_speed_mps;
  r.path.angular_speed_radps = p.angular_speed_radps;
  r.path.linear_acceleration_mps2 = kLinearAcceleration_mps2;
  r.path.angular_acceleration_radps2 = kAngularAcceleration_radps2;
  r.encoder_rate_hz = kEncoderRate_hz;
  r.truth_position_sd_m = plan.noise.position_sd_m;
  r.truth_heading_sd_rad = plan.noise.heading_sd_rad;
  for (const PlannedRun& planned : runs) {
    RecordedRun run;
    run.id = planned.id;
    run.direction = planned.direction;
    if (planned.start_heading_rad != 0) run.start_heading_rad = planned.start_heading_rad;
    if (planned.speed_factor != 1) run.linear_speed_mps = planned.speed_factor * p.linear_speed_mps;
    if (planned.turn_radius_m > 0) {
      run.turn = "arc";
      run.turn_radius_m = planned.turn_radius_m;
    }
    if (planned.payload_kg > 0) run.payload_kg = planned.payload_kg;
    r.runs.push_back(run);
  }
  return r;
}

std::vector<PlannedRun> plain_runs(const std::vector<PlannedRun>& runs) {
  std::vector<PlannedRun> plain;
  for (const PlannedRun& run : runs) {
    if (run.plain()) plain.push_back(run);
  }
  return plain;
}

}  // namespace umbsim

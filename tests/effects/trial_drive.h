#pragma once

#include <cmath>

#include "effects/rig.h"
#include "odometry/dead_reckoning.h"
#include "sim/world.h"
#include "tests/effects/labmate.h"
#include "tests/sim/rolling_robot.h"

namespace umbsim::testing {

/// A rig around the robot of round numbers, with effects applied to it.
template <class... Effects>
Rig rig_with(const Effects&... effects) {
  Rig rig;
  rig.robot = labmate(kRadius_m, kWheelbase_m);
  (apply(effects, rig), ...);
  return rig;
}

/// Load on each support of a robot that stands or drives steadily on a level floor: moments about the axle and about
/// the robot's long axis.
struct Statics {
  explicit Statics(const RobotModel& robot) : weight_n(robot.total_mass_kg() * kG), base_n(robot.base.mass_kg * kG) {
    const Eigen::Vector3d& caster = robot.casters[0].centre_m;
    caster_n = base_n * robot.base.com_m.x() / caster.x();
    wheels_n = weight_n - caster_n;
    const double sideways_n = (base_n * robot.base.com_m.y() - caster_n * caster.y()) / robot.wheelbase_m();
    left_n = wheels_n / 2 + sideways_n;
    right_n = wheels_n / 2 - sideways_n;
  }
  double weight_n, base_n;
  double caster_n = 0, wheels_n = 0, left_n = 0, right_n = 0;
};

/// Drives a rig by wheel speeds and keeps its odometry, with perfect encoders and nominal dimensions.
class TrialDrive {
 public:
  explicit TrialDrive(const Rig& rig, const PhysicsOptions& options = {}, const Pose2& X_WB = {})
      : world(rig.robot, rig.drivetrain, rig.floor, options, pushes(rig)), odometry(X_WB) {
    world.place(X_WB);
    odometry = world.pose();  // it moves by micrometres while it settles
  }

  /// At the speeds of a robot that moves at `v_mps` and `w_radps` without slip.
  void go(double v_mps, double w_radps, double seconds) {
    for (int i = 0; i < std::lround(seconds / kPeriod_s); ++i) period(v_mps, w_radps);
  }

  /// Speeds change in proportion to time.
  void ramp(double v_mps, double w_radps, double seconds) {
    const double v0 = v_, w0 = w_;
    const int periods = int(std::lround(seconds / kPeriod_s));
    for (int i = 1; i <= periods; ++i) {
      const double part = double(i) / periods;
      period(v0 + part * (v_mps - v0), w0 + part * (w_radps - w0));
    }
  }

  /// A leg or turn from rest to rest with ramps of one second.
  void leg(double v_mps, double w_radps, double seconds) {
    ramp(v_mps, w_radps, 1);
    go(v_mps, w_radps, seconds);
    ramp(0, 0, 1);
    go(0, 0, 0.4);
  }

  /// Truth minus odometry, floor frame.
  Pose2 error() const {
    const Pose2 truth = world.pose();
    return {truth.x_m - odometry.x_m, truth.y_m - odometry.y_m, truth.theta_rad - odometry.theta_rad};
  }

  World world;
  Pose2 odometry;
  double rolled_m = 0;  ///< mean of both wheels, without sign

 private:
  static constexpr double kPeriod_s = 0.02;

  static std::vector<Push> pushes(const Rig& rig) {
    std::vector<Push> result;
    for (const LegPush& p : rig.pushes) result.push_back(p.push);
    return result;
  }

  void period(double v_mps, double w_radps) {
    v_ = v_mps, w_ = w_radps;
    const double half_mps = w_radps * kWheelbase_m / 2;
    world.command((v_mps - half_mps) / kRadius_m, (v_mps + half_mps) / kRadius_m);
    world.advance(kPeriod_s);
    const double left_m = (world.encoder_angle(0) - left_rad_) * kRadius_m;
    const double right_m = (world.encoder_angle(1) - right_rad_) * kRadius_m;
    left_rad_ = world.encoder_angle(0);
    right_rad_ = world.encoder_angle(1);
    odometry = odometry * arc((left_m + right_m) / 2, (right_m - left_m) / kWheelbase_m);
    rolled_m += (std::abs(left_m) + std::abs(right_m)) / 2;
  }

  double v_ = 0, w_ = 0;
  double left_rad_ = 0, right_rad_ = 0;
};

}  // namespace umbsim::testing

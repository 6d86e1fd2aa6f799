#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "bench/worlds/engines/bullet/options.h"
#include "bench/worlds/engines/set_point.h"
#include "core/pose2.h"
#include "effects/rig.h"

namespace umbsim::worlds::bullet {

class Model;

/// A rig in Bullet's own multibody world, at rest and settled at X_WB.
class BulletRobot {
 public:
  /// Throws RunError if the robot does not stand, InputError for a floor that is not flat or motors with a play.
  BulletRobot(const Rig& rig, const BulletOptions& options, const Pose2& X_WB);
  ~BulletRobot();

  void advance(const std::array<double, 2>& command_radps, double duration_s);

  Pose2 pose() const;
  double wheel_angle(int wheel) const;
  double tilt_rad() const;
  double load_n(int wheel) const;
  std::int64_t steps() const { return steps_; }

  void set_pull(const Pull& pull) { pull_ = pull; }
  void set_rolling_factor(int wheel, double factor) { rolling_factor_[std::size_t(wheel)] = factor; }
  void set_carpet_drift(double x, double y) { drift_ = {x, y}; }

 private:
  void settle(const Pose2& X_WB);
  void step(double step_s);
  void grip();
  void pull();
  void carry();
  void turn(double angle_rad, double x_m, double y_m);
  void note_heading();

  Rig rig_;
  BulletOptions options_;
  std::unique_ptr<Model> model_;
  std::array<SetPoint, 2> set_points_;
  std::array<double, 2> radius_m_{}, last_rad_{}, zero_rad_{}, rolling_factor_{1, 1};
  Pull pull_;
  std::array<double, 2> drift_{};
  double heading_rad_ = 0;
  double last_step_s_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace umbsim::worlds::bullet

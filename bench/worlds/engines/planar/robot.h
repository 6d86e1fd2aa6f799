#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "bench/worlds/engines/planar/caster.h"
#include "bench/worlds/engines/planar/drive.h"
#include "bench/worlds/engines/planar/ground.h"
#include "bench/worlds/engines/planar/supports.h"
#include "bench/worlds/engines/planar/tyre.h"
#include "core/pose2.h"
#include "effects/rig.h"

/// A vehicle model of the plane: one rigid body, loads by quasi-static balance, tyres, motors. It shares no equation
/// with sim/: docs/worlds.md, "The planar model".
namespace umbsim::worlds::planar {

/// A part of the tread's width.
struct Strip {
  Tread tread;
  double beside_m = 0;  ///< left of the wheel's middle
  double share = 1;     ///< of the load
};

struct PlanarOptions {
  TyreLaw::Curve curve = TyreLaw::Curve::brush;
  double creep = 0.005;                 ///< of every tyre, beside the rig's
  double relaxation_over_radius = 0.4;  ///< way after which a tyre's force has built up
  double contact_damping_ratio = 0.3;   ///< of the robot on its standing tyres
  double servo_time_s = 0.01;           ///< the motors' control against the robot's inertia,
  double tuned_kg = 0;                  ///< which is of this mass, whatever is on board; 0: of the rig's
  double integral_time_s = 0.1;
  double rotor_over_wheel = 2;  ///< inertia at the wheel's side of the gear
  double load_time_s = 0.005;   ///< in which loads follow accelerations
  double step_share = 1;        ///< of the step that the stiffest part wants; tests halve it
};

class PlanarRobot {
 public:
  /// At rest. Throws RunError if it does not stand.
  PlanarRobot(const Rig& rig, const PlanarOptions& options, const Pose2& X_WB);

  void advance(const std::array<double, 2>& command_radps, double duration_s);

  const Pose2& pose() const { return X_WB_; }
  double wheel_angle(int wheel) const;
  double encoder_angle(int wheel) const;
  double tilt_rad() const;
  std::int64_t steps() const { return steps_; }
  double step_s() const { return step_s_; }

  void set_pull(const Pull& pull) { pull_ = pull; }
  void set_rolling_factor(int wheel, double factor) { wheels_[std::size_t(wheel)].rolling_factor = factor; }
  void set_carpet_drift(double x, double y) { drift_ = {x, y}; }

  // For tests.
  double energy_j() const;  ///< kinetic, and of the treads
  double momentum_ns() const;
  double grip_used(int wheel) const { return wheels_[std::size_t(wheel)].grip_used; }  ///< |force| / (friction * load)
  double load_n(int wheel) const { return wheels_[std::size_t(wheel)].load_n; }

 private:
  struct WheelPart {
    umbsim::Wheel wheel;
    Drive drive;
    SetPoint set_point;
    TyreLaw law;
    std::vector<Strip> strips{};
    Eigen::Vector2d place_m{}, ahead{}, left{};
    double rolling_factor = 1;
    Carried on{};
    double friction = 0;
    double load_n = 0;
    double along_n = 0;  // force of the floor in the last step
    double floor_nm = 0;
    double grip_used = 0;
    double zero_wheel_rad = 0, zero_shaft_rad = 0;
  };

  void add_wheel(const umbsim::Wheel& wheel, const Motor& motor, const Rig& rig);
  TyreLaw law_of(double radius_m, double along, double across) const;
  void add_masses(const Rig& rig);
  void choose_step();
  void settle();
  void stand(double frame_s);
  void load_supports(double frame_s);
  Pressing pressing() const;
  void step();
  Hold hold(WheelPart& wheel);
  static Eigen::Vector2d rim(const WheelPart& wheel);
  void face(double heading_rad);
  void move(const Eigen::Vector2d& force_n, double yaw_nm);
  Eigen::Vector2d in_base(const Eigen::Vector2d& floor_vector) const;
  Eigen::Vector2d on_floor(const Eigen::Vector2d& base_place_m) const;
  Eigen::Vector2d axle_velocity() const;

  PlanarOptions options_;
  Floor floor_;
  std::vector<WheelPart> wheels_;
  std::vector<CasterPart> casters_;
  Supports supports_;
  double mass_kg_ = 0, yaw_kgm2_ = 0, centre_height_m_ = 0, axle_height_m_ = 0, weight_n_ = 0;
  Eigen::Vector2d downhill_n_;  // weight along the floor, floor frame
  Eigen::Vector2d centre_m_ = Eigen::Vector2d::Zero();
  Pull pull_;
  Eigen::Vector2d drift_;

  Pose2 X_WB_;
  double cos_ = 1, sin_ = 0;                                // of the heading
  Eigen::Vector2d velocity_mps_ = Eigen::Vector2d::Zero();  // of the centre of mass, base frame
  double yaw_radps_ = 0;
  Eigen::Vector2d inertia_n_ = Eigen::Vector2d::Zero();  // mass * acceleration, base frame, smoothed
  Eigen::Vector2d acceleration_ = Eigen::Vector2d::Zero();
  std::vector<double> raised_m_;  // kept between frames for its memory
  double pitch_rad_ = 0, pitch_radps_ = 0;
  double tipping_s_ = 0;
  double step_s_ = 0;
  double now_step_s_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace umbsim::worlds::planar

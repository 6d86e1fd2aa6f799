#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/pose2.h"
#include "sim/world.h"

namespace umbsim::bench {

/// What every simulator under comparison must do: the same robot, driven by the same wheel-speed commands.
class Engine {
 public:
  virtual ~Engine() = default;
  /// At rest at the origin, heading along +x, settled.
  virtual void place() = 0;
  virtual void command(double left_radps, double right_radps) = 0;
  virtual void advance(double duration_s) = 0;
  virtual Pose2 pose() const = 0;
  virtual double wheel_angle(int wheel) const = 0;
  virtual std::int64_t steps() const = 0;
};

/// The robot and the floor that all engines build. `cable`: one round cable under the right wheel's path.
struct Setup {
  RobotModel robot;
  Floor floor;
  double torque_limit_nm = 20;
  double step_s = 0.001;
  double fine_step_s = 0.001;  ///< ours only: near cables
};

std::unique_ptr<Engine> make_ours(const Setup& setup);

/// Bullet as it comes: btMultiBodyDynamicsWorld, its default sequential-impulse solver, btCylinderShape wheels.
std::unique_ptr<Engine> make_stock_bullet(const Setup& setup, int iterations);

/// MuJoCo's settings that matter for this task. The defaults are the best that `umbsim_compare --tune-mujoco` found.
struct MujocoOptions {
  std::string integrator = "Euler";     ///< Euler | RK4 | implicit
  std::string cone = "pyramidal";       ///< pyramidal | elliptic
  std::string wheel = "ellipsoid";      ///< cylinder | ellipsoid | sphere
  double servo_gain = 20;               ///< velocity servo, N m s
  double contact_time_s = 0.004;        ///< solref's time constant; at least two steps
  double impratio = 100;
  int noslip_iterations = 0;
};

std::unique_ptr<Engine> make_mujoco(const Setup& setup, const MujocoOptions& options);

}  // namespace umbsim::bench

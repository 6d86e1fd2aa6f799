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

/// Settings of plain Bullet. The defaults are Bullet as it comes.
struct StockBulletOptions {
  std::string wheel = "cylinder";     ///< cylinder | sphere (of the same radius: touches the floor in one exact point)
  std::string solver = "sequential";  ///< sequential: impulses; direct: Dantzig's, which needs the round wheels
  int iterations = 10;                ///< of the sequential solver, per step
};

/// Plain Bullet: btMultiBodyDynamicsWorld with its own collision detection, contacts and solvers.
std::unique_ptr<Engine> make_stock_bullet(const Setup& setup, const StockBulletOptions& options);

/// MuJoCo's settings that matter here. umbsim_tune_mujoco tries them out; docs/bench.md says which were chosen.
struct MujocoOptions {
  std::string integrator = "Euler";   ///< Euler | RK4 | implicit
  std::string cone = "pyramidal";     ///< pyramidal | elliptic
  std::string wheel = "ellipsoid";    ///< cylinder | ellipsoid | sphere
  std::string servo = "actuator";     ///< actuator: a velocity servo; damping: the same as implicit joint damping
  double servo_gain = 20;             ///< N m s
  double contact_time_s = 0.004;      ///< solref's time constant; at least two steps
  double contact_damping_ratio = 1;   ///< solref's second number
  std::string solimp = "0.99 0.999 0.0001";
  double impratio = 100;
  int noslip_iterations = 0;
};

/// The best that umbsim_tune_mujoco found for each task: docs/bench.md.
MujocoOptions mujoco_for_square(double step_s);
MujocoOptions mujoco_for_cable();

std::unique_ptr<Engine> make_mujoco(const Setup& setup, const MujocoOptions& options);

}  // namespace umbsim::bench

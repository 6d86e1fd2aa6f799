#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/pose2.h"
#include "sim/model/drivetrain.h"
#include "sim/model/floor.h"
#include "sim/model/push.h"
#include "sim/model/robot_model.h"
#include "sim/standing.h"

namespace umbsim {

/// How much wheels and casters give under load. The spring sinks by `static_sink_m` under the load that the support
/// carries at rest, where its radius is the nominal one; the rolling radius does not follow (a tread that keeps its
/// length). Without it every bump would be a blow between rigid bodies, which lifts the other wheels.
struct Softness {
  double static_sink_m = 0.00012;
  double damping_ratio = 2;  ///< of the load on its spring
};

struct PhysicsOptions {
  double step_s = 0.020;       ///< longest time step
  double fine_step_s = 0.001;  ///< longest time step while a wheel is on or near a cable
  double gravity_mps2 = 9.81;
  Softness softness;
  bool may_lean = false;  ///< a robot on one line of supports has not fallen before it leans by kTippedOver_rad: for
                          ///< robots that were recorded, and came down again
  bool general_steps = false;  ///< take the general step always: the same to round-off, slower. For tests.
};

/// What the world counted, to be reported and explained.
struct PhysicsCost {
  std::int64_t steps = 0;
  std::int64_t general_steps = 0;     ///< steps that no quicker one could take
  std::int64_t newton_steps = 0;      ///< steps with sliding, lift-off or a saturated motor
  std::int64_t solver_fallbacks = 0;  ///< steps in which the direct solver gave up
  double simulated_s = 0;
};

/// Forces on each support at the end of the last step, in newtons.
struct SupportLoads {
  std::array<double, 2> wheel_n{};
  std::array<double, 2> wheel_along_n{};  ///< friction along the way that the wheel rolls, signed
  std::array<double, 8> caster_n{};
};

/// How a wheel was loaded since World::place.
struct WheelStrain {
  double least_n = 0;
  double mean_n = 0;
  double unloaded_s = 0;          ///< in all
  double longest_unloaded_s = 0;  ///< at one time
  double longest_from_s = 0;      ///< from when on
  double slid_s = 0;              ///< at its friction limit
};

struct Snapshot;

/// A robot on a floor: Bullet's articulated-body dynamics (btMultiBody), contacts of ideal round shapes, and a
/// direct contact solver (sim/dynamics/contact_solver.h). Knows nothing of effects: it simulates the description it is
/// given.
class World {
 public:
  World(const RobotModel& robot, const Drivetrain& drivetrain, const Floor& floor, const PhysicsOptions& options,
        const std::vector<Push>& pushes = {});
  ~World();
  World(World&&) noexcept;

  /// Sets the robot at rest on the floor with the axle's middle at X_WB, and lets it settle with the motors
  /// braked. Throws InputError if it then does not stand: a rigid wheel or one of three supports carries no load, or
  /// what does lies on one line.
  void place(const Pose2& X_WB);

  /// Wheel speeds at the end of the next `advance`, forward positive. Throws InputError beyond 1e6 rad/s either way.
  void command(double left_radps, double right_radps);

  /// Simulates `duration_s`. Throws RunError if the state becomes non-finite, TippedOver if the robot no longer stands
  /// on its wheels and casters: it leans by more than kTippedOver_rad, or what touches the floor lies on one line for
  /// longer than kMoment_s, unless PhysicsOptions::may_lean.
  void advance(double duration_s);

  /// The same in one time step, however long, with wheels that turn at `mean_radps` (left, right) and end at the
  /// commanded speeds. Only where that is as good as many short steps: a robot with round wheels on rigid axles and
  /// without play rolls on a floor that is even there, nothing pushes it, and no wheel slides, nor would where the
  /// robot is accelerated by `peak_mps2` more for a moment. Else false, and nothing has happened. Throws as `advance`.
  bool roll(const std::array<double, 2>& mean_radps, double duration_s, double peak_mps2 = 0);

  /// The moment at the end of the last `advance`.
  Snapshot snapshot() const;
  /// Goes on from a moment of a world with the same robot, drivetrain and options, on this world's floor. `X_moved`:
  /// the robot is carried there from where it was, turned about the floor's origin and then shifted.
  void resume(const Snapshot& then, const Pose2& X_moved);

  void lay_cable(const Cable& cable);

  /// From now on the wheel rolls as if its radius were `factor` times as large; where it touches is as before. A rough
  /// floor or tyre does this, other at every grain.
  void scale_rolling_radius(int wheel, double factor);

  /// Acts from now on until set anew.
  void set_pull(const Pull& pull);

  /// From now on the floor carries wheels by this much per metre that they roll, floor frame: in the place of
  /// Floor::drift_x and drift_y.
  void set_carpet_drift(double x, double y);

  /// Pose of the axle's middle, projected on the floor plane; heading unwrapped.
  Pose2 pose() const;
  /// 0 left, 1 right; radians since `place`, relative to the base, forward positive.
  double wheel_angle(int wheel) const;
  double wheel_speed(int wheel) const;
  /// The same angle where the encoder sits, on the motor's side of any backlash.
  double encoder_angle(int wheel) const;
  Eigen::Vector3d wheel_centre(int wheel) const;
  /// Roll and pitch, for tests and traces.
  Eigen::Vector3d up() const;
  const SupportLoads& loads() const;
  WheelStrain strain(int wheel) const;
  /// Whether a wheel slid in the last time step.
  bool slides() const;
  /// How far the suspension has moved a support up into the robot: left and right wheel, then casters.
  double spring_up_m(int support) const;
  /// How it stands as it is now.
  Standing standing() const;
  const PhysicsCost& cost() const;
  /// Kinetic plus potential energy, joules. For tests.
  double energy() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace umbsim

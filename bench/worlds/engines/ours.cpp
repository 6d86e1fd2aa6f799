// This simulator as an engine of the proving ground, with its numerical options drawn.
#include <algorithm>
#include <cmath>

#include "bench/worlds/engines/kinds.h"
#include "sim/world.h"

namespace umbsim::worlds {
namespace {

class Ours : public Engine {
 public:
  Ours(const EngineSetup& setup, const PhysicsOptions& options)
      : world_(setup.rig.robot, setup.rig.drivetrain, setup.rig.floor, options) {
    world_.place(setup.X_WB);
  }
  void advance(const WheelSpeeds& command, double duration_s) override {
    world_.command(command.left_radps, command.right_radps);
    world_.advance(duration_s);
  }
  Pose2 pose() const override { return world_.pose(); }
  double wheel_angle(int wheel) const override { return world_.wheel_angle(wheel); }
  double encoder_angle(int wheel) const override { return world_.encoder_angle(wheel); }
  double tilt_rad() const override { return std::acos(std::min(1.0, world_.up().z())); }
  std::int64_t steps() const override { return world_.cost().steps; }
  void set_pull(const Pull& pull) override { world_.set_pull(pull); }
  void set_rolling_factor(int wheel, double factor) override { world_.scale_rolling_radius(wheel, factor); }
  void set_carpet_drift(double x, double y) override { world_.set_carpet_drift(x, y); }

 private:
  World world_;
};

std::unique_ptr<Engine> build_ours(const EngineSetup& setup, const EngineOptions& options) {
  PhysicsOptions physics;
  physics.step_s = options.numbers.at("step_s");
  physics.fine_step_s = options.numbers.at("fine_step_s");
  physics.softness.static_sink_m = options.numbers.at("static_sink_m");
  physics.softness.damping_ratio = options.numbers.at("damping_ratio");
  return std::make_unique<Ours>(setup, physics);
}

}  // namespace

EngineKind our_engine() {
  using Draw = EngineOption::Draw;
  EngineKind kind;
  kind.name = "ours";
  kind.text = "this simulator: Bullet's articulated bodies with contacts and solver of its own (sim/)";
  kind.options = {
      {"step_s", "s", Draw::log_uniform, 0.005, 0.02, {}, "longest time step; 20 ms is the default"},
      {"fine_step_s", "s", Draw::log_uniform, 0.0005, 0.002, {}, "near cables"},
      {"static_sink_m", "m", Draw::log_uniform, 0.00005, 0.0005, {}, "of supports under their load at rest"},
      {"damping_ratio", "1", Draw::uniform, 1, 3, {}, "of the load on its spring"},
  };
  for (const EffectInfo& info : catalogue()) kind.expresses[info.name] = "as in the catalogue";
  kind.build = build_ours;
  return kind;
}

}  // namespace umbsim::worlds

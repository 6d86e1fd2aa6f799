// Bullet's own multibody world as an engine of the proving ground, as its users take it.
#include "bench/worlds/engines/bullet/robot.h"
#include "bench/worlds/engines/kinds.h"

namespace umbsim::worlds {
namespace {

class Bullet : public Engine {
 public:
  Bullet(const EngineSetup& setup, const bullet::BulletOptions& options) : robot_(setup.rig, options, setup.X_WB) {}
  void advance(const WheelSpeeds& command, double duration_s) override {
    robot_.advance({command.left_radps, command.right_radps}, duration_s);
  }
  Pose2 pose() const override { return robot_.pose(); }
  double wheel_angle(int wheel) const override { return robot_.wheel_angle(wheel); }
  double encoder_angle(int wheel) const override { return robot_.wheel_angle(wheel); }
  double tilt_rad() const override { return robot_.tilt_rad(); }
  std::int64_t steps() const override { return robot_.steps(); }
  void set_pull(const Pull& pull) override { robot_.set_pull(pull); }
  void set_rolling_factor(int wheel, double factor) override { robot_.set_rolling_factor(wheel, factor); }
  void set_carpet_drift(double x, double y) override { robot_.set_carpet_drift(x, y); }

 private:
  bullet::BulletRobot robot_;
};

std::unique_ptr<Engine> build_bullet(const EngineSetup& setup, const EngineOptions& options) {
  bullet::BulletOptions o;
  o.step_s = options.numbers.at("step_s");
  o.solver = options.choices.at("solver");
  o.iterations = int(options.numbers.at("iterations"));
  o.wheel = options.choices.at("wheel");
  // The direct solver knows no spinning friction: with it a sphere could not have a patch.
  if (o.solver == "dantzig" && o.wheel == "sphere") o.wheel = "cylinder";
  o.sides = int(options.numbers.at("sides"));
  const std::string& friction = options.choices.at("friction");
  o.torsion_m = friction == "sliding" ? 0 : options.numbers.at("torsion_m");
  o.rolling_m = friction == "rolling" ? options.numbers.at("rolling_m") : 0;
  o.erp = options.numbers.at("erp");
  o.velocity_gain = options.numbers.at("velocity_gain");
  o.body_damping = std::stod(options.choices.at("body_damping"));
  return std::make_unique<Bullet>(setup, o);
}

std::map<std::string, std::string> expressed_in_bullet() {
  const std::string shape = "the wheel's shape and link", motor = "target and largest impulse of the joint's motor",
                    demand = "the driver asks for it; contacts slide at the friction pyramid", counts = "of the joint",
                    friction = "friction of the wheel's collider";
  return {
      {"wheel_radius_scale", shape},
      {"wheel_radius_difference", shape},
      {"wheelbase", shape},
      {"wear", shape},
      {"wheel_misalignment", "the wheel's link is turned"},
      {"wheel_eccentricity", "the shape stands off its joint"},
      {"load_shift", "mass, its place and its inertia"},
      {"motor_response", motor},
      {"over_acceleration", demand},
      {"fast_turning", demand},
      {"encoder_resolution", counts},
      {"encoder_sampling", counts},
      {"encoder_missed_counts", counts},
      {"encoder_latency", counts},
      {"tyre_compliance", "radius of the shape under the load at rest"},
      {"caster_swivel", "two joints, a motor at rest as dry bearing"},
      {"caster_drag", "friction of the ball's collider"},
      {"slippery_floor", friction},
      {"slippery_patch", friction + " at its place"},
      {"bump", "a cylinder on the floor"},
      {"floor_slope", "gravity along the floor"},
      {"carpet_drift", "the base is carried as wheels roll"},
      {"push", "a force on the base"},
      {"wheel_lift", "no friction at the wheel's place"},
  };
}

}  // namespace

EngineKind bullet_engine() {
  using Draw = EngineOption::Draw;
  EngineKind kind;
  kind.name = "bullet";
  kind.text = "Bullet's own multibody world (btMultiBodyDynamicsWorld), with its contacts and solvers";
  kind.options = {
      {"step_s", "s", Draw::log_uniform, 0.001, 1.0 / 240, {}, "fixed time step; 1/240 s is the default, 1 ms robots'"},
      {"solver", "", Draw::choice, 0, 0, {"dantzig", "sequential_impulse"}, "sequential impulses are the default"},
      {"iterations", "1", Draw::log_uniform, 10, 100, {}, "of sequential impulses; 10 and 50 are usual"},
      {"wheel",
       "",
       Draw::choice,
       0,
       0,
       {"cylinder", "sphere", "convex"},
       "shape; models have all (spheres with sequential impulses alone)"},
      {"sides", "1", Draw::log_uniform, 48, 128, {}, "of a convex wheel, as meshes have"},
      {"friction", "", Draw::choice, 0, 0, {"sliding", "spinning", "rolling"}, "what is added to the sliding friction"},
      {"torsion_m", "m", Draw::log_uniform, 0.0002, 0.002, {}, "spinning friction over the sliding one"},
      {"rolling_m", "m", Draw::log_uniform, 0.00001, 0.0001, {}, "rolling friction over the sliding one"},
      {"erp", "1", Draw::uniform, 0.1, 0.8, {}, "share of an overlap taken back in a step; 0.2 is the default"},
      {"velocity_gain", "1", Draw::uniform, 0.3, 1, {}, "of the joints' motors; 1 is the default"},
      {"body_damping", "", Draw::choice, 0, 0, {"0", "0.04"}, "of speed and turning, per second; 0.04 is the default"},
  };
  kind.allowed = {{"step_s", Bounds::between(0.0001, 0.02)},
                  {"iterations", Bounds::between(1, 10000)},
                  {"torsion_m", Bounds::between(0, 0.05)},
                  {"rolling_m", Bounds::between(0, 0.01)},
                  {"erp", Bounds::between(0, 1)},
                  {"velocity_gain", {0, 1, true}}};
  kind.expresses = expressed_in_bullet();
  kind.build = build_bullet;
  return kind;
}

}  // namespace umbsim::worlds

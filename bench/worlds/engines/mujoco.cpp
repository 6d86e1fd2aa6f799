// MuJoCo as an engine of the proving ground.
#include "bench/worlds/engines/kinds.h"
#include "bench/worlds/engines/mujoco/robot.h"

namespace umbsim::worlds {
namespace {

class Mujoco : public Engine {
 public:
  Mujoco(const EngineSetup& setup, const mujoco::MujocoOptions& options) : robot_(setup.rig, options, setup.X_WB) {}
  void advance(const WheelSpeeds& command, double duration_s) override {
    robot_.advance({command.left_radps, command.right_radps}, duration_s);
  }
  Pose2 pose() const override { return robot_.pose(); }
  double wheel_angle(int wheel) const override { return robot_.wheel_angle(wheel); }
  double encoder_angle(int wheel) const override { return robot_.encoder_angle(wheel); }
  double tilt_rad() const override { return robot_.tilt_rad(); }
  std::int64_t steps() const override { return robot_.steps(); }
  void set_pull(const Pull& pull) override { robot_.set_pull(pull); }
  void set_rolling_factor(int wheel, double factor) override { robot_.set_rolling_factor(wheel, factor); }
  void set_carpet_drift(double x, double y) override { robot_.set_carpet_drift(x, y); }

 private:
  mujoco::MujocoRobot robot_;
};

std::unique_ptr<Engine> build_mujoco(const EngineSetup& setup, const EngineOptions& options) {
  const auto number = [&](const char* name) { return options.numbers.at(name); };
  mujoco::MujocoOptions o;
  o.step_s = number("step_s");
  o.integrator = options.choices.at("integrator");
  o.cone = options.choices.at("cone");
  o.wheel = options.choices.at("wheel");
  o.condim = std::stoi(options.choices.at("condim"));
  o.torsion_m = number("torsion_m");
  o.rolling_m = number("rolling_m");
  o.impratio = number("impratio");
  o.impedance = number("impedance");
  o.contact_time_s = number("contact_time_steps") * o.step_s;
  o.contact_damping_ratio = number("contact_damping_ratio");
  o.servo_time_s = number("servo_time_s");
  o.armature_over_wheel = number("armature_over_wheel");
  o.joint_damping = number("joint_damping");
  o.tuned_kg = setup.tuned_kg;
  return std::make_unique<Mujoco>(setup, o);
}

std::map<std::string, std::string> expressed_in_mujoco() {
  const std::string geom = "the wheel's geom and body", servo = "set-point and force range of the velocity servo",
                    demand = "the driver asks for it; contacts slide at the friction cone",
                    counts = "of the shaft's joint", friction = "friction of the wheel's geom";
  return {
      {"wheel_radius_scale", geom},
      {"wheel_radius_difference", geom},
      {"wheelbase", geom},
      {"wear", geom},
      {"wheel_misalignment", "the wheel's body is turned"},
      {"wheel_eccentricity", "the geom stands off its joint"},
      {"load_shift", "mass, its place and its inertia"},
      {"backlash", "a second joint with limits between motor and wheel"},
      {"motor_response", servo},
      {"over_acceleration", demand},
      {"fast_turning", demand},
      {"encoder_resolution", counts},
      {"encoder_sampling", counts},
      {"encoder_missed_counts", counts},
      {"encoder_latency", counts},
      {"tyre_compliance", "radius of the geom under the load at rest"},
      {"contact_patch", "a cylinder or capsule that touches at two points, or torsional friction"},
      {"caster_swivel", "two joints with friction loss"},
      {"caster_drag", "friction of the ball's geom"},
      {"slippery_floor", friction},
      {"slippery_patch", friction + " at its place"},
      {"bump", "a capsule on the floor"},
      {"uneven_floor", "a plane under every support, tangent to the floor where it touches"},
      {"floor_slope", "gravity along the floor"},
      {"carpet_drift", "the base is carried as wheels roll"},
      {"push", "a force on the body"},
      {"wheel_lift", "no friction at the wheel's place"},
  };
}

}  // namespace

EngineKind mujoco_engine() {
  using Draw = EngineOption::Draw;
  EngineKind kind;
  kind.name = "mujoco";
  kind.text = "MuJoCo 2.2 (Todorov, Erez & Tassa 2012): soft contacts, velocity servos";
  kind.options = {
      {"step_s", "s", Draw::log_uniform, 0.002, 0.005, {}, "timestep; 2 ms is the default, 5 ms usual for speed"},
      {"integrator", "", Draw::choice, 0, 0, {"implicit", "Euler"}, "Euler is the default"},
      {"cone", "", Draw::choice, 0, 0, {"elliptic", "pyramidal"}, "pyramidal is the default"},
      {"wheel",
       "",
       Draw::choice,
       0,
       0,
       {"sphere", "ellipsoid", "cylinder", "capsule"},
       "geom; models of robots have all"},
      {"condim", "", Draw::choice, 0, 0, {"3", "4", "6"}, "friction of the wheels' contacts; 3 is the default"},
      {"torsion_m",
       "m",
       Draw::log_uniform,
       0.0002,
       0.002,
       {},
       "torsional friction over the sliding one (default 0.005)"},
      {"rolling_m",
       "m",
       Draw::log_uniform,
       0.00001,
       0.0001,
       {},
       "rolling friction over the sliding one (default 0.0001)"},
      {"impratio",
       "1",
       Draw::log_uniform,
       1,
       100,
       {},
       "stiffness of friction; 1 is the default, 10 and 100 against creep"},
      {"impedance", "1", Draw::uniform, 0.9, 0.99, {}, "solimp's first number; 0.9 is the default"},
      {"contact_time_steps",
       "1",
       Draw::log_uniform,
       2,
       10,
       {},
       "solref's time constant over the step; 10 is the default"},
      {"contact_damping_ratio", "1", Draw::uniform, 0.9, 1.5, {}, "solref's second number; 1 is the default"},
      {"servo_time_s", "s", Draw::log_uniform, 0.005, 0.03, {}, "the robot's inertia over the servo's gain kv"},
      {"armature_over_wheel", "1", Draw::log_uniform, 1, 10, {}, "armature over the wheel's inertia"},
      {"joint_damping", "1", Draw::log_uniform, 0.0001, 0.003, {}, "damping of the wheels' joints over kv"},
  };
  kind.allowed = {{"step_s", Bounds::between(0.0001, 0.02)},
                  {"torsion_m", Bounds::between(0, 0.05)},
                  {"rolling_m", Bounds::between(0, 0.01)},
                  {"impratio", Bounds::between(0.1, 1e6)},
                  {"impedance", Bounds::between(0.01, 0.9999)},
                  {"contact_time_steps", Bounds::between(2, 1000)},
                  {"contact_damping_ratio", Bounds::between(0.1, 100)},
                  {"servo_time_s", Bounds::between(0.001, 1)},
                  {"armature_over_wheel", Bounds::between(0, 1000)},
                  {"joint_damping", Bounds::between(0, 1)}};
  kind.expresses = expressed_in_mujoco();
  kind.build = build_mujoco;
  return kind;
}

}  // namespace umbsim::worlds

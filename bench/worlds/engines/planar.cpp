// The vehicle model of the plane as an engine of the proving ground.
#include "bench/worlds/engines/kinds.h"
#include "bench/worlds/engines/planar/robot.h"

namespace umbsim::worlds {
namespace {

class Planar : public Engine {
 public:
  Planar(const EngineSetup& setup, const planar::PlanarOptions& options) : robot_(setup.rig, options, setup.X_WB) {}
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
  planar::PlanarRobot robot_;
};

std::unique_ptr<Engine> build_planar(const EngineSetup& setup, const EngineOptions& options) {
  planar::PlanarOptions o;
  o.curve = options.choices.at("tyre") == "brush" ? planar::TyreLaw::Curve::brush : planar::TyreLaw::Curve::lugre;
  o.creep = options.numbers.at("creep");
  o.relaxation_over_radius = options.numbers.at("relaxation_over_radius");
  o.contact_damping_ratio = options.numbers.at("contact_damping_ratio");
  o.servo_time_s = options.numbers.at("servo_time_s");
  o.integral_time_s = options.numbers.at("integral_time_s");
  o.rotor_over_wheel = options.numbers.at("rotor_over_wheel");
  o.load_time_s = options.numbers.at("load_time_s");
  o.tuned_kg = setup.tuned_kg;
  return std::make_unique<Planar>(setup, o);
}

std::map<std::string, std::string> expressed_in_planar() {
  const std::string wheel = "the wheel's own radius or place", servo = "set-point and limit of the motor's control",
                    demand = "the driver asks for it; treads slide at the friction limit",
                    counts = "of the shaft's angle";
  return {
      {"wheel_radius_scale", wheel},
      {"wheel_radius_difference", wheel},
      {"wheelbase", wheel},
      {"wear", wheel},
      {"wheel_misalignment", "treads deflect across the toed wheel's heading"},
      {"wheel_eccentricity", "lever and height of the axle over the contact go round with the wheel"},
      {"load_shift", "mass, its place and its inertia"},
      {"backlash", "motor and wheel are two inertias with a play between them"},
      {"motor_response", servo},
      {"over_acceleration", demand},
      {"fast_turning", demand},
      {"encoder_resolution", counts},
      {"encoder_sampling", counts},
      {"encoder_missed_counts", counts},
      {"encoder_latency", counts},
      {"tyre_compliance", "radius under the load of the moment"},
      {"contact_patch", "strips across the width, dragged as the wheel turns on the spot"},
      {"tyre_creep", "slip stiffness of the treads"},
      {"caster_swivel", "a fork with inertia, dry bearing and a tread that pulls across"},
      {"caster_drag", "a sliding tread under the ball"},
      {"slippery_floor", "friction limit of the treads"},
      {"slippery_patch", "friction limit at the wheel's place"},
      {"bump", "the wheel's centre climbs on an arc; the load pushes it back"},
      {"uneven_floor", "the wheel's centre goes the way of the floor; pitch turns the encoders"},
      {"floor_slope", "gravity along the floor, and loads"},
      {"carpet_drift", "the floor under a tread moves as it rolls"},
      {"push", "a force on the body"},
      {"wheel_lift", "no friction at the wheel's place"},
  };
}

}  // namespace

EngineKind planar_engine() {
  using Draw = EngineOption::Draw;
  EngineKind kind;
  kind.name = "planar";
  kind.text =
      "a vehicle model of the plane: one rigid body, loads by statics, brush or LuGre tyres (Pacejka 2012, ch. 3 and "
      "7)";
  kind.options = {
      {"tyre", "", Draw::choice, 0, 0, {"brush", "lugre"}, "how friction goes over into sliding"},
      {"creep", "1", Draw::log_uniform, 0.003, 0.015, {}, "slip over force by load, of hard rubber and polyurethane"},
      {"relaxation_over_radius",
       "1",
       Draw::uniform,
       0.2,
       0.7,
       {},
       "way in which a tyre's force builds up (Pacejka, ch. 7)"},
      {"contact_damping_ratio", "1", Draw::uniform, 0.2, 0.5, {}, "of the robot on its standing tyres"},
      {"servo_time_s", "s", Draw::log_uniform, 0.004, 0.02, {}, "of the motors' speed control"},
      {"integral_time_s", "s", Draw::log_uniform, 0.05, 0.3, {}, "of its integral part"},
      {"rotor_over_wheel", "1", Draw::log_uniform, 1, 6, {}, "inertia of motor and gear over the wheel's"},
      {"load_time_s", "s", Draw::log_uniform, 0.003, 0.015, {}, "in which wheel loads follow accelerations"},
  };
  kind.expresses = expressed_in_planar();
  kind.build = build_planar;
  return kind;
}

}  // namespace umbsim::worlds

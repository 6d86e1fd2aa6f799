#include "bench/speed/engine.h"

namespace umbsim::bench {
namespace {

class Ours : public Engine {
 public:
  explicit Ours(const Setup& s) : world_(s.robot, Drivetrain{s.torque_limit_nm}, s.floor, options(s)) {}
  void place() override { world_.place({}); }
  void command(double left_radps, double right_radps) override { world_.command(left_radps, right_radps); }
  void advance(double duration_s) override { world_.advance(duration_s); }
  Pose2 pose() const override { return world_.pose(); }
  double wheel_angle(int wheel) const override { return world_.wheel_angle(wheel); }
  std::int64_t steps() const override { return world_.cost().steps; }

 private:
  static PhysicsOptions options(const Setup& s) {
    PhysicsOptions o;
    o.step_s = s.step_s;
    o.fine_step_s = s.fine_step_s;
    return o;
  }
  World world_;
};

}  // namespace

std::unique_ptr<Engine> make_ours(const Setup& setup) { return std::make_unique<Ours>(setup); }

}  // namespace umbsim::bench

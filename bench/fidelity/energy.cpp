#include "bench/fidelity/energy.h"

#include <cmath>

#include <fmt/format.h>

#include "bench/fidelity/table.h"

namespace umbsim::fidelity {
namespace {

constexpr double kPushed_s = 0.6;
constexpr double kCoast_s = 5;
constexpr double kSlippery = 0.2;
constexpr double kRippleRms_m = 0.0005, kRippleLength_m = 0.3;

const char* const kCoastText = R"(## 3. Energy

**Coasting.** Free wheels roll without loss: a robot that is pushed keeps kinetic plus potential energy. Pushed to about
0.5 m/s and left for 5 s; in the curve it is pushed beside the centre of mass. Ridges: waves straight across the path,
0.5 mm rms, 0.31 m long. Uneven: random ripples of 0.5 mm rms and 0.3 m. Energy lost (+) or gained (-), as a share of the
kinetic energy after the push.

On the flat floor and on ridges, what is lost or gained is the step's, in proportion to its length. On the uneven floor
a part remains however small the step, and shrinks with the friction: one wheel stands higher than the other, the stiff
axle leans, and the track on the floor gets shorter by b (1 - cos of the lean). Two thin hard wheels that cannot give
sideways must scrub. That is a loss of the modelled robot, not of the method.

)";

const char* const kBrakeText =
    R"(**Braking.** Locked wheels that slide to a stop dissipate μ N_w d, with N_w = m g (x_b - x_c) / (x_b + μ h) (chapter 1, on
the level). **Climbing.** From rest to rest up a slope the robot gains m g d sin α, d = R φ. Ratio of the measured energy
to this, minus one. In one step the force acts along the distance driven with the step's final speed, so a brake loses
μ N_w d + m (Δv)² / 2 per step: again an error in proportion to the step.

)";

// The way the centre of mass lies from the axle (the other way a robot with free wheels swings round), and beside it.
std::vector<Push> pushes(const RobotModel& robot, bool beside) {
  Push push;
  push.time_s = 0.05;
  push.duration_s = 0.5;
  push.impulse_ns = 0.5 * robot.total_mass_kg();
  push.direction_rad = body_of(robot).com_m.x() > 0 ? 0 : M_PI;
  std::vector<Push> all{push};
  if (!beside) return all;
  push.direction_rad = M_PI / 2;
  push.impulse_ns *= 0.3;
  push.ahead_m = 2 * body_of(robot).com_m.x();
  all.push_back(push);
  return all;
}

}  // namespace

Coasting coast(const RobotModel& robot, Ground ground, const PhysicsOptions& options) {
  Floor floor;
  const bool uneven = ground == Ground::uneven || ground == Ground::uneven_slippery;
  if (uneven) floor.ripples = random_ripples(kRippleRms_m, kRippleLength_m, 1, 0);
  if (ground == Ground::ridges) floor.ripples = {{std::sqrt(2.0) * kRippleRms_m, 20, 0, 0.3}};
  if (ground == Ground::uneven_slippery) floor.friction = kSlippery;
  World world(robot, {0}, floor, options, pushes(robot, ground == Ground::flat_curve));
  const Body b = body_of(robot);
  world.place({});
  const double rest_j = b.mass_kg * kG_mps2 * b.com_m.z();  // on the floor's mean height
  const double placed_j = world.energy();
  hold(world, 0, 0, kPushed_s);
  const double reference_j = floor.ripples.empty() ? placed_j : rest_j;
  const double moving_j = world.energy() - reference_j;
  const Pose2 start = world.pose();
  hold(world, 0, 0, kCoast_s);
  const Pose2 end = world.pose();
  return {moving_j, (world.energy() - reference_j) / moving_j, std::hypot(end.x_m - start.x_m, end.y_m - start.y_m)};
}

double braking_ratio(const RobotModel& robot, const PhysicsOptions& options) {
  Floor floor;
  floor.friction = kSlippery;
  Push push;
  push.time_s = 0.05;
  push.duration_s = 0.1;
  push.impulse_ns = 1.5 * robot.total_mass_kg();
  World world(robot, {200}, floor, options, {push});
  world.place({});
  hold(world, 0, 0, 0.2);
  const double moving_j = world.energy();
  const double start_m = world.pose().x_m;
  hold(world, 0, 0, 3);
  const Body b = body_of(robot);
  const double load_n = b.mass_kg * kG_mps2 * (b.ball_x_m - b.com_m.x()) / (b.ball_x_m + kSlippery * b.com_m.z());
  return (moving_j - world.energy()) / (kSlippery * load_n * (world.pose().x_m - start_m));
}

double climbing_ratio(const RobotModel& robot, double slope_rad, const PhysicsOptions& options) {
  Floor floor;
  floor.slope_rad = slope_rad;
  floor.downhill_rad = M_PI;  // the robot heads uphill
  World world(robot, {20}, floor, options);
  world.place({});
  const double start_j = world.energy();
  trip(world, 0.3 / robot.wheels[0].radius_m, 0.3 / robot.wheels[0].radius_m, 3);
  const double distance_m = robot.wheels[0].radius_m * (world.wheel_angle(0) + world.wheel_angle(1)) / 2;
  return (world.energy() - start_j) / (robot.total_mass_kg() * kG_mps2 * std::sin(slope_rad) * distance_m);
}

std::string energy_chapter(Grid grid) {
  Table coasting({"robot", "contacts, step", "kinetic", "flat, straight", "flat, curve", "ridges",
                  "uneven, μ 0.9", "uneven, μ 0.2"});
  Table forces({"robot", "contacts, step", "braking", "climbing 2°", "climbing 5°"});
  PhysicsOptions fine;
  fine.step_s = 0.001;
  const auto loss = [](const Coasting& c) { return fmt::format("{:+.1e}", 1 - c.kept); };
  const auto ratio = [](double r) { return fmt::format("{:+.1e}", r - 1); };
  for (const auto& [name, robot] : {std::pair{"LabMate", labmate()}, std::pair{"OptiOdom", optiodom()}}) {
    std::vector<std::pair<const char*, PhysicsOptions>> settings{
        {"default, 20 ms", {}}, {"default, 1 ms", fine}, {"rigid, 20 ms", rigid()}, {"rigid, 1 ms", rigid(0.001)}};
    if (grid == Grid::full) settings.push_back({"rigid, 0.1 ms", rigid(0.0001)});
    for (const auto& [text, options] : settings) {
      const Coasting straight = coast(robot, Ground::flat_straight, options);
      coasting.row({name, text, fmt::format("{:.2f} J", straight.kinetic_j), loss(straight),
                    loss(coast(robot, Ground::flat_curve, options)), loss(coast(robot, Ground::ridges, options)),
                    loss(coast(robot, Ground::uneven, options)), loss(coast(robot, Ground::uneven_slippery, options))});
      forces.row({name, text, ratio(braking_ratio(robot, options)), ratio(climbing_ratio(robot, 0.035, options)),
                  ratio(climbing_ratio(robot, 0.087, options))});
    }
  }
  return kCoastText + coasting.text() + kBrakeText + forces.text();
}

}  // namespace umbsim::fidelity

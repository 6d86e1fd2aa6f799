#include "experiment/robot/understood.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiment/drive/drive_run.h"

namespace umbsim {
namespace {

// A support with less than this share of the weight is as good as in the air.
constexpr double kHardlyLoaded = 0.02;
// A robot should stand this many times the acceleration that the course asks for.
constexpr double kReserve = 1.1;

double larger(double share) { return share > 0 ? share : 0; }

// Loads per acceleration forwards: the moment m h + sum J / R about the axle, taken up in proportion to the stiffness
// of the supports, which is that of their load where nothing else is known.
std::vector<double> load_shift(const UnderstoodRobot& u) {
  const RobotModel& r = u.robot;
  double moment = u.body.mass_kg * (u.body.com_m.z() + r.wheels[0].radius_m);
  for (const Wheel& w : r.wheels) moment += w.spin_inertia_kgm2 / w.radius_m;
  std::vector<double> x, k;
  const auto add = [&](double place, const Suspension& s, double load_n) {
    x.push_back(place);
    k.push_back(s.sprung() ? s.stiffness_npm : load_n / 1e-4);
  };
  for (int i = 0; i < 2; ++i) add(r.wheels[i].centre_m.x(), r.wheels[i].suspension, u.loads_n[i]);
  for (std::size_t i = 0; i < r.casters.size(); ++i)
    add(r.casters[i].centre_m.x(), r.casters[i].suspension, u.loads_n[i + 2]);
  double sum = 0, first = 0, second = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += k[i], first += k[i] * x[i];
  for (std::size_t i = 0; i < x.size(); ++i) second += k[i] * std::pow(x[i] - first / sum, 2);
  std::vector<double> shift;
  for (std::size_t i = 0; i < x.size(); ++i) shift.push_back(-moment * k[i] * (x[i] - first / sum) / second);
  return shift;
}

// mu (N + a N') = m a for a > 0 forwards, and backwards with -N'.
AccelerationLimits slip_limits(const UnderstoodRobot& u) {
  const std::vector<double> shift = load_shift(u);
  const double mass_kg = u.body.mass_kg, grip_n = u.friction * (u.loads_n[0] + u.loads_n[1]);
  const double more = u.friction * (shift[0] + shift[1]);
  // The wheels never carry more than all of it.
  const double most = u.friction * std::accumulate(u.loads_n.begin(), u.loads_n.end(), 0.0) / mass_kg;
  const auto limit = [&](double gain) { return mass_kg > gain ? std::min(most, grip_n / (mass_kg - gain)) : most; };
  // Turning on the spot both wheels push by mu N at half the track, against the inertia about the axle's middle.
  const double yaw = u.body.inertia_kgm2(2, 2) + mass_kg * u.body.com_m.head<2>().squaredNorm();
  const double weaker_n = u.friction * std::min(u.loads_n[0], u.loads_n[1]);
  return {limit(more), limit(-more), weaker_n * u.robot.wheelbase_m() / yaw};
}

AccelerationLimits tip_limits(const Standing& s) {
  FloorMotion ahead, back, turn;
  ahead.forward_mps2 = 1, back.forward_mps2 = -1, turn.turning_radps2 = 1;
  FloorMotion other = turn;
  other.turning_radps2 = -1;
  return {larger(s.largest_share(ahead)), larger(s.largest_share(back)),
          larger(std::min(s.largest_share(turn), s.largest_share(other)))};
}

void find_wrong(UnderstoodRobot& u, const Course& course) {
  double weight_n = 0;
  for (const double load : u.loads_n) weight_n += load;
  for (int i = 0; i < 2; ++i) {
    if (u.loads_n[i] > kHardlyLoaded * weight_n) continue;
    u.wrong.push_back(fmt::format("the {} drive wheel carries {:.1f} N of {:.1f} N: it will slip",
                                  i == 0 ? "left" : "right", u.loads_n[i], weight_n));
  }
  const auto judge = [&](double limit, double asked, const char* what, const char* unit, const char* key) {
    if (limit >= kReserve * asked) return;
    u.wrong.push_back(fmt::format("{} above {:.3g} {}, and a scenario asks for {:g} by default: lower {}", what, limit,
                                  unit, asked, key));
  };
  const double a = course.linear_acceleration_mps2;
  judge(std::min(u.tips.forward_mps2, u.tips.backward_mps2), a, "it tips over", "m/s^2",
        "course.linear_acceleration_mps2");
  judge(std::min(u.slips.forward_mps2, u.slips.backward_mps2), a, "its wheels slip", "m/s^2",
        "course.linear_acceleration_mps2");
  judge(std::min(u.tips.turning_radps2, u.slips.turning_radps2), course.angular_acceleration_radps2,
        "turning on the spot it tips over or slips", "rad/s^2", "course.angular_acceleration_radps2");
}

}  // namespace

UnderstoodRobot understand_robot(const Scenario& scenario) {
  UnderstoodRobot u;
  u.robot = load_scenario_robot(scenario, &u.remarks);
  u.body = whole_body(u.robot);
  u.friction = scenario.floor_friction;
  Floor floor;
  floor.friction = scenario.floor_friction;
  World world(u.robot, Drivetrain(torque_limit(scenario, u.robot)), floor, scenario.physics);
  world.place({});
  const SupportLoads& loads = world.loads();
  u.loads_n.assign(loads.wheel_n.begin(), loads.wheel_n.end());
  u.loads_n.insert(u.loads_n.end(), loads.caster_n.begin(), loads.caster_n.begin() + long(u.robot.casters.size()));
  u.tips = tip_limits(world.standing());
  u.slips = slip_limits(u);
  find_wrong(u, scenario.course);
  return u;
}

}  // namespace umbsim

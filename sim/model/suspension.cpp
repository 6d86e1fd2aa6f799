#include "sim/model/suspension.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/model/inertia.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr double kLeastTravel_m = 0.020;  // its half takes up a cable of 10 mm
constexpr double kTravelPerRms = 8;
constexpr double kLeanReserve = 4;
// A support that carries less than this share of the weight has the spring of one that carries it.
constexpr double kLeastLoadShare = 0.02;

Inertial disc(double mass_kg, const Vector3d& centre_m, double spin_kgm2, double transverse_kgm2) {
  return {mass_kg, centre_m, Vector3d(transverse_kgm2, spin_kgm2, transverse_kgm2).asDiagonal()};
}

std::vector<Vector3d> support_places(const RobotModel& robot) {
  std::vector<Vector3d> places;
  for (const Wheel& w : robot.wheels) places.push_back(w.centre_m);
  for (const Caster& c : robot.casters) places.push_back(c.centre_m);
  return places;
}

// Smallest loads, in the sense of least squares, of the supports in `used` that balance the weight.
Eigen::VectorXd balance(const std::vector<Vector3d>& places, const std::vector<bool>& used, double weight_n,
                        const Vector3d& com_m) {
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(3, Eigen::Index(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (used[i]) moments.col(Eigen::Index(i)) << 1, places[i].x(), places[i].y();
  }
  return moments.completeOrthogonalDecomposition().solve(weight_n * Vector3d(1, com_m.x(), com_m.y()));
}

bool balances(const std::vector<Vector3d>& places, const Eigen::VectorXd& load, double weight_n,
              const Vector3d& com_m) {
  Vector3d off(load.sum() - weight_n, -weight_n * com_m.x(), -weight_n * com_m.y());
  for (std::size_t i = 0; i < places.size(); ++i) off.tail<2>() += load[Eigen::Index(i)] * places[i].head<2>();
  return off.norm() < 1e-6 * weight_n;
}

// What leaning takes of a robot on springs is weight times height; what they give is the sum of F d^2 / sink.
double largest_sink_m(const RobotModel& robot, const std::vector<double>& loads) {
  const std::vector<Vector3d> places = support_places(robot);
  const Inertial body = whole_body(robot);
  const double height_m = body.com_m.z() + robot.wheels[0].radius_m;
  double weight_n = 0, sink_m = robot.wheels[0].radius_m / 2;
  for (const double load : loads) weight_n += load;
  for (int axis = 0; axis < 2; ++axis) {
    double stiff = 0;
    for (std::size_t i = 0; i < places.size(); ++i) stiff += loads[i] * std::pow(places[i][axis] - body.com_m[axis], 2);
    if (height_m > 0) sink_m = std::min(sink_m, stiff / (kLeanReserve * weight_n * height_m));
  }
  return sink_m;
}

struct Springs {
  const SuspensionChoice& choice;
  double gravity_mps2;
  double default_travel_m;  // 0: rigid
  double weight_n;

  Suspension of(const std::optional<double>& travel_m, const Slide& slide, double load_n, std::string& from) const {
    Suspension s;
    if (travel_m) {
      s = even(*travel_m, load_n);
      from = "robot.suspension";
    } else if (!slide.joint.empty()) {
      s = of_slide(slide, load_n);
      from = "joint " + slide.joint;
    } else {
      s = even(default_travel_m, load_n);
      from = "the default for more than three supports";
    }
    s.rest_load_n = load_n;
    const double mass_kg = std::max(load_n, kLeastLoadShare * weight_n) / gravity_mps2;
    s.damping_nspm = 2 * choice.damping_ratio * std::sqrt(s.stiffness_npm * mass_kg);
    return s;
  }

  Suspension even(double travel_m, double load_n) const {
    if (travel_m <= 0) return {};
    const double stiffness = 2 * std::max(load_n, kLeastLoadShare * weight_n) / travel_m;
    return {stiffness, 0, load_n, travel_m / 2, load_n / stiffness};
  }

  // A spring that would lift the robot off where its URDF puts it is taken as one that holds it there.
  Suspension of_slide(const Slide& slide, double load_n) const {
    const double carried_n = std::max(load_n, kLeastLoadShare * weight_n);
    Suspension s{slide.stiffness_npm, 0, load_n, slide.up_m, slide.down_m};
    if (s.down_m == 0) s.up_m = s.down_m = slide.up_m / 2;  // it does not stand hanging
    if (s.stiffness_npm == 0)
      s.stiffness_npm = carried_n / s.down_m;
    else if (slide.preload_n > 0)
      s.preload_n = std::min(slide.preload_n, load_n);
    return s;
  }
};

void say(std::vector<Remark>* remarks, const std::string& what, const Suspension& s, const std::string& from) {
  if (!remarks || !s.sprung()) return;
  const bool guessed = from.starts_with("the default");
  remarks->push_back(
      {guessed ? Remark::Kind::assumed : Remark::Kind::understood,
       fmt::format("{} on a spring of {:.3g} N/m, {:.1f} mm up and {:.1f} mm down, {:.3g} N at rest, by {}", what,
                   s.stiffness_npm, 1e3 * s.up_m, 1e3 * s.down_m, s.rest_load_n, from)});
}

}  // namespace

Inertial whole_body(const RobotModel& robot) {
  Inertial body = robot.base;
  for (const Wheel& w : robot.wheels) {
    body = lumped(body, disc(w.mass_kg, w.centre_m, w.spin_inertia_kgm2, w.transverse_inertia_kgm2));
  }
  for (const Caster& c : robot.casters) {
    body = lumped(body, c.fork);
    body = lumped(body, disc(c.wheel_mass_kg, c.centre_m, c.wheel_spin_inertia_kgm2, c.wheel_transverse_inertia_kgm2));
  }
  return body;
}

double default_travel_m(const RobotModel& robot, double floor_rms_m) {
  const std::vector<double> loads = rest_loads(robot, 1);
  if (loads.size() < 4) return 0;
  const double wanted_m = std::max(kLeastTravel_m, kTravelPerRms * floor_rms_m);
  return std::min(wanted_m, 2 * largest_sink_m(robot, loads));
}

std::vector<double> rest_loads(const RobotModel& robot, double gravity_mps2) {
  const std::vector<Vector3d> places = support_places(robot);
  const Inertial body = whole_body(robot);
  const double weight_n = body.mass_kg * gravity_mps2;
  std::vector<bool> used(places.size(), true);
  for (std::size_t left = places.size(); left >= 3; --left) {
    const Eigen::VectorXd load = balance(places, used, weight_n, body.com_m);
    if (!balances(places, load, weight_n, body.com_m)) return {};
    Eigen::Index least = 0;
    if (load.minCoeff(&least) >= -1e-9 * weight_n) {
      std::vector<double> loads(load.data(), load.data() + load.size());
      for (double& l : loads) l = std::max(0.0, l);
      return loads;
    }
    used[std::size_t(least)] = false;
  }
  return {};
}

void suspend(RobotModel& robot, const SuspensionChoice& choice, double gravity_mps2, double floor_rms_m,
             std::vector<Remark>* remarks) {
  const std::vector<double> loads = rest_loads(robot, gravity_mps2);
  if (loads.empty()) return;
  const Springs springs{choice, gravity_mps2, default_travel_m(robot, floor_rms_m),
                        whole_body(robot).mass_kg * gravity_mps2};
  std::vector<Suspension*> all;
  std::string from;
  const auto set = [&](Suspension& s, const std::optional<double>& travel_m, const Slide& slide,
                       const std::string& what) {
    s = springs.of(travel_m, slide, loads[all.size()], from);
    all.push_back(&s);
    say(remarks, what, s, from);
  };
  for (Wheel& w : robot.wheels) set(w.suspension, choice.wheel_travel_m, w.slide, "drive wheel '" + w.joint + "'");
  for (Caster& c : robot.casters) set(c.suspension, choice.caster_travel_m, c.slide, "caster '" + c.link + "'");
  if (std::none_of(all.begin(), all.end(), [](const Suspension* s) { return s->sprung(); })) {
    for (Suspension* s : all) *s = {};
  }
}

}  // namespace umbsim

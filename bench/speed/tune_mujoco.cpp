// Tries MuJoCo's settings on the flat square and on the cable, and prints the best: docs/bench.md documents the choice.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/speed/tasks.h"
#include "core/progress.h"

namespace {

using namespace umbsim;
using namespace umbsim::bench;

struct Trial {
  MujocoOptions options;
  double step_s;
  Outcome outcome;
};

constexpr double kStrict_m = 1e-4;  // the bar of the comparison
constexpr std::size_t kShown = 12;

std::vector<MujocoOptions> servo_variants(const MujocoOptions& base) {
  std::vector<MujocoOptions> all;
  for (const auto& [servo, gain] : {std::pair{"actuator", 5.0}, {"actuator", 20.0}, {"damping", 5.0}, {"damping", 20.0},
                                    {"damping", 100.0}, {"damping", 400.0}}) {
    MujocoOptions o = base;
    o.servo = servo;
    o.servo_gain = gain;
    all.push_back(o);
  }
  return all;
}

std::vector<MujocoOptions> solver_variants() {
  std::vector<MujocoOptions> all;
  for (const char* integrator : {"Euler", "implicit", "RK4"})
    for (const char* cone : {"pyramidal", "elliptic"})
      for (const char* wheel : {"ellipsoid", "sphere", "cylinder"})
        for (const double impratio : {1.0, 100.0, 10000.0})
          for (const int noslip : {0, 5}) {
            MujocoOptions o;
            o.integrator = integrator;
            o.cone = cone;
            o.wheel = wheel;
            o.impratio = impratio;
            o.noslip_iterations = noslip;
            all.push_back(o);
          }
  return all;
}

// An unstable setting: MuJoCo sets the robot back to the start, again and again.
Trial checked(Trial t) {
  if (!t.outcome.arrived || !std::isfinite(t.outcome.error)) t.outcome.error = 1e9;
  return t;
}

Trial try_square(const RobotModel& robot, MujocoOptions o, double step_s) {
  o.contact_time_s = 2 * step_s;
  const auto engine = make_mujoco(flat(robot, step_s), o);
  return checked({o, step_s, drive_square(*engine, robot)});
}

Trial try_cable(const RobotModel& robot, const MujocoOptions& o, double step_s) {
  const auto engine = make_mujoco(with_cable(robot, step_s), o);
  return checked({o, step_s, cross_cable(*engine, robot)});
}

std::vector<Trial> squares(const RobotModel& robot) {
  constexpr double kSteps_s[] = {0.01, 0.02};
  const std::vector<MujocoOptions> solvers = solver_variants();
  Progress progress("square", int(solvers.size() * 6 * std::size(kSteps_s)));
  std::vector<Trial> trials;
  for (const MujocoOptions& solver : solvers)
    for (const MujocoOptions& o : servo_variants(solver))
      for (const double step_s : kSteps_s) {
        trials.push_back(try_square(robot, o, step_s));
        progress.step();
      }
  return trials;
}

std::vector<Trial> cables(const RobotModel& robot) {
  constexpr double kSteps_s[] = {0.0005, 0.001, 0.002};
  constexpr double kTimes_s[] = {0.004, 0.01, 0.02};
  constexpr double kDamping[] = {1, 4};
  const std::vector<MujocoOptions> solvers = solver_variants();
  Progress progress("cable", int(solvers.size() * std::size(kSteps_s) * std::size(kTimes_s) * std::size(kDamping)));
  std::vector<Trial> trials;
  for (const MujocoOptions& solver : solvers)
    for (const double step_s : kSteps_s)
      for (const double time_s : kTimes_s)
        for (const double damping : kDamping) {
          progress.step();
          if (solver.integrator == "RK4") continue;  // four times the cost, and no better on a blow
          MujocoOptions o = solver;
          o.contact_time_s = time_s;
          o.contact_damping_ratio = damping;
          trials.push_back(try_cable(robot, o, step_s));
        }
  return trials;
}

void print_header(const char* what, const char* error) {
  fmt::print("\n{}\n{:<9}{:<10}{:<10}{:<9}{:>6}{:>9}{:>6}{:>9}{:>7}{:>9}{:>11}{:>10}\n", what, "integr.", "cone",
             "wheel", "servo", "gain", "solref", "damp", "impratio", "noslip", "step ms", error, "sim s/s");
}

void print(const Trial& t, double error) {
  const MujocoOptions& o = t.options;
  fmt::print("{:<9}{:<10}{:<10}{:<9}{:>6}{:>9}{:>6}{:>9}{:>7}{:>9.1f}{:>11.4f}{:>10.0f}\n", o.integrator, o.cone,
             o.wheel, o.servo, o.servo_gain, o.contact_time_s, o.contact_damping_ratio, o.impratio,
             o.noslip_iterations, 1e3 * t.step_s, error, t.outcome.speed());
}

bool sound(const Trial& t) { return t.outcome.error < 1e9; }

void report_squares(std::vector<Trial> trials) {
  std::sort(trials.begin(), trials.end(),
            [](const Trial& a, const Trial& b) { return a.outcome.speed() > b.outcome.speed(); });
  for (const double step_s : {0.01, 0.02}) {
    print_header(fmt::format("Square, {} ms: the most accurate", 1e3 * step_s).c_str(), "error mm");
    std::vector<Trial> of_step;
    for (const Trial& t : trials) {
      if (t.step_s == step_s && sound(t)) of_step.push_back(t);
    }
    std::stable_sort(of_step.begin(), of_step.end(),
                     [](const Trial& a, const Trial& b) { return a.outcome.error < b.outcome.error; });
    for (std::size_t i = 0; i < std::min(kShown, of_step.size()); ++i)
      print(of_step[i], 1e3 * of_step[i].outcome.error);
  }
  print_header("Square: the fastest within 0.1 mm", "error mm");
  std::size_t shown = 0;
  for (const Trial& t : trials) {
    if (t.outcome.error <= kStrict_m && shown++ < kShown) print(t, 1e3 * t.outcome.error);
  }
}

void report_cables(std::vector<Trial> trials) {
  const auto off = [](const Trial& t) { return std::abs(t.outcome.error - 1); };
  std::sort(trials.begin(), trials.end(), [&](const Trial& a, const Trial& b) { return off(a) < off(b); });
  for (const double step_s : {0.0005, 0.001, 0.002}) {
    print_header(fmt::format("10 mm cable, {} ms: nearest to the closed form", 1e3 * step_s).c_str(), "ratio");
    std::size_t shown = 0;
    for (const Trial& t : trials) {
      if (t.step_s == step_s && shown++ < kShown) print(t, t.outcome.error);
    }
  }
}

}  // namespace

int main() {
  const RobotModel robot = load_robot(UMBSIM_ROBOTS_DIR "/labmate.urdf");
  report_squares(squares(robot));
  std::fflush(stdout);
  report_cables(cables(robot));
}

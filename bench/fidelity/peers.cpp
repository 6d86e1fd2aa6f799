#include "bench/fidelity/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/fidelity/robots.h"
#include "bench/fidelity/table.h"
#include "bench/speed/tasks.h"

namespace umbsim::fidelity {
namespace {

using bench::Engine;
using bench::Outcome;
using bench::Setup;

const char* const kText = R"(## 7. MuJoCo, run by run

The LabMate in both engines, driven by the same commands. MuJoCo's settings are those of `bench/speed/engine.h`, the best found
([bench.md](bench.md)): Euler with implicit damping; on the floor spheres, impratio 10 000 and a contact time constant of two steps, on the cable
cylinders, impratio 1, 4 ms and four times critical damping.
Each engine's end pose is compared with exact kinematics of its own wheel angles (for the cable: plus the closed form's
turn), and with umbsim's end pose. In the latter, MuJoCo's motors count too: its velocity servo follows a command with
a lag, umbsim's motors follow exactly within their torque.

)";

struct EndPose {
  Pose2 X_WB;
  Pose2 off;  ///< from exact kinematics, in the frame of the expected end
};

struct Job {
  const char* name;
  double left_mps;
  double right_mps;
  double seconds;
  bool cable;
};
constexpr Job kJobs[] = {{"straight, 2 m", 0.2, 0.2, 9.0, false},
                         {"on the spot, 1 turn", -0.1, 0.1, 9.68, false},
                         {"arc", 0.15, 0.25, 9.0, false},
                         {"cable, right wheel", 0.2, 0.2, 6.0, true}};

// Ramps of a second, a plateau, and standstill. Odometry on exact wheel angles.
EndPose drive_job(Engine& engine, const RobotModel& robot, const Job& job) {
  const double R = robot.wheels[0].radius_m, b = robot.wheelbase_m();
  engine.place();
  const Pose2 start = engine.pose();
  Pose2 X_OB;
  double left = engine.wheel_angle(0), right = engine.wheel_angle(1);
  const int ramp = 50, plateau = int(std::lround(job.seconds / 0.02)), rest = 50;
  for (int k = 1; k <= 2 * ramp + plateau + rest; ++k) {
    const double part = std::clamp(std::min(k, 2 * ramp + plateau - k) / double(ramp), 0.0, 1.0);
    engine.command(part * job.left_mps / R, part * job.right_mps / R);
    engine.advance(0.02);
    const double dl = engine.wheel_angle(0) - left, dr = engine.wheel_angle(1) - right;
    X_OB = X_OB * arc(R * (dl + dr) / 2, R * (dr - dl) / b);
    left += dl;
    right += dr;
  }
  const Pose2 X_WB = inverse(start) * engine.pose();
  Pose2 off = inverse(X_OB) * X_WB;
  if (job.cable) off.theta_rad += bench::cable_heading_rad(R, b, bench::kCable_m);
  return {X_WB, off};
}

std::unique_ptr<Engine> mujoco(const Setup& setup) {
  const bool cable = !setup.floor.cables.empty();
  return bench::make_mujoco(setup, cable ? bench::mujoco_for_cable() : bench::mujoco_for_square(setup.step_s));
}

struct Contender {
  const char* name;
  std::unique_ptr<Engine> (*make)(const Setup&);
  double step_s;
  double cable_step_s;
};
constexpr Contender kContenders[] = {{"umbsim", bench::make_ours, 0.020, 0.001},
                                     {"MuJoCo", mujoco, 0.002, 0.002},
                                     {"MuJoCo", mujoco, 0.0005, 0.0005},
                                     {"MuJoCo", mujoco, 0.0002, 0.0002}};

std::string pose_text(double x_m, double y_m, double theta_rad) {
  return fmt::format("{:+.3f}, {:+.3f} mm, {:+.4f}°", 1000 * x_m, 1000 * y_m, degrees(theta_rad));
}

std::string job_rows(const RobotModel& robot, const Job& job, Table& table) {
  Pose2 ours;
  for (const Contender& c : kContenders) {
    const double step_s = job.cable ? c.cable_step_s : c.step_s;
    const auto engine = c.make(job.cable ? bench::with_cable(robot, step_s) : bench::flat(robot, step_s));
    const EndPose end = drive_job(*engine, robot, job);
    const bool first = &c == &kContenders[0];
    if (first) ours = end.X_WB;
    const Pose2 apart = inverse(ours) * end.X_WB;
    // The cable bends the path: only the heading has a closed form.
    const std::string off = job.cable ? fmt::format("{:+.4f}°", degrees(end.off.theta_rad))
                                      : pose_text(end.off.x_m, end.off.y_m, end.off.theta_rad);
    table.row({job.name, c.name, fmt::format("{} ms", 1000 * step_s), off,
               first ? "" : pose_text(apart.x_m, apart.y_m, apart.theta_rad)});
  }
  return "";
}

void square_rows(const RobotModel& robot, Table& table) {
  Pose2 ours;
  for (const Contender& c : kContenders) {
    const auto engine = c.make(bench::flat(robot, c.step_s));
    const Outcome out = bench::drive_square(*engine, robot);
    const bool first = &c == &kContenders[0];
    if (first) ours = out.return_error;
    const Pose2& e = out.return_error;
    table.row({"square, 4 m, on odometry", c.name, fmt::format("{} ms", 1000 * c.step_s),
               pose_text(e.x_m, e.y_m, e.theta_rad),
               first ? "" : pose_text(e.x_m - ours.x_m, e.y_m - ours.y_m, e.theta_rad - ours.theta_rad)});
  }
}

}  // namespace

std::string peers_chapter() {
  const RobotModel robot = labmate();
  Table table({"drive", "engine", "step", "off exact kinematics: x, y, heading", "off umbsim"});
  square_rows(robot, table);
  for (const Job& job : kJobs) job_rows(robot, job, table);
  return kText + table.text();
}

}  // namespace umbsim::fidelity

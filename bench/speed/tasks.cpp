#include "bench/speed/tasks.h"

#include <time.h>

#include <cmath>

#include "odometry/dead_reckoning.h"
#include "odometry/encoder.h"
#include "umbmark/course.h"

namespace umbsim::bench {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kOnceRound_rad = 0.1;
const EncoderSpec kFine = [] {
  EncoderSpec spec;
  spec.ticks_per_revolution = 1e6;
  spec.rate_hz = 1 / kPeriod_s;
  return spec;
}();

// Of this thread on a processor: other programs on the machine count less than on a wall clock.
double now_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

DeadReckoning odometry_of(const RobotModel& robot) {
  return {{robot.wheels[0].radius_m, robot.wheels[1].radius_m, robot.wheelbase_m(), kFine.ticks_per_revolution}, {}};
}

}  // namespace

Setup flat(const RobotModel& robot, double step_s) {
  Setup s;
  s.robot = robot;
  s.step_s = s.fine_step_s = step_s;
  return s;
}

Setup with_cable(const RobotModel& robot, double step_s) {
  Setup s = flat(robot, step_s);
  s.floor.cables.push_back({0.7, -robot.wheelbase_m() / 2, M_PI / 2, kCable_m, 0.10});
  return s;
}

Setup uneven(const RobotModel& robot, double step_s) {
  Setup s = flat(robot, step_s);
  s.floor.ripples = random_ripples(0.0005, 0.3, 1, 0);
  return s;
}

Outcome drive_square(Engine& engine, const RobotModel& nominal, double side_m) {
  Course course;
  course.side_m = side_m;
  const Plan plan(course, Direction::cw);
  const DriveGeometry believed{nominal.wheels[0].radius_m, nominal.wheels[1].radius_m, nominal.wheelbase_m()};
  DeadReckoning reckoning = odometry_of(nominal);
  engine.place();
  const Pose2 start = engine.pose();
  const int periods = int(std::ceil(plan.duration_s() / kPeriod_s));
  int segment = 0;
  const double begin_s = now_s();
  for (int k = 0; k < periods; ++k) {
    reckoning.update(ticks(kFine, engine.wheel_angle(0)), ticks(kFine, engine.wheel_angle(1)));
    segment = plan.segment_at(k * kPeriod_s, segment);
    const WheelSpeeds w = drive(plan, k * kPeriod_s, kPeriod_s, reckoning.pose(), believed, segment);
    engine.command(w.left_radps, w.right_radps);
    engine.advance(kPeriod_s);
  }
  const double cpu_s = now_s() - begin_s;
  reckoning.update(ticks(kFine, engine.wheel_angle(0)), ticks(kFine, engine.wheel_angle(1)));
  const Pose2 truth = inverse(start) * engine.pose();
  const Pose2& calculated = reckoning.pose();
  const Pose2 error{truth.x_m - calculated.x_m, truth.y_m - calculated.y_m, truth.theta_rad - calculated.theta_rad};
  const bool arrived = std::abs(calculated.theta_rad + 2 * M_PI) < kOnceRound_rad;
  return {std::hypot(error.x_m, error.y_m), error, error.theta_rad, periods * kPeriod_s, cpu_s, double(engine.steps()),
          arrived};
}

double cable_heading_rad(double radius_m, double wheelbase_m, double cable_height_m) {
  const double r = cable_height_m / 2;
  const double psi = std::acos((radius_m - r) / (radius_m + r));
  return (2 * (radius_m + r) * psi - 4 * std::sqrt(radius_m * r)) / wheelbase_m;
}

Outcome cross_cable(Engine& engine, const RobotModel& nominal) {
  constexpr double kDistance_m = 1.4, kAcceleration_mps2 = 0.25;
  const double radius_m = nominal.wheels[0].radius_m;
  engine.place();
  const double duration_s = kDistance_m / kCableSpeed_mps;
  const int periods = int(std::lround(duration_s / kPeriod_s));
  const double begin_s = now_s();
  for (int k = 0; k < periods; ++k) {
    const double speed = std::min(kCableSpeed_mps, (k + 1) * kPeriod_s * kAcceleration_mps2);
    engine.command(speed / radius_m, speed / radius_m);
    engine.advance(kPeriod_s);
  }
  const double cpu_s = now_s() - begin_s;
  const double believed = (engine.wheel_angle(1) - engine.wheel_angle(0)) * radius_m / nominal.wheelbase_m();
  const double heading = engine.pose().theta_rad - believed;
  // The right wheel is the bumped one: the robot turns towards it, clockwise.
  return {-heading / cable_heading_rad(radius_m, nominal.wheelbase_m(), kCable_m), {}, heading, periods * kPeriod_s,
          cpu_s, double(engine.steps())};
}

}  // namespace umbsim::bench

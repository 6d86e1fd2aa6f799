#include "bench/tasks.h"

#include <chrono>
#include <cmath>

#include "odometry/dead_reckoning.h"
#include "odometry/encoder.h"
#include "umbmark/course.h"

namespace umbsim::bench {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr EncoderSpec kFine{1e6, 1 / kPeriod_s};

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

DeadReckoning odometry_of(const RobotModel& robot) {
  return {{robot.wheels[0].radius_m, robot.wheels[1].radius_m, robot.wheelbase_m(), kFine.ticks_per_revolution}, {}};
}

}  // namespace

Outcome drive_square(Engine& engine, const RobotModel& nominal) {
  const Plan plan(Course{}, Direction::cw);
  const DriveGeometry believed{nominal.wheels[0].radius_m, nominal.wheels[1].radius_m, nominal.wheelbase_m()};
  DeadReckoning reckoning = odometry_of(nominal);
  engine.place();
  const Pose2 start = engine.pose();
  const int periods = int(std::ceil(plan.duration_s() / kPeriod_s));
  int segment = 0;
  const double begin_s = now_s();
  for (int k = 0; k < periods; ++k) {
    reckoning.update(ticks(kFine, engine.wheel_angle(0)), ticks(kFine, engine.wheel_angle(1)));
    segment = plan.at(k * kPeriod_s, segment).segment;
    const WheelSpeeds w = drive(plan, k * kPeriod_s, kPeriod_s, reckoning.pose(), believed, segment);
    engine.command(w.left_radps, w.right_radps);
    engine.advance(kPeriod_s);
  }
  const double wall_s = now_s() - begin_s;
  reckoning.update(ticks(kFine, engine.wheel_angle(0)), ticks(kFine, engine.wheel_angle(1)));
  const Pose2 truth = inverse(start) * engine.pose();
  const Pose2& calculated = reckoning.pose();
  return {std::hypot(truth.x_m - calculated.x_m, truth.y_m - calculated.y_m), truth.theta_rad - calculated.theta_rad,
          periods * kPeriod_s, wall_s, double(engine.steps())};
}

double cable_heading_rad(double radius_m, double wheelbase_m, double cable_height_m) {
  const double r = cable_height_m / 2;
  const double psi = std::acos((radius_m - r) / (radius_m + r));
  return (2 * (radius_m + r) * psi - 4 * std::sqrt(radius_m * r)) / wheelbase_m;
}

Outcome cross_cable(Engine& engine, const RobotModel& nominal, double cable_height_m, double speed_mps) {
  constexpr double kDistance_m = 1.4, kAcceleration_mps2 = 0.25;
  const double radius_m = nominal.wheels[0].radius_m;
  engine.place();
  const double duration_s = kDistance_m / speed_mps;
  const int periods = int(std::lround(duration_s / kPeriod_s));
  const double begin_s = now_s();
  for (int k = 0; k < periods; ++k) {
    const double speed = std::min(speed_mps, (k + 1) * kPeriod_s * kAcceleration_mps2);
    engine.command(speed / radius_m, speed / radius_m);
    engine.advance(kPeriod_s);
  }
  const double wall_s = now_s() - begin_s;
  const double believed = (engine.wheel_angle(1) - engine.wheel_angle(0)) * radius_m / nominal.wheelbase_m();
  const double heading = engine.pose().theta_rad - believed;
  // The right wheel is the bumped one: the robot turns towards it, clockwise.
  return {-heading / cable_heading_rad(radius_m, nominal.wheelbase_m(), cable_height_m), heading,
          periods * kPeriod_s, wall_s, double(engine.steps())};
}

}  // namespace umbsim::bench

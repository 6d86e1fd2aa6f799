#include "experiment/drive/commanded_course.h"

#include <cmath>

#include "core/pose2.h"

namespace umbsim {
namespace {

bool declared(const RecordedPath& p) {
  return p.shape == "square" && p.side_m > 0 && p.linear_speed_mps && p.angular_speed_radps &&
         p.linear_acceleration_mps2 && p.angular_acceleration_radps2;
}

std::vector<EncoderSample> driven(const Course& course, Direction direction, const RecordedRobot& robot,
                                  double period_s) {
  const Plan plan(course, direction);
  const DriveGeometry geometry{robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m};
  const double ticks_per_rad = robot.ticks_per_revolution / (2 * M_PI);
  std::vector<EncoderSample> samples;
  Pose2 X_SB;
  WheelSpeeds command;
  double left_rad = 0;
  double right_rad = 0;
  int segment = 0;
  const int periods = int(std::ceil(plan.duration_s() / period_s));
  for (int period = 0; period <= periods; ++period) {
    const double time_s = period * period_s;
    samples.push_back({time_s, std::llround(ticks_per_rad * left_rad), std::llround(ticks_per_rad * right_rad),
                       command.left_radps, command.right_radps});
    segment = plan.segment_at(time_s, segment);
    command = drive(plan, time_s, period_s, X_SB, geometry, segment);
    left_rad += command.left_radps * period_s;
    right_rad += command.right_radps * period_s;
    const double left_m = command.left_radps * period_s * robot.wheel_radius_m;
    const double right_m = command.right_radps * period_s * robot.wheel_radius_m;
    X_SB = X_SB * arc((left_m + right_m) / 2, (right_m - left_m) / robot.wheelbase_m);
  }
  return samples;
}

}  // namespace

Course commanded(Course course, const CommandedMotion& motion) {
  course.linear_acceleration_mps2 *= motion.acceleration_factor;
  course.angular_acceleration_radps2 *= motion.acceleration_factor * motion.turn_speed_factor;
  course.angular_speed_radps *= motion.turn_speed_factor;
  return course;
}

Course commanded_course(const RecordedPath& path, const RecordedRun& run, const CommandedMotion& motion) {
  Course c;
  c.side_m = path.side_m;
  c.turn = run.turn.value_or(path.turn);
  c.turn_radius_m = run.turn_radius_m.value_or(path.turn_radius_m.value_or(c.turn_radius_m));
  c.linear_speed_mps = run.linear_speed_mps.value_or(*path.linear_speed_mps);
  c.angular_speed_radps = *path.angular_speed_radps;
  c.linear_acceleration_mps2 = *path.linear_acceleration_mps2;
  c.angular_acceleration_radps2 = *path.angular_acceleration_radps2;
  return commanded(c, motion);
}

Recording commanded(const Recording& recording, const CommandedMotion& motion) {
  Recording result;
  result.robot = recording.robot;
  result.path = recording.path;
  result.encoder_rate_hz = recording.encoder_rate_hz;
  if (!declared(recording.path) || recording.runs.empty()) return result;
  for (const RecordedRun& run : recording.runs) {
    if (run.direction != recording.runs.front().direction) continue;
    RecordedRun asked;
    asked.id = run.id;
    asked.direction = run.direction;
    asked.turn = run.turn;
    asked.has_commands = true;
    const Direction direction = run.direction == "cw" ? Direction::cw : Direction::ccw;
    asked.encoders = driven(commanded_course(recording.path, run, motion), direction, recording.robot,
                            1 / recording.encoder_rate_hz);
    result.runs.push_back(std::move(asked));
  }
  return result;
}

}  // namespace umbsim

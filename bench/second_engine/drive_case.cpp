#include "bench/second_engine/drive_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/second_engine/driver.h"
#include "bench/second_engine/robot.h"
#include "core/error.h"
#include "core/text_file.h"
#include "experiment/demanded.h"
#include "experiment/planned_runs.h"
#include "gap/trial/trial_folder.h"
#include "odometry/dead_reckoning.h"

namespace umbsim::second_engine {
namespace {

constexpr double kRest_s = 0.5;
constexpr double kTruthRate_hz = 10;
constexpr double kLongest = 3;  // times as long as the course should take: a robot that does not get there

RobotModel load_drawn_robot(const TrialRobot& robot) {
  const ScratchFolder scratch;
  write_text_file(scratch.path() / kTrialUrdf, robot_urdf(robot));
  return load_robot((scratch.path() / kTrialUrdf).string());
}

// The robot as it really is in this run.
Rig rig_of(const TrialDrive& drive, const RobotModel& nominal, const RecordedRun& run, int number) {
  Rig rig;
  rig.robot = nominal;
  rig.encoders.rate_hz = drive.planned.encoder_rate_hz;
  rig.encoders.ticks_per_revolution = drive.planned.robot.ticks_per_revolution;
  rig.run = {run.id, number, drive.seed};
  rig.drivetrain = Drivetrain(nominal.wheels[0].effort_limit_nm);
  RandomStream random(drive.seed, "second engine radii", std::uint64_t(number));
  for (Wheel& wheel : rig.robot.wheels) wheel.radius_m *= 1 + random.normal(0, drive.radius_scatter);
  rig = apply_effects(drive.effects, std::move(rig));
  if (!run.payload_kg) return rig;
  return apply_effects({payload_on(nominal, *run.payload_kg)}, std::move(rig));
}

// What the robot knows of itself.
class OwnOdometry {
 public:
  OwnOdometry(const Rig& rig, const RecordedRobot& believed)
      : encoders_{{rig.encoders, rig.encoders.left, stream(rig, "left")},
                  {rig.encoders, rig.encoders.right, stream(rig, "right")}},
        metres_per_tick_(2 * M_PI * believed.wheel_radius_m / rig.encoders.ticks_per_revolution),
        wheelbase_m_(believed.wheelbase_m) {}

  void read(double time_s, const Robot& robot) {
    double rolled_m[2];
    for (int i = 0; i < 2; ++i) {
      const std::int64_t count = encoders_[i].read(time_s, robot.encoder_angle(i));
      rolled_m[i] = double(count - ticks[i]) * metres_per_tick_;
      ticks[i] = count;
    }
    pose = pose * arc((rolled_m[0] + rolled_m[1]) / 2, (rolled_m[1] - rolled_m[0]) / wheelbase_m_);
  }

  std::int64_t ticks[2] = {0, 0};
  Pose2 pose;

 private:
  static RandomStream stream(const Rig& rig, const char* side) {
    return RandomStream(rig.run.seed, fmt::format("second engine {} encoder", side), std::uint64_t(rig.run.number));
  }
  Encoder encoders_[2];
  double metres_per_tick_;
  double wheelbase_m_;
};

// Ticks are written in the unit that the experimenter believes in.
class Recorder {
 public:
  Recorder(const TrialDrive& drive, const Rig& rig, RecordedRun& run)
      : planned_(drive.planned),
        unit_(drive.planned.robot.ticks_per_revolution / rig.encoders.ticks_per_revolution),
        stride_(std::max(1, int(std::lround(drive.planned.encoder_rate_hz / kTruthRate_hz)))),
        random_(drive.seed, "second engine pose", std::uint64_t(rig.run.number)),
        run_(run) {
    run_.has_commands = true;
  }
  void counts(double time_s, const OwnOdometry& odometry, const WheelSpeeds& command) {
    run_.encoders.push_back({time_s, std::llround(double(odometry.ticks[0]) * unit_),
                             std::llround(double(odometry.ticks[1]) * unit_), command.left_radps, command.right_radps});
  }
  void pose(int period, double time_s, const Pose2& X_WB) {
    if (period % stride_ != 0) return;
    const double sd = planned_.truth_position_sd_m;
    const double x = random_.normal(X_WB.x_m, sd), y = random_.normal(X_WB.y_m, sd);
    run_.truth.push_back({time_s, {x, y, random_.normal(X_WB.theta_rad, planned_.truth_heading_sd_rad)}});
  }

 private:
  const Recording& planned_;
  double unit_;
  int stride_;
  RandomStream random_;
  RecordedRun& run_;
};

void drive_run(const EngineOptions& options, const TrialDrive& drive, const RobotModel& nominal, RecordedRun& run,
               int number) {
  const Rig rig = rig_of(drive, nominal, run, number);
  const RecordedRobot& believed = drive.planned.robot;
  const Direction direction = run.direction == "cw" ? Direction::cw : Direction::ccw;
  const double period_s = 1 / drive.planned.encoder_rate_hz;
  const double longest_s = kLongest * Plan(demanded_course(drive.planned.path, run, {}), direction).duration_s();
  Robot robot(rig, options, run.start_heading_rad.value_or(0), drive.heading_walk_rad_per_sqrt_m,
              RandomStream(drive.seed, "second engine heading", std::uint64_t(number)));
  Driver driver(demanded_course(drive.planned.path, run, rig.demand), direction,
                {believed.wheel_radius_m, believed.wheel_radius_m, believed.wheelbase_m}, period_s);
  OwnOdometry odometry(rig, believed);
  Recorder recorder(drive, rig, run);
  WheelSpeeds command;
  for (int period = 0, rest = 0; rest * period_s <= kRest_s; ++period) {
    const double time_s = period * period_s;
    if (time_s > longest_s) throw RunError(fmt::format("{}: the robot does not arrive", run.id));
    odometry.read(time_s, robot);
    recorder.counts(time_s, odometry, command);
    command = driver.done() ? WheelSpeeds{} : driver.command(odometry.pose);
    if (driver.leg_begins()) robot.begin_leg(driver.leg());
    robot.advance(command.left_radps, command.right_radps, options.clock_offset_s);
    recorder.pose(period, time_s, robot.pose());
    robot.advance(command.left_radps, command.right_radps, period_s - options.clock_offset_s);
    rest += driver.done();
  }
}

}  // namespace

Recording drive_case(const EngineOptions& options, const TrialDrive& drive) {
  const RobotModel nominal = load_drawn_robot(drive.robot);
  Recording recording = drive.planned;
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    drive_run(options, drive, nominal, recording.runs[i], int(i));
  }
  return recording;
}

}  // namespace umbsim::second_engine

#include "bench/worlds/run/world_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/worlds/run/run_clock.h"
#include "core/error.h"
#include "experiment/drive/planned_runs.h"

namespace umbsim::worlds {
namespace {

constexpr double kTipped_rad = 0.5;
constexpr double kFarOff = 0.25;  // of the way: a nominal robot that is so far from its counts does not roll
constexpr double kFarTurned_rad = 0.7;

// The robot as it really is in this run.
Rig rig_of(const World& w, const Drive& drive, std::size_t number) {
  const RecordedRun& run = w.runs.recording.runs[number];
  Rig rig;
  rig.robot = w.robot.model;
  rig.encoders.rate_hz = w.driver.rate_hz;
  rig.encoders.ticks_per_revolution = w.robot.ticks_per_revolution * drive.finer_encoders;
  rig.floor.friction = w.physics.friction;
  rig.run = {run.id, int(number), drive.seed};
  for (std::size_t i = 0; i < 2; ++i) {
    Wheel& wheel = rig.robot.wheels[i];
    wheel.creep_along = w.physics.creep_along;
    wheel.creep_across = w.physics.creep_across;
    wheel.patch_width_m = w.physics.patch_width_m;
    rig.drivetrain.motor[i].lag_s = w.physics.motor_lag_s;
    rig.drivetrain.motor[i].torque_limit_nm = wheel.effort_limit_nm;
  }
  for (Caster& c : rig.robot.casters) c.friction += c.swivels ? 0 : w.physics.caster_friction;
  RandomStream radii(drive.seed, "worlds radius", number), motors(drive.seed, "worlds motor", number);
  for (Wheel& wheel : rig.robot.wheels) wheel.radius_m *= 1 + radii.normal(0, drive.noise.radius_scatter);
  rig = apply_effects(drive.faults.effects, std::move(rig));
  if (run.payload_kg) rig = apply_effects({payload_on(w.robot.model, *run.payload_kg)}, std::move(rig));
  for (Motor& motor : rig.drivetrain.motor) motor.gain *= 1 + motors.normal(0, drive.noise.motor_scatter);
  return rig;
}

// Counts as they arrive, and where they lead.
class Odometer {
 public:
  Odometer(const World& w, const Rig& rig)
      : encoders_{{rig.encoders, rig.encoders.left, stream(rig, "left")},
                  {rig.encoders, rig.encoders.right, stream(rig, "right")}},
        metres_per_tick_(2 * M_PI * w.robot.model.wheels[0].radius_m / rig.encoders.ticks_per_revolution),
        wheelbase_m_(w.robot.model.wheelbase_m()) {}

  void read(double time_s, const std::array<double, 2>& shaft_rad) {
    double rolled_m[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const std::int64_t count = encoders_[i].read(time_s, shaft_rad[i]);
      rolled_m[i] = double(count - ticks[i]) * metres_per_tick_;
      ticks[i] = count;
    }
    X_SB = X_SB * arc((rolled_m[0] + rolled_m[1]) / 2, (rolled_m[1] - rolled_m[0]) / wheelbase_m_);
  }
  std::array<std::int64_t, 2> ticks{};
  Pose2 X_SB;

 private:
  static RandomStream stream(const Rig& rig, const char* side) {
    return {rig.run.seed, fmt::format("worlds {} encoder", side), std::uint64_t(rig.run.number)};
  }
  Encoder encoders_[2];
  double metres_per_tick_;
  double wheelbase_m_;
};

DriveGeometry believed(const World& w) {
  const double radius_m = w.robot.model.wheels[0].radius_m;
  return {radius_m, radius_m, w.robot.model.wheelbase_m()};
}

struct DrivenRun {
  RecordedRun run;
  bool arrived = false;
  std::int64_t steps = 0;
};

// Radians at the drawn robot's encoders are counts of the rig's; the recording is in the unit that is believed.
DrivenRun drive_run(const World& w, const Drive& drive, std::size_t number) {
  const Rig rig = rig_of(w, drive, number);
  const RecordedRun& planned = w.runs.recording.runs[number];
  const Pose2 X_WS{0, 0, planned.start_heading_rad.value_or(0)};
  const std::unique_ptr<Engine> engine =
      w.engine->build({rig, X_WS, drive.seed, w.robot.model.total_mass_kg()}, w.options);
  const std::unique_ptr<Driver> driver = make_driver(w.driver, commanded_way(w.runs, number, rig.commanded_motion),
                                                     believed(w), {drive.seed, "worlds driver", number});
  // Of each wheel; both together make the heading walk.
  const double roughness = drive.noise.heading_walk_rad_per_sqrt_m * w.robot.model.wheelbase_m() / std::sqrt(2.0);
  RunClock clock(*engine, rig, drive.faults.outside, roughness, drive.seed, number);
  Odometer odometer(w, rig);
  const double unit = w.robot.ticks_per_revolution * drive.finer_encoders / rig.encoders.ticks_per_revolution;
  const double period_s = 1 / w.driver.rate_hz;
  const int periods = recorded_periods(w, number);
  DrivenRun driven{planned, false, 0};
  driven.run.has_commands = true;
  WheelSpeeds command;
  int segment = -1;
  for (int period = 0; period <= periods; ++period) {
    const double time_s = period * period_s;
    odometer.read(time_s, clock.shaft_rad());
    driven.run.encoders.push_back({time_s, std::llround(double(odometer.ticks[0]) * unit),
                                   std::llround(double(odometer.ticks[1]) * unit), command.left_radps,
                                   command.right_radps});
    if (period == periods) break;
    command = driver->command(time_s, {odometer.X_SB, inverse(X_WS) * engine->pose()});
    driven.arrived = driver->done();
    if (driver->segment() != segment) {
      segment = driver->segment();
      const Segment& s = w.runs.ways[number].segments[std::size_t(segment)];
      if (s.kind == Segment::Kind::leg || segment == 0) clock.begin_leg(s.leg, rig.pushes);
    }
    clock.advance(command, period_s, driver->jumps());
    if (engine->tilt_rad() > kTipped_rad) throw RunError(planned.id + ": the robot tips over");
  }
  driven.run.truth = clock.truth();
  driven.steps = engine->steps();
  return driven;
}

}  // namespace

int recorded_periods(const World& w, std::size_t number) {
  // Drivers without a clock are slower than the plan, a human most.
  const double slower = w.driver.kind == "joystick" ? 1.8 : 1.35;
  return int(std::ceil((slower * duration_s(w.runs.ways[number]) + 3) * w.driver.rate_hz));
}

DrivenWorld drive_world(const World& world, const Drive& drive) {
  DrivenWorld driven;
  for (std::size_t i = 0; i < world.runs.recording.runs.size(); ++i) {
    DrivenRun run = drive_run(world, drive, i);
    driven.runs.push_back(std::move(run.run));
    driven.arrived.push_back(run.arrived);
    driven.steps += run.steps;
  }
  return driven;
}

namespace {

double length_m(const Way& way) {
  double sum = 0;
  for (const Segment& s : way.segments) sum += s.length_m;
  return sum;
}

// A tracker without heading leaves the column to the experimenter: he writes what the robot's counts add up to.
void write_counted_headings(const RecordedRobot& robot, RecordedRun& run) {
  const double rad_per_count = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution / robot.wheelbase_m;
  std::size_t row = 0;
  for (TruthSample& t : run.truth) {
    while (row + 1 < run.encoders.size() && run.encoders[row + 1].time_s <= t.time_s + 1e-9) ++row;
    const EncoderSample& e = run.encoders[row];
    t.X_WB.theta_rad = run.start_heading_rad.value_or(0) + double(e.right_ticks - e.left_ticks) * rad_per_count;
  }
}

}  // namespace

bool drives(const World& w, const DrivenWorld& driven) {
  for (std::size_t i = 0; i < driven.runs.size(); ++i) {
    if (!driven.arrived[i]) return false;
    const RecordedRun& run = driven.runs[i];
    const Plan plan(w.runs.ways[i].limits, w.runs.ways[i].segments);
    const Segment& last = plan.segments().back();
    const Pose2 X_SE = last.X_SB_start * arc(last.length_m, last.angle_rad);
    const Pose2 miss = inverse(run.truth.front().X_WB * X_SE) * run.truth.back().X_WB;
    if (!(std::hypot(miss.x_m, miss.y_m) < kFarOff * length_m(w.runs.ways[i]))) return false;
    if (!(std::abs(miss.theta_rad) < kFarTurned_rad)) return false;
  }
  return true;
}

Recording record(const World& world, const DrivenWorld& driven, std::uint64_t seed) {
  Recording r = world.runs.recording;
  r.runs = driven.runs;
  for (std::size_t i = 0; i < r.runs.size(); ++i) {
    r.runs[i].truth = observe(driven.runs[i].truth, world.tracker, {seed, "worlds tracker", i});
    if (!world.tracker.sees_heading) write_counted_headings(r.robot, r.runs[i]);
  }
  return r;
}

Recording record_exactly(const World& world, const DrivenWorld& driven, double finer_encoders) {
  Recording r = world.runs.recording;
  r.robot.ticks_per_revolution *= finer_encoders;
  r.runs = driven.runs;
  for (std::size_t i = 0; i < r.runs.size(); ++i) {
    RecordedRun& run = r.runs[i];
    run.truth.clear();
    for (const EncoderSample& e : run.encoders)
      run.truth.push_back({e.time_s, pose_at(driven.runs[i].truth, e.time_s)});
  }
  return r;
}

}  // namespace umbsim::worlds

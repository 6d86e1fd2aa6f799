#include "bench/worlds/checks/drive_course.h"

#include <cmath>

namespace umbsim::worlds {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kRest_s = 0.3;

Pose2 rolled(const double (&before_rad)[2], const double (&after_rad)[2], const DriveGeometry& g) {
  const double left = (after_rad[0] - before_rad[0]) * g.left_radius_m;
  const double right = (after_rad[1] - before_rad[1]) * g.right_radius_m;
  return arc((left + right) / 2, (right - left) / g.wheelbase_m);
}

// Pulls of a push in the frame of the floor, where it acts in this moment.
Pull pull_of(const std::vector<LegPush>& pushes, int leg, double leg_s, double heading_rad) {
  Pull pull;
  for (const LegPush& p : pushes) {
    if (p.leg != leg || leg_s < p.push.time_s - 1e-9 || leg_s > p.push.time_s + p.push.duration_s - 1e-9) continue;
    const double newton = p.push.impulse_ns / p.push.duration_s, way = heading_rad + p.push.direction_rad;
    pull = {newton * std::cos(way), newton * std::sin(way), p.push.ahead_m, 0, p.push.height_m, 0};
  }
  return pull;
}

class Recorder {
 public:
  Recorder(Engine& engine, DrivenTrack& track) : engine_(engine), track_(track) { sample({}, 0); }
  void advance(const WheelSpeeds& command, int part) {
    engine_.advance(command, kPeriod_s);
    time_s_ += kPeriod_s;
    sample(command, part);
  }
  double time_s() const { return time_s_; }

 private:
  void sample(const WheelSpeeds& command, int part) {
    track_.samples.push_back({time_s_,
                              {command.left_radps, command.right_radps},
                              {engine_.encoder_angle(0), engine_.encoder_angle(1)},
                              engine_.pose(),
                              part});
  }
  Engine& engine_;
  DrivenTrack& track_;
  double time_s_ = 0;
};

// Three parts of every leg, one of every turn; the dwell belongs to what goes before it.
int part_of(const Segment& s, double time_s, const std::vector<int>& first, std::size_t index) {
  if (s.kind == Segment::Kind::turn) return first[index];
  const double in_s = time_s - s.start_s;
  return first[index] + (in_s < s.ramp_s ? 0 : in_s < s.duration_s - s.ramp_s ? 1 : 2);
}

std::vector<int> name_parts(const Plan& plan, DrivenTrack& track) {
  std::vector<int> first;
  for (const Segment& s : plan.segments()) {
    first.push_back(int(track.parts.size()));
    if (s.kind == Segment::Kind::turn) {
      track.parts.push_back({s.length_m > 0 ? "arc" : "turn", s.length_m, s.angle_rad});
      continue;
    }
    const double ramp_m = s.speed * s.ramp_s / 2;
    track.parts.push_back({"start", ramp_m, 0});
    track.parts.push_back({"cruise", s.length_m - 2 * ramp_m, 0});
    track.parts.push_back({"stop", ramp_m, 0});
  }
  return first;
}

void drive_square(Engine& engine, const CheckDrive& d, DrivenTrack& track) {
  const Plan plan(d.course, d.direction);
  const std::vector<int> first = name_parts(plan, track);
  Recorder recorder(engine, track);
  Pose2 X_OB;
  int hint = 0;
  const int periods = int(std::ceil((plan.duration_s() + kRest_s) / kPeriod_s));
  for (int k = 0; k < periods; ++k) {
    const double time_s = k * kPeriod_s;
    hint = plan.segment_at(time_s, hint);
    const Segment& s = plan.segments()[std::size_t(hint)];
    const int leg = s.kind == Segment::Kind::leg ? s.leg : 0;
    if (!d.pushes.empty()) engine.set_pull(pull_of(d.pushes, leg, time_s - s.start_s, engine.pose().theta_rad));
    const WheelSpeeds command =
        time_s < plan.duration_s() ? umbsim::drive(plan, time_s, kPeriod_s, X_OB, d.believed, hint) : WheelSpeeds{};
    recorder.advance(command, part_of(s, time_s, first, std::size_t(hint)));
    const auto& samples = track.samples;
    X_OB = X_OB * rolled(samples[samples.size() - 2].shaft_rad, samples.back().shaft_rad, d.believed);
  }
}

void drive_circle(Engine& engine, const CheckDrive& d, DrivenTrack& track) {
  const double sign = d.direction == Direction::ccw ? 1 : -1, curvature = sign / d.circle_radius_m;
  const double v = d.course.linear_speed_mps, ramp_s = v / d.course.linear_acceleration_mps2;
  const double round_s = 2 * M_PI * d.circle_radius_m / v;
  track.parts = {{"circle", 2 * M_PI * d.circle_radius_m + v * ramp_s, sign * 2 * M_PI}};
  Recorder recorder(engine, track);
  while (recorder.time_s() < round_s + 2 * ramp_s + kRest_s) {
    const double end_s = recorder.time_s() + kPeriod_s;
    const double share = std::clamp(std::min(end_s / ramp_s, (round_s + 2 * ramp_s - end_s) / ramp_s), 0.0, 1.0);
    const double half_m = d.believed.wheelbase_m / 2;
    recorder.advance({share * v * (1 - curvature * half_m) / d.believed.left_radius_m,
                      share * v * (1 + curvature * half_m) / d.believed.right_radius_m},
                     0);
  }
}

}  // namespace

DriveGeometry believed_of(const Rig& rig) {
  return {rig.robot.wheels[0].radius_m, rig.robot.wheels[1].radius_m, rig.robot.wheelbase_m()};
}

DrivenTrack drive(Engine& engine, const CheckDrive& d) {
  DrivenTrack track;
  if (d.kind == CheckDrive::Kind::square)
    drive_square(engine, d, track);
  else
    drive_circle(engine, d, track);
  return track;
}

std::vector<Pose2> residuals(const DrivenTrack& track, const DriveGeometry& believed) {
  std::vector<Pose2> residual(track.parts.size());
  const auto& s = track.samples;
  std::size_t begin = 0;
  for (std::size_t p = 0; p < track.parts.size(); ++p) {
    std::size_t end = begin;
    Pose2 odometry;
    while (end + 1 < s.size() && s[end + 1].part == int(p)) {
      odometry = odometry * rolled(s[end].shaft_rad, s[end + 1].shaft_rad, believed);
      ++end;
    }
    const Pose2 moved = inverse(s[begin].X_WB) * s[end].X_WB;
    residual[p] = {moved.x_m - odometry.x_m, moved.y_m - odometry.y_m, moved.theta_rad - odometry.theta_rad};
    begin = end;
  }
  return residual;
}

}  // namespace umbsim::worlds

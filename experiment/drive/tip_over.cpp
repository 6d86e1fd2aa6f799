#include "experiment/drive/tip_over.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiment/drive/check_loop.h"
#include "experiment/drive/commanded_course.h"

namespace umbsim {
namespace {

// What is advised is this share of what the robot stands at rest: an acceleration that sets in at once rocks it on its
// supports, which give.
constexpr double kReserve = 0.9;

constexpr double kRoundOff = 1e-6;

// The motion that the course asks for where the robot came off its supports.
struct Asked {
  FloorMotion changing;     // while it speeds up; slowing down is the same backwards
  FloorMotion fastest;      // at full speed
  double acceleration = 0;  // with effects on it
  double demanded = 1;      // of which this many times what the key says
  const char* unit = "";
  const char* key = "";
  const char* speed_key = "";
  double gain = 0;  // of the driver's correction
  double ramp_s = 0;
  std::string doing;
};

const char* phase(const Segment& s, double since_s) {
  if (since_s < s.ramp_s) return "speeding up";
  if (since_s < s.duration_s - s.ramp_s) return "at full speed";
  return since_s < s.duration_s ? "slowing down" : "standing after it";
}

Asked asked_in_place(const Segment& s, const Course& course, const Course& as_given) {
  Asked a;
  a.acceleration = course.angular_acceleration_radps2;
  a.demanded = a.acceleration / as_given.angular_acceleration_radps2;
  a.unit = "rad/s^2";
  a.key = "course.angular_acceleration_radps2";
  a.speed_key = "course.angular_speed_radps";
  a.gain = kDriver.heading;
  a.changing.turning_radps2 = s.angle_rad < 0 ? -a.acceleration : a.acceleration;
  a.fastest.turning_speed2_radps2 = s.speed * s.speed;
  return a;
}

Asked asked_rolling(const Segment& s, const Course& course, const Course& as_given) {
  Asked a;
  const double curvature = s.angle_rad / s.length_m;
  a.acceleration = course.linear_acceleration_mps2;
  a.demanded = a.acceleration / as_given.linear_acceleration_mps2;
  a.unit = "m/s^2";
  a.key = "course.linear_acceleration_mps2";
  a.speed_key = "course.linear_speed_mps";
  a.gain = kDriver.along;
  a.changing.forward_mps2 = a.acceleration;
  a.changing.turning_radps2 = a.acceleration * curvature;
  a.fastest.left_mps2 = s.speed * s.speed * curvature;
  a.fastest.turning_speed2_radps2 = std::pow(s.speed * curvature, 2);
  return a;
}

Asked asked(const Segment& s, const Course& course, const Course& as_given, double time_s) {
  Asked a = s.length_m == 0 ? asked_in_place(s, course, as_given) : asked_rolling(s, course, as_given);
  a.ramp_s = s.ramp_s;
  const std::string where =
      s.leg == 0 ? "in the turn before leg 1"
                 : fmt::format("{} {}", s.kind == Segment::Kind::leg ? "on leg" : "in the turn after leg", s.leg);
  a.doing = fmt::format("{} ({})", where, phase(s, time_s - s.start_s));
  return a;
}

FloorMotion backwards(FloorMotion m) {
  m.forward_mps2 *= -1;
  m.turning_radps2 *= -1;
  return m;
}

// How the robot stands there at rest, without ripples and cables, as it was turned.
Standing standing_at_rest(const Fall& fall, const Scenario& s, const Rig& rig) {
  Floor floor;
  floor.friction = rig.floor.friction;
  floor.slope_rad = rig.floor.slope_rad;
  floor.downhill_rad = rig.floor.downhill_rad - fall.heading_rad;
  World world(rig.robot, rig.drivetrain, floor, s.physics);
  world.place({});
  return world.standing();
}

// To three digits, towards what it stands.
std::string rounded_down(double value) {
  if (!std::isfinite(value)) return "any";
  if (value <= 0) return "0";
  const double grain = std::pow(10, std::floor(std::log10(value)) - 2);
  return fmt::format("{:g}", std::floor(value / grain) * grain);
}

// By the balance of moments alone: whether the wheels have grip for as much is another question.
std::string limits(const Asked& a, const Standing& standing, const LoopTiming& timing) {
  // Moments grow with the square of the speed: what stands at rest and at full speed stands between.
  const auto largest = [&](const FloorMotion& more) {
    return std::min(standing.largest_share(more), standing.largest_share(more, a.fastest));
  };
  const double up = largest(a.changing);
  const double down = largest(backwards(a.changing));
  const double more = overshoot(timing, a.gain, a.ramp_s);
  const std::string it_stands = fmt::format(
      "By its centre of mass and its supports it stands {} {} speeding up and {} slowing down; the driver's "
      "corrections add up to {:.0f} %",
      rounded_down(up * a.acceleration), a.unit, rounded_down(down * a.acceleration),
      std::max(0.0, std::ceil(100 * (more - 1) - kRoundOff)));
  const double most = kReserve * std::min(up, down) / more;
  if (most == 0) return fmt::format("{}: at this speed it stands nothing, lower {}", it_stands, a.speed_key);
  if (most < 1) {
    return fmt::format("{}: lower {} to {} or less", it_stands, a.key,
                       rounded_down(most * a.acceleration / a.demanded));
  }
  return it_stands +
         ", so that the course's acceleration alone did not do it: look at pushes, cables, unevenness, loads, "
         "and what makes the driver correct much";
}

std::string limits_there(const Fall& fall, const Scenario& s, const Rig& rig, const Asked& a) {
  try {
    return limits(a, standing_at_rest(fall, s, rig), loop_timing(s, rig));
  } catch (const InputError&) {
    return "Turned like this it does not even stand at rest: lower effects.floor_slope.slope_rad";
  }
}

}  // namespace

std::string tip_over_message(const Fall& fall, const Scenario& s, const Rig& rig, const Plan& plan,
                             const RunSpec& spec) {
  const double falls_s = fall.stood_s + s.physics.step_s;  // the first moment at which its supports no longer held it
  const Segment& segment = plan.segments()[std::size_t(plan.segment_at(falls_s))];
  const Asked a = asked(segment, commanded(s.course, rig.commanded_motion), s.course, falls_s);
  const std::string lifted = fall.lifted.empty() ? "" : fmt::format(", {} off the floor", fall.lifted);
  return fmt::format(
      "{}: run {}: the robot tips over {} from {:.2f} s after its start, {}, where the course asks for {:g} {}: at "
      "{:.2f} s "
      "it leans by {:.0f} degrees{}. {}",
      rig.robot.urdf, spec.id, fall.way, fall.stood_s, a.doing, a.acceleration, a.unit, fall.noticed_s,
      fall.tilt_rad * 180 / M_PI, lifted, limits_there(fall, s, rig, a));
}

}  // namespace umbsim

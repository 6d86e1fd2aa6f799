// Drivers without a clock.
#include <algorithm>
#include <cmath>
#include <deque>

#include "bench/worlds/drivers/kinds.h"

namespace umbsim::worlds {
namespace {

/// Proportional on heading and on the distance from the line (gain 0: on heading alone).
class Heading : public SegmentDriver {
 public:
  using SegmentDriver::SegmentDriver;

 protected:
  Twist steer(const Segment& s, double left, const Pose2& X_SB) override { return proportional(s, left, X_SB); }
};

/// Pure pursuit (Coulter 1992): an arc through a point of the line some way ahead.
class Pursuit : public SegmentDriver {
 public:
  using SegmentDriver::SegmentDriver;

 protected:
  Twist steer(const Segment& s, double left, const Pose2& X_SB) override {
    Twist t = proportional(s, left, X_SB);
    if (in_place(s)) return t;
    // Straight on beyond the end of a leg, so that the robot arrives along it.
    const Pose2 goal = inverse(X_SB) * reference(s, left - choice_.look_ahead_m);
    const double distance_squared = goal.x_m * goal.x_m + goal.y_m * goal.y_m;
    t.w_radps = t.v_mps * 2 * goal.y_m / distance_squared;
    return t;
  }
};

/// Full speed or none. The robot stops as soon as what is left is what it will still roll.
class Jumps : public SegmentDriver {
 public:
  using SegmentDriver::SegmentDriver;
  bool jumps() const override { return true; }

 protected:
  double arrived(const Segment& s) const override { return top_speed(s) * period_s_ / 2; }
  Twist steer(const Segment& s, double left, const Pose2& X_SB) override {
    const double top = top_speed(s);
    if (in_place(s)) return {0, s.angle_rad < 0 ? -top : top};
    const Pose2 e = error(s, left, X_SB);
    const double off = e.theta_rad + e.y_m / choice_.look_ahead_m;
    const double correction = std::abs(off) < kDead_rad ? 0 : (off > 0 ? -kCorrection_radps : kCorrection_radps);
    return {top, top * s.angle_rad / s.length_m + correction};
  }

 private:
  static constexpr double kDead_rad = 0.02;
  static constexpr double kCorrection_radps = 0.08;
};

/// A human beside the robot: sees where it really is, reacts late, with a hand that trembles and a stick of 64 steps.
class Joystick : public SegmentDriver {
 public:
  Joystick(const DriverChoice& choice, const Way& way, const DriveGeometry& believed, RandomStream random)
      : SegmentDriver(choice, way, believed), random_(std::move(random)) {}

 protected:
  const Pose2& look(double time_s, const Seen& seen) override {
    seen_.push_back({time_s, seen.X_SB_eye});
    while (seen_.size() > 1 && seen_[1].time_s <= time_s - choice_.dead_time_s) seen_.pop_front();
    return seen_.front().X_SB;
  }
  double arrived(const Segment& s) const override { return in_place(s) ? 0.03 : 0.015; }
  Twist steer(const Segment& s, double left, const Pose2& X_SB) override {
    const double keep = std::exp(-period_s_ / kTremor_s);
    tremor_ = keep * tremor_ + std::sqrt(1 - keep * keep) * choice_.tremor_radps * random_.normal();
    const double top = top_speed(s), turn_top = way_.limits.angular_speed_radps;
    if (in_place(s)) {
      const double w = std::min(top, kApproach_1ps * left + kSlow * top);
      return {0, stick((s.angle_rad < 0 ? -w : w) + tremor_, turn_top)};
    }
    const Pose2 e = error(s, left, X_SB);
    const double v = std::min(top, kApproach_1ps * left + kSlow * top);
    const double w = v * s.angle_rad / s.length_m - choice_.heading_gain_1ps * e.theta_rad -
                     choice_.across_gain_radpms * e.y_m + tremor_;
    return {stick(v, top), stick(w, turn_top)};
  }

 private:
  static constexpr double kTremor_s = 0.4;
  static constexpr double kApproach_1ps = 1;  // slower than the dead time allows
  static constexpr double kSlow = 0.05;
  static double stick(double value, double top) { return std::round(value / top * 32) / 32 * top; }
  struct Glance {
    double time_s;
    Pose2 X_SB;
  };
  std::deque<Glance> seen_;
  RandomStream random_;
  double tremor_ = 0;
};

}  // namespace

std::unique_ptr<Driver> make_heading(const DriverChoice& choice, const Way& way, const DriveGeometry& believed) {
  return std::make_unique<Heading>(choice, way, believed);
}
std::unique_ptr<Driver> make_pursuit(const DriverChoice& choice, const Way& way, const DriveGeometry& believed) {
  return std::make_unique<Pursuit>(choice, way, believed);
}
std::unique_ptr<Driver> make_jumps(const DriverChoice& choice, const Way& way, const DriveGeometry& believed) {
  return std::make_unique<Jumps>(choice, way, believed);
}
std::unique_ptr<Driver> make_joystick(const DriverChoice& choice, const Way& way, const DriveGeometry& believed,
                                      RandomStream random) {
  return std::make_unique<Joystick>(choice, way, believed, std::move(random));
}

}  // namespace umbsim::worlds

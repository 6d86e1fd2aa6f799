// Drivers with a clock: a reference goes along the way, the robot follows it.
#include <algorithm>
#include <cmath>

#include "bench/worlds/drivers/kinds.h"

namespace umbsim::worlds {
namespace {

/// The project's own: trapezoidal speeds (umbmark/course.h).
class Own : public Driver {
 public:
  Own(const Way& way, const DriveGeometry& believed, double period_s)
      : plan_(way.limits, way.segments), believed_(believed), period_s_(period_s) {}
  WheelSpeeds command(double time_s, const Seen& seen) override {
    done_ = time_s >= plan_.duration_s();
    segment_ = plan_.segment_at(time_s, segment_);
    if (done_) return {};
    return drive(plan_, time_s, period_s_, seen.X_SB_odometry, believed_, segment_);
  }
  bool done() const override { return done_; }
  int segment() const override { return segment_; }

 private:
  Plan plan_;
  DriveGeometry believed_;
  double period_s_;
  int segment_ = 0;
  bool done_ = false;
};

// Minimum jerk from standstill to standstill (Flash & Hogan 1985): the part of the way at the part `t` of the time; its
// speed is at most 15/8 and its acceleration 10/sqrt(3) of the mean.
double minimum_jerk(double t) { return t * t * t * (10 + t * (6 * t - 15)); }
constexpr double kTopSpeed = 15.0 / 8;
const double kTopAcceleration = 10 / std::sqrt(3.0);

/// The same with S-curves in the place of trapezoids.
class SCurve : public Driver {
 public:
  SCurve(const Way& way, const DriveGeometry& believed, double period_s)
      : plan_(way.limits, way.segments), believed_(believed), period_s_(period_s) {
    for (const Segment& s : plan_.segments()) {
      const bool rolling = s.length_m > 0;
      const double extent = rolling ? s.length_m : std::abs(s.angle_rad);
      const double acceleration =
          rolling ? way.limits.linear_acceleration_mps2 : way.limits.angular_acceleration_radps2;
      double top = rolling ? way.limits.linear_speed_mps : way.limits.angular_speed_radps;
      if (rolling && s.angle_rad != 0)
        top = std::min(top, way.limits.angular_speed_radps * s.length_m / std::abs(s.angle_rad));
      const double duration_s = std::max(kTopSpeed * extent / top, std::sqrt(kTopAcceleration * extent / acceleration));
      starts_s_.push_back(end_s_);
      durations_s_.push_back(duration_s);
      end_s_ += duration_s + way.limits.dwell_s;
    }
  }
  WheelSpeeds command(double time_s, const Seen& seen) override {
    done_ = time_s >= end_s_;
    while (segment_ + 1 < int(starts_s_.size()) && starts_s_[std::size_t(segment_) + 1] <= time_s) ++segment_;
    if (done_) return {};
    return follow(reference(time_s), reference(time_s + period_s_), period_s_, seen.X_SB_odometry, believed_);
  }
  bool done() const override { return done_; }
  int segment() const override { return segment_; }

 private:
  // Within the segment that is being driven: the next one begins after a dwell.
  Pose2 reference(double time_s) const {
    const std::size_t i = std::size_t(segment_);
    const Segment& s = plan_.segments()[i];
    const double part = minimum_jerk(std::clamp((time_s - starts_s_[i]) / durations_s_[i], 0.0, 1.0));
    return s.X_SB_start * arc(part * s.length_m, part * s.angle_rad);
  }

  Plan plan_;
  DriveGeometry believed_;
  double period_s_;
  std::vector<double> starts_s_, durations_s_;
  double end_s_ = 0;
  int segment_ = 0;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<Driver> make_own(const Way& way, const DriveGeometry& believed, double period_s) {
  return std::make_unique<Own>(way, believed, period_s);
}
std::unique_ptr<Driver> make_s_curve(const Way& way, const DriveGeometry& believed, double period_s) {
  return std::make_unique<SCurve>(way, believed, period_s);
}

}  // namespace umbsim::worlds

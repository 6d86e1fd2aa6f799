#include "experiment/drive/cable_layer.h"

#include <cmath>

namespace umbsim {
namespace {

// A cable is laid where the wheel cannot yet touch it, plus this.
constexpr double kLayAhead_m = 0.010;

int bumped_wheel(BumpWheel wheel, Direction direction) {
  if (wheel == BumpWheel::left) return 0;
  if (wheel == BumpWheel::right) return 1;
  const int inner = direction == Direction::cw ? 1 : 0;  // right-hand turns: the right wheel is inside
  return wheel == BumpWheel::inner ? inner : 1 - inner;
}

}  // namespace

double climbing_friction(double wheel_radius_m, double cable_height_m) {
  const double R = wheel_radius_m, r = cable_height_m / 2;
  return 2 * std::sqrt(R * r) / (R - r);
}

CableLayer::CableLayer(const Scenario& scenario, const RunSpec& spec, const Plan& plan)
    : bumps_(scenario.bumps.laid), wheel_(bumped_wheel(bumps_.wheel, spec.direction)) {
  if (!spec.bumped) return;
  leg_ = int(plan.leg_segment(bumps_.leg).value());
  const Segment& leg = plan.segments()[std::size_t(leg_)];
  start_ = leg.X_SB_start;
  length_m_ = leg.length_m;
}

void CableLayer::lay_if_due(const Pose2& X_SB, int segment, World& world, const Rig& rig, RecordedRun& record) {
  watch(world, segment > leg_);
  if (segment != leg_ || laid_ >= bumps_.count) return;
  const double done_m = (inverse(start_) * X_SB).x_m;
  if (done_m < (laid_ + 0.5) / bumps_.count * length_m_) return;
  watch(world, true);
  ++laid_;
  last_ = ahead_of_wheel(world, rig);
  world.lay_cable(*last_);
  count_.without_grip += friction_at(rig.floor, last_->x_m, last_->y_m) <
                         climbing_friction(rig.robot.wheels[wheel_].radius_m, last_->height_m);
  record.bumps.push_back({last_->x_m, last_->y_m, last_->height_m});
}

// Passed: the wheel's centre is beyond the cable's axis, and was above the cable, not beside its end, when it came
// there. The cable lies across, to the left of the way it was laid.
void CableLayer::watch(const World& world, bool last_chance) {
  if (!last_) return;
  const Eigen::Vector3d wheel = world.wheel_centre(wheel_);
  const double x_m = wheel.x() - last_->x_m, y_m = wheel.y() - last_->y_m;
  const double cosine = std::cos(last_->direction_rad), sine = std::sin(last_->direction_rad);
  const bool beyond = x_m * sine - y_m * cosine > 0;
  const bool above = std::abs(x_m * cosine + y_m * sine) <= last_->length_m / 2;
  if (!beyond && !last_chance) return;
  count_.not_crossed += !(beyond && above);
  last_.reset();
}

Cable CableLayer::ahead_of_wheel(const World& world, const Rig& rig) const {
  const double heading_rad = world.pose().theta_rad;
  const double ahead_m = std::sqrt(2 * rig.robot.wheels[wheel_].radius_m * bumps_.height_m) + kLayAhead_m;
  const Eigen::Vector3d wheel = world.wheel_centre(wheel_);
  Cable cable;
  cable.x_m = wheel.x() + ahead_m * std::cos(heading_rad);
  cable.y_m = wheel.y() + ahead_m * std::sin(heading_rad);
  cable.direction_rad = heading_rad + M_PI / 2;
  cable.height_m = bumps_.height_m;
  return cable;
}

}  // namespace umbsim

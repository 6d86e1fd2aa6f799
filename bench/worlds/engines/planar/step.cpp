// The dynamics of the planar model. Base frame: x ahead, y to the left, origin under the axle's middle.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "bench/worlds/engines/planar/robot.h"
#include "core/error.h"

namespace umbsim::worlds::planar {
namespace {

constexpr double kTips_s = 0.3;  // a robot that balances on no three supports for that long is on its side

double friction_of(const Floor& floor, const Eigen::Vector2d& place_m) {
  double friction = floor.friction;
  for (const FrictionPatch& p : floor.patches) {
    if ((place_m - Eigen::Vector2d(p.x_m, p.y_m)).squaredNorm() < p.radius_m * p.radius_m) friction = p.friction;
  }
  return friction;
}

}  // namespace

// The rim's centre ahead of and below the axle.
Eigen::Vector2d PlanarRobot::rim(const WheelPart& w) {
  if (w.wheel.eccentricity_m == 0) return {0, 0};
  const double angle_rad = w.wheel.eccentricity_rad + w.drive.wheel_rad();
  return w.wheel.eccentricity_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
}

Eigen::Vector2d PlanarRobot::in_base(const Eigen::Vector2d& v) const {
  return {cos_ * v.x() + sin_ * v.y(), -sin_ * v.x() + cos_ * v.y()};
}

Eigen::Vector2d PlanarRobot::on_floor(const Eigen::Vector2d& place_m) const {
  return {X_WB_.x_m + cos_ * place_m.x() - sin_ * place_m.y(), X_WB_.y_m + sin_ * place_m.x() + cos_ * place_m.y()};
}

Eigen::Vector2d PlanarRobot::axle_velocity() const { return velocity_mps_ - yaw_radps_ * left_of(centre_m_); }

// Floor, friction and loads under every support; good for the next few steps.
void PlanarRobot::stand(double frame_s) {
  for (WheelPart& w : wheels_) {
    const Eigen::Vector2d place = on_floor(w.place_m);
    w.on = carried(floor_, place, w.wheel.radius_m);
    w.friction = friction_of(floor_, place);
  }
  load_supports(frame_s);
}

// Torques about the point of the floor under the axle's middle: friction at the floor has none.
Pressing PlanarRobot::pressing() const {
  const Eigen::Vector2d aside_n = in_base(downhill_n_) - inertia_n_;
  const Eigen::Vector2d pull_n = in_base({pull_.force_x_n, pull_.force_y_n});
  const double pull_height_m = axle_height_m_ + pull_.height_m;
  const Eigen::Vector2d moment = weight_n_ * centre_m_ + centre_height_m_ * aside_n + pull_height_m * pull_n;
  return {weight_n_, moment.x(), moment.y()};
}

void PlanarRobot::load_supports(double frame_s) {
  const double follow = 1 - std::exp(-frame_s / options_.load_time_s);
  inertia_n_ += follow * (mass_kg_ * acceleration_ - inertia_n_);
  std::vector<double>& raised = raised_m_;
  raised.clear();
  for (const WheelPart& w : wheels_) {
    raised.push_back(w.on.height_m + rim(w).y());
  }
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    supports_.move(2 + i, casters_[i].contact_m());
    raised.push_back(carried(floor_, on_floor(casters_[i].contact_m()), casters_[i].radius_m()).height_m);
  }
  const bool stands = supports_.balance(pressing(), raised);
  tipping_s_ = stands ? 0 : tipping_s_ + frame_s;
  if (tipping_s_ > kTips_s && steps_ > 0) throw RunError("planar: the robot tips over");
  for (std::size_t i = 0; i < 2; ++i) wheels_[i].load_n = std::max(0.0, supports_.loads_n()[i]);
  if (stands && steps_ > 0) pitch_radps_ = (supports_.pitch_rad() - pitch_rad_) / frame_s;
  if (stands) pitch_rad_ = supports_.pitch_rad();
}

// What a wheel takes from the floor. Its centre goes the way that the tyre rolls, up and down where the floor does, and
// the load pushes it downhill. Treads beside the wheel's middle are dragged as the robot turns.
Hold PlanarRobot::hold(WheelPart& w) {
  const Eigen::Vector2d velocity = axle_velocity() + yaw_radps_ * left_of(w.place_m);
  const Eigen::Vector2d slope = in_base(w.on.slope);
  const double uphill = slope.dot(w.ahead), aside = slope.dot(w.left), steep = std::sqrt(1 + uphill * uphill);
  const Eigen::Vector2d rim_m = rim(w);
  const double lever_m = (w.wheel.radius_m - w.wheel.compliance_mpn * w.load_n + rim_m.y()) * w.rolling_factor;
  const double rolling_mps = (w.drive.wheel_radps() + pitch_radps_) * lever_m;
  const double rolled_radps = (std::abs(wheels_[0].drive.wheel_radps()) + std::abs(wheels_[1].drive.wheel_radps())) / 2;
  const Eigen::Vector2d carpet = rolled_radps * w.wheel.radius_m * in_base(drift_);  // carries the robot, not each wheel
  Eigen::Vector2d slip((velocity - carpet).dot(w.ahead) * steep - rolling_mps, (velocity - carpet).dot(w.left));

  const double pressed_n = std::max(0.0, w.load_n * steep - w.along_n * uphill);
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  double yaw_nm = 0;
  for (Strip& strip : w.strips) {
    const Eigen::Vector2d dragged(slip.x() - yaw_radps_ * strip.beside_m, slip.y());
    const Eigen::Vector2d f =
        strip.tread.step(w.law, w.friction, strip.share * pressed_n, dragged, rolling_mps, now_step_s_);
    force += f;
    yaw_nm -= strip.beside_m * f.x();
  }
  w.along_n = force.x();
  w.grip_used = w.friction * pressed_n > 0 ? force.norm() / (w.friction * pressed_n) : 0;
  w.floor_nm = force.x() * lever_m + w.load_n * rim_m.x();
  const double ahead_n = force.x() * steep - w.load_n * uphill;
  return {ahead_n * w.ahead + (force.y() - w.load_n * aside) * w.left, w.place_m, yaw_nm};
}

void PlanarRobot::step() {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  double yaw_nm = pull_.yaw_nm;
  const auto add = [&](const Hold& h) {
    force += h.force_n;
    yaw_nm += h.yaw_nm + cross(h.at_m - centre_m_, h.force_n);
  };
  for (WheelPart& w : wheels_) add(hold(w));
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    const double load_n = std::max(0.0, supports_.loads_n()[2 + i]);
    add(casters_[i].step(axle_velocity(), yaw_radps_, floor_.friction, load_n, now_step_s_));
  }
  add({in_base({pull_.force_x_n, pull_.force_y_n}), {pull_.ahead_m, pull_.left_m}, 0});
  force += in_base(downhill_n_);
  move(force, yaw_nm);
}

// The velocity keeps its direction on the floor while the base turns under it.
void PlanarRobot::move(const Eigen::Vector2d& force_n, double yaw_nm) {
  const double h = now_step_s_;
  acceleration_ = force_n / mass_kg_;
  const Eigen::Vector2d before = axle_velocity();
  const double yaw_before = yaw_radps_;
  yaw_radps_ += h * yaw_nm / yaw_kgm2_;
  const double turned = h * (yaw_before + yaw_radps_) / 2;
  const Eigen::Vector2d kept = velocity_mps_ + h * acceleration_;
  const Eigen::Rotation2Dd half(turned / 2);
  velocity_mps_ = half.inverse() * (half.inverse() * kept);
  const Eigen::Vector2d way = half * Eigen::Vector2d(h * (before + axle_velocity()) / 2);
  X_WB_.x_m += cos_ * way.x() - sin_ * way.y();
  X_WB_.y_m += sin_ * way.x() + cos_ * way.y();
  face(X_WB_.theta_rad + turned);
}

void PlanarRobot::face(double heading_rad) {
  X_WB_.theta_rad = heading_rad;
  cos_ = std::cos(heading_rad);
  sin_ = std::sin(heading_rad);
}

double PlanarRobot::energy_j() const {
  double energy = mass_kg_ * velocity_mps_.squaredNorm() / 2 + yaw_kgm2_ * yaw_radps_ * yaw_radps_ / 2;
  for (const WheelPart& w : wheels_) {
    energy += w.drive.energy_j();
    for (const Strip& s : w.strips) {
      energy += w.law.stiffness_pm * s.share * w.load_n * s.tread.deflection_m().squaredNorm() / 2;
    }
  }
  return energy;
}

double PlanarRobot::momentum_ns() const { return mass_kg_ * velocity_mps_.norm(); }

}  // namespace umbsim::worlds::planar

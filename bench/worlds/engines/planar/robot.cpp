// Building and driving; step.cpp has the dynamics.
#include "bench/worlds/engines/planar/robot.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace umbsim::worlds::planar {
namespace {

constexpr double kSink_m = 0.0005;  // of a support under its share of the weight, where more than three share it
constexpr double kSettle_s = 0.4;
constexpr double kLongestStep_s = 0.0005;
constexpr double kPhasePerStep = 0.3;  // of the fastest oscillation
constexpr double kDecayPerStep = 0.4;  // of the fastest damping
constexpr double kGravity_mps2 = 9.81;

// A wheel that turns on the spot slides everywhere but close to its middle: strips are narrow there.
std::vector<Strip> strips_across(double width_m) {
  if (width_m <= 0) return {{}};
  constexpr double kEdges[] = {0, 0.1, 0.3, 0.6, 1};
  std::vector<Strip> strips;
  for (int i = 0; i < 4; ++i) {
    for (const int side : {-1, 1}) {
      strips.push_back({{}, side * (kEdges[i] + kEdges[i + 1]) / 4 * width_m, (kEdges[i + 1] - kEdges[i]) / 2});
    }
  }
  return strips;
}

}  // namespace

PlanarRobot::PlanarRobot(const Rig& rig, const PlanarOptions& options, const Pose2& X_WB)
    : options_(options), floor_(rig.floor), drift_(rig.floor.drift_x, rig.floor.drift_y) {
  face(X_WB.theta_rad);
  add_masses(rig);
  weight_n_ = mass_kg_ * kGravity_mps2 * std::cos(floor_.slope_rad);
  downhill_n_ = mass_kg_ * kGravity_mps2 * std::sin(floor_.slope_rad) *
                Eigen::Vector2d(std::cos(floor_.downhill_rad), std::sin(floor_.downhill_rad));
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < 2; ++i) {
    add_wheel(rig.robot.wheels[i], rig.drivetrain.motor[i], rig);
    places.push_back(wheels_[i].place_m);
  }
  for (const Caster& c : rig.robot.casters) {
    casters_.emplace_back(c, law_of(c.radius_m, 0, 0));
    places.push_back(casters_.back().contact_m());
  }
  supports_ = Supports(places, mass_kg_ * kGravity_mps2, kSink_m);
  X_WB_ = X_WB;
  settle();
}

void PlanarRobot::add_masses(const Rig& rig) {
  const RobotModel& r = rig.robot;
  axle_height_m_ = (r.wheels[0].radius_m + r.wheels[1].radius_m) / 2;
  struct Mass {
    double kg;
    Eigen::Vector2d place_m;
    double height_m;
    double yaw_kgm2;
  };
  std::vector<Mass> masses{{r.base.mass_kg, flat(r.base.com_m), r.base.com_m.z(), r.base.inertia_kgm2(2, 2)}};
  for (const umbsim::Wheel& w : r.wheels) masses.push_back({w.mass_kg, flat(w.centre_m), 0, w.transverse_inertia_kgm2});
  for (const Caster& c : r.casters) {
    const CasterPart part(c, {});
    masses.push_back({part.mass_kg(), part.mass_place_m(), c.radius_m - axle_height_m_, 0});
  }
  for (const Mass& m : masses) {
    mass_kg_ += m.kg;
    centre_m_ += m.kg * m.place_m;
    centre_height_m_ += m.kg * (m.height_m + axle_height_m_);
  }
  centre_m_ /= mass_kg_;
  centre_height_m_ /= mass_kg_;
  for (const Mass& m : masses) yaw_kgm2_ += m.yaw_kgm2 + m.kg * (m.place_m - centre_m_).squaredNorm();
}

// Creep and relaxation length give the tread's stiffness: a slip s over the length L deflects by s L.
TyreLaw PlanarRobot::law_of(double radius_m, double along, double across) const {
  TyreLaw law;
  law.curve = options_.curve;
  law.stiffness_pm = 1 / (options_.creep * options_.relaxation_over_radius * radius_m);
  law.damping_spm = 2 * options_.contact_damping_ratio * std::sqrt(law.stiffness_pm / kGravity_mps2);
  law.creep_along = options_.creep + along;
  law.creep_across = options_.creep + across;
  return law;
}

void PlanarRobot::add_wheel(const umbsim::Wheel& wheel, const Motor& motor, const Rig& rig) {
  const double kg = options_.tuned_kg > 0 ? options_.tuned_kg : rig.robot.total_mass_kg();
  const double moved_kgm2 = wheel.spin_inertia_kgm2 + kg * wheel.radius_m * wheel.radius_m / 2;
  const Servo servo{moved_kgm2 / options_.servo_time_s, options_.integral_time_s,
                    options_.rotor_over_wheel * wheel.spin_inertia_kgm2};
  const Eigen::Vector2d ahead = Eigen::Vector2d(wheel.axis.y(), -wheel.axis.x()).normalized();
  WheelPart part{wheel, Drive(motor, servo, wheel.spin_inertia_kgm2), SetPoint(motor),
                 law_of(wheel.radius_m, wheel.creep_along, wheel.creep_across)};
  part.strips = strips_across(wheel.patch_width_m);
  part.place_m = flat(wheel.centre_m);
  part.ahead = ahead;
  part.left = {-ahead.y(), ahead.x()};
  wheels_.push_back(std::move(part));
}

// Short enough for every spring of this robot under the loads at rest.
void PlanarRobot::choose_step() {
  double fastest_radps = 0, decay_ps = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const WheelPart& w = wheels_[i];
    const double turned_kg = w.drive.floor_side_kgm2() / (w.wheel.radius_m * w.wheel.radius_m);
    fastest_radps = std::max(fastest_radps, std::sqrt(w.law.stiffness_pm * w.load_n / turned_kg));
    decay_ps = std::max(decay_ps, w.law.damping_spm * w.load_n / turned_kg);
  }
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    fastest_radps = std::max(fastest_radps, casters_[i].stiffest_radps(supports_.loads_n()[2 + i]));
  }
  step_s_ = options_.step_share * std::min({kLongestStep_s, kPhasePerStep / fastest_radps, kDecayPerStep / decay_ps});
}

void PlanarRobot::settle() {
  const Pose2 start = X_WB_;
  stand(1);
  if (tipping_s_ > 0 || wheels_[0].load_n <= 0 || wheels_[1].load_n <= 0) {
    throw RunError("planar: the robot does not stand on its wheels");
  }
  choose_step();
  advance({0, 0}, kSettle_s);
  X_WB_ = start;
  face(start.theta_rad);
  for (WheelPart& w : wheels_) {
    w.zero_wheel_rad = w.drive.wheel_rad();
    w.zero_shaft_rad = w.drive.shaft_rad();
  }
  steps_ = 0;
}

void PlanarRobot::advance(const std::array<double, 2>& command_radps, double duration_s) {
  constexpr int kStepsPerFrame = 4;
  const int n = std::max(1, int(std::ceil(duration_s / step_s_ - 1e-6)));
  now_step_s_ = duration_s / n;
  for (int k = 0; k < n; ++k) {
    if (k % kStepsPerFrame == 0) stand(std::min(kStepsPerFrame, n - k) * now_step_s_);
    for (std::size_t i = 0; i < 2; ++i) {
      WheelPart& w = wheels_[i];
      w.drive.step(w.set_point.step(command_radps[i], double(k + 1) / n, now_step_s_), w.floor_nm, now_step_s_);
    }
    step();
  }
  for (std::size_t i = 0; i < 2; ++i) wheels_[i].set_point.arrive(command_radps[i]);
  steps_ += n;
  if (!std::isfinite(X_WB_.x_m) || !std::isfinite(X_WB_.theta_rad)) {
    throw RunError("planar: the state became non-finite");
  }
}

double PlanarRobot::wheel_angle(int wheel) const {
  const WheelPart& w = wheels_[std::size_t(wheel)];
  return w.drive.wheel_rad() - w.zero_wheel_rad;
}

double PlanarRobot::encoder_angle(int wheel) const {
  const WheelPart& w = wheels_[std::size_t(wheel)];
  return w.drive.shaft_rad() - w.zero_shaft_rad;
}

double PlanarRobot::tilt_rad() const { return std::hypot(supports_.pitch_rad(), supports_.roll_rad()); }

}  // namespace umbsim::worlds::planar

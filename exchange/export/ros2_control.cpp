#include "exchange/export/ros2_control.h"

#include <fmt/format.h>

#include "core/error.h"

namespace umbsim::exchange {
namespace {

constexpr double kWay_m = 1;          // after which the covariance is stated
constexpr double kNotOdometry = 1e6;  // of what wheels on a floor do not measure, as robot_localization expects it
constexpr int kSteps = 100;

std::string interval(const CalibratedOdometry& c, const std::string& name, double over) {
  const auto found = c.intervals.find(name);
  if (found == c.intervals.end()) return "no interval: too few runs, or a form that gives none";
  return fmt::format("95 %: {:.6f} to {:.6f}", found->second.low / over, found->second.high / over);
}

// Of a straight way, with the odometry's own propagation.
PoseCovariance after_way(const CalibratedOdometry& c) {
  PoseCovariance P = PoseCovariance::Zero();
  Pose2 X_OB;
  const double step = kWay_m / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    P = after_arc(P, arc_jacobians(X_OB, step, step, c.calibrated.wheelbase_m), step, step, *c.noise);
    X_OB = X_OB * arc(step, 0);
  }
  return P;
}

std::string covariances(const CalibratedOdometry& c) {
  if (!c.noise) return "    # pose_covariance_diagonal: not known (needs repeated runs)\n";
  const PoseCovariance P = after_way(c);
  return fmt::format(
      "    # After {:g} m straight ahead, in m^2 and rad^2: k_L {:.3g}, k_R {:.3g} m per sqrt(m), from\n"
      "    # {}. x, y, z, roll, pitch, yaw.\n"
      "    pose_covariance_diagonal: [{:.3e}, {:.3e}, {:.1e}, {:.1e}, {:.1e}, {:.3e}]\n",
      kWay_m, c.noise->left_m_per_sqrt_m, c.noise->right_m_per_sqrt_m, c.noise_from, P(0, 0), P(1, 1), kNotOdometry,
      kNotOdometry, kNotOdometry, P(2, 2));
}

}  // namespace

std::string ros2_control_yaml(const Result& r, const std::string& left_joint, const std::string& right_joint) {
  if (!r.calibration) {
    throw InputError(SourceMark{r.folder},
                     "holds no calibration: export what `umbsim calibrate` or `umbsim run` wrote");
  }
  const CalibratedOdometry& c = *r.calibration;
  const double radius = (c.nominal.left_radius_m + c.nominal.right_radius_m) / 2;
  std::string text = fmt::format(
      "# Odometry calibrated by umbsim {} ({} form) on {}.\n"
      "# Multipliers are calibrated over nominal; what follows is for ros2_controllers' diff_drive_controller.\n"
      "diff_drive_controller:\n  ros__parameters:\n",
      r.version, c.method, r.input.empty() ? r.folder : r.input);
  if (left_joint.empty()) {
    text += "    # left_wheel_names and right_wheel_names: keep your own\n";
  } else {
    text += fmt::format("    left_wheel_names: [\"{}\"]\n    right_wheel_names: [\"{}\"]\n", left_joint, right_joint);
  }
  text += fmt::format("    wheel_separation: {:.9f}\n    wheel_radius: {:.9f}\n", c.nominal.wheelbase_m, radius);
  text +=
      fmt::format("    wheel_separation_multiplier: {:.9f}  # {}\n", c.calibrated.wheelbase_m / c.nominal.wheelbase_m,
                  interval(c, "wheelbase_m", c.nominal.wheelbase_m));
  text += fmt::format("    left_wheel_radius_multiplier: {:.9f}  # {}\n", c.calibrated.left_radius_m / radius,
                      interval(c, "left_radius_m", radius));
  text += fmt::format("    right_wheel_radius_multiplier: {:.9f}  # {}\n", c.calibrated.right_radius_m / radius,
                      interval(c, "right_radius_m", radius));
  return text + covariances(c);
}

}  // namespace umbsim::exchange

#pragma once

#include <cmath>

namespace umbsim {

/// A pose in the plane: position in metres, heading in radians counter-clockwise, not wrapped.
/// A name X_AB reads "pose of frame B seen from frame A" (docs/conventions.md).
struct Pose2 {
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;
};

/// X_AC = X_AB * X_BC.
inline Pose2 operator*(const Pose2& X_AB, const Pose2& X_BC) {
  const double c = std::cos(X_AB.theta_rad);
  const double s = std::sin(X_AB.theta_rad);
  return {X_AB.x_m + c * X_BC.x_m - s * X_BC.y_m, X_AB.y_m + s * X_BC.x_m + c * X_BC.y_m,
          X_AB.theta_rad + X_BC.theta_rad};
}

/// X_BA from X_AB.
inline Pose2 inverse(const Pose2& X_AB) {
  const double c = std::cos(X_AB.theta_rad);
  const double s = std::sin(X_AB.theta_rad);
  return {-c * X_AB.x_m - s * X_AB.y_m, s * X_AB.x_m - c * X_AB.y_m, -X_AB.theta_rad};
}

/// The angle in (-pi, pi].
inline double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2 * M_PI);
  return wrapped <= -M_PI ? wrapped + 2 * M_PI : wrapped;
}

/// sin(x)/x, by its series where the quotient would lose digits.
inline double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
}

/// The relative pose after an arc of length `ds_m` that turns by `dtheta_rad`: the arc taken as a chord,
/// exact for any angle.
inline Pose2 arc(double ds_m, double dtheta_rad) {
  if (dtheta_rad == 0) return {ds_m, 0, 0};
  if (ds_m == 0) return {0, 0, dtheta_rad};
  const double chord = ds_m * sinc(dtheta_rad / 2);
  return {chord * std::cos(dtheta_rad / 2), chord * std::sin(dtheta_rad / 2), dtheta_rad};
}

inline double degrees(double radians) { return radians * 180 / M_PI; }
inline double radians(double degrees) { return degrees * M_PI / 180; }

}  // namespace umbsim

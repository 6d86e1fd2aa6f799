#include "exchange/import/truth/planar_track.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace umbsim::exchange {
namespace {

constexpr double kNotUnit = 0.01;  // of a quaternion's length
constexpr double kLevel = 0.8;     // cosine of the steepest tilt of a robot on a floor

// Rotations that take the axis to +z and keep a right-handed frame. Cameras look along +z with y down: their forward
// becomes x.
std::array<double, 9> levelled(const std::string& up) {
  if (up == "-z") return {1, 0, 0, 0, -1, 0, 0, 0, -1};
  if (up == "+y") return {0, 0, 1, 1, 0, 0, 0, 1, 0};
  if (up == "-y") return {0, 0, 1, -1, 0, 0, 0, -1, 0};
  if (up == "+x") return {0, 1, 0, 0, 0, 1, 1, 0, 0};
  if (up == "-x") return {0, 1, 0, 0, 0, -1, -1, 0, 0};
  return {1, 0, 0, 0, 1, 0, 0, 0, 1};
}

std::array<double, 9> rotation(const std::array<double, 4>& q) {
  const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const double x = q[0], y = q[1], z = q[2], w = q[3], s = 2 / n;
  return {1 - s * (y * y + z * z), s * (x * y - z * w),     s * (x * z + y * w),
          s * (x * y + z * w),     1 - s * (x * x + z * z), s * (y * z - x * w),
          s * (x * z - y * w),     s * (y * z + x * w),     1 - s * (x * x + y * y)};
}

std::array<double, 9> product(const std::array<double, 9>& a, const std::array<double, 9>& b) {
  std::array<double, 9> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    }
  }
  return c;
}

std::array<double, 9> transposed(const std::array<double, 9>& a) {
  return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
}

}  // namespace

const std::array<const char*, 6>& up_axes() {
  static const std::array<const char*, 6> axes = {"+z", "-z", "+y", "-y", "+x", "-x"};
  return axes;
}

PlanarTrack::PlanarTrack(std::string name, const std::string& up) : R_(levelled(up)), up_(up) {
  track_.name = std::move(name);
}

void PlanarTrack::add(Nanoseconds at, const std::array<double, 3>& p, const std::array<double, 4>& q,
                      const std::function<std::string()>& where) {
  double length2 = 0;
  for (const double v : p) {
    if (!std::isfinite(v)) throw InputError(where() + ": the position is not finite");
  }
  for (const double v : q) {
    if (!std::isfinite(v)) throw InputError(where() + ": the orientation is not finite");
    length2 += v * v;
  }
  if (std::abs(std::sqrt(length2) - 1) > kNotUnit) {
    throw InputError(fmt::format("{}: the quaternion has length {:.4g} (must be 1)", where(), std::sqrt(length2)));
  }
  const std::array<double, 9> X = product(product(R_, rotation(q)), transposed(R_));
  if (X[8] < kLevel) {
    throw InputError(fmt::format(
        "{}: the tracked body is tilted by {:.0f} degrees, as axis {} of the tracker is taken to point up: give the "
        "axis that does with --up (+y: many motion capture systems, -y: cameras)",
        where(), std::acos(std::max(-1.0, std::min(1.0, X[8]))) * 180 / M_PI, up_));
  }
  const Pose2 pose{R_[0] * p[0] + R_[1] * p[1] + R_[2] * p[2], R_[3] * p[0] + R_[4] * p[1] + R_[5] * p[2],
                   std::atan2(X[3], X[0])};
  Pose2 unwrapped = pose;
  if (!track_.pose.empty()) {
    const double before = track_.pose.back().theta_rad;
    unwrapped.theta_rad = before + wrap_angle(pose.theta_rad - before);
  }
  append(at, unwrapped, where);
}

void PlanarTrack::add(Nanoseconds at, const Pose2& pose, const std::function<std::string()>& where) {
  if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m) || !std::isfinite(pose.theta_rad)) {
    throw InputError(where() + ": the pose is not finite");
  }
  append(at, pose, where);
}

void PlanarTrack::append(Nanoseconds at, const Pose2& pose, const std::function<std::string()>& where) {
  if (!track_.at.empty() && at <= track_.at.back()) {
    const Pose2& before = track_.pose.back();
    const bool same = at == track_.at.back() && std::abs(pose.x_m - before.x_m) < 1e-9 &&
                      std::abs(pose.y_m - before.y_m) < 1e-9 && std::abs(pose.theta_rad - before.theta_rad) < 1e-9;
    if (!same) {
      throw InputError(fmt::format("{}: its time stamp, {:.6f} s, does not come after the one before, {:.6f} s: {}",
                                   where(), double(at) * 1e-9, double(track_.at.back()) * 1e-9,
                                   "stamps must increase; two senders on one name, or two logs in one?"));
    }
    ++repeated_;
    return;
  }
  track_.at.push_back(at);
  track_.pose.push_back(pose);
}

Track PlanarTrack::take() { return std::move(track_); }

}  // namespace umbsim::exchange

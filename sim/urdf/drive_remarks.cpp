#include "sim/urdf/drive_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sim/urdf/swivels.h"
#include "sim/urdf/wheel_shape.h"

namespace umbsim {
namespace {

bool names(const std::string& text, const char* side) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower.find(side) != std::string::npos;
}

// 1: says left, 2: says right, 0: neither or both.
int side_named(const Body& body) {
  for (const std::string& name : {body.joint, body.link}) {
    const bool left = names(name, "left"), right = names(name, "right");
    if (left != right) return left ? 1 : 2;
  }
  return 0;
}

}  // namespace

bool rolls_as_caster(const UrdfSource& source, const Body& body) {
  constexpr double kSlippery = 0.1;
  return is_called_caster(body.joint) || is_called_caster(body.link) ||
         source.friction(body.link).value_or(1) <= kSlippery;
}

bool is_limited_wheel(const Body& body) {
  return body.revolute && !body.continuous && (names(body.joint, "wheel") || names(body.link, "wheel"));
}

int steered_by(const std::vector<Body>& bodies, int index) {
  for (int i = bodies[index].parent; i > 0; i = bodies[i].parent) {
    if (bodies[i].revolute && !bodies[i].continuous && is_vertical(bodies[i].axis)) return i;
  }
  return 0;
}

int left_by_name(const UrdfSource& source, const std::vector<Body>& bodies,
                 const std::pair<RollingWheel, RollingWheel>& pair) {
  const int first = side_named(bodies[pair.first.body]), second = side_named(bodies[pair.second.body]);
  if (first == 0 || second == 0 || first == second) return 0;
  const RollingWheel &left = first == 1 ? pair.first : pair.second, &right = first == 1 ? pair.second : pair.first;
  source.remark(Remark::Kind::understood,
                fmt::format("the axle lies along x of the root; by the names of {} and {} the robot faces {}y",
                            source.joint_text(bodies[left.body].joint), source.joint_text(bodies[right.body].joint),
                            left.centre_m.x() < right.centre_m.x() ? '+' : '-'));
  return first;
}

void remark_drive(const UrdfSource& source, const std::vector<Body>& bodies, const Drive& drive) {
  using Kind = Remark::Kind;
  constexpr const char* kSides[] = {"left", "right"};
  for (int side = 0; side < 2; ++side) {
    const RollingWheel& wheel = drive.wheels[side];
    const std::string joint = source.joint_text(bodies[wheel.body].joint);
    if (names(bodies[wheel.body].joint, kSides[1 - side])) {
      source.remark(Kind::understood,
                    fmt::format("{}: it is the {} wheel by its place (y = {:.4g} m in the root), its name "
                                "says {}",
                                joint, kSides[side], wheel.centre_m.y(), kSides[1 - side]));
    }
    if (is_limited_wheel(bodies[wheel.body])) {
      source.remark(Kind::assumed,
                    joint + ": a wheel on a revolute joint with limits, taken as one that turns for ever");
    }
    if (wheel.taken_from.empty()) continue;
    source.remark(Kind::assumed, fmt::format("{}: wheel radius {:.4g} m, width {:.4g} m from {}", joint, wheel.radius_m,
                                             wheel.width_m, wheel.taken_from));
  }
  const double left_m = drive.wheels[0].radius_m, right_m = drive.wheels[1].radius_m;
  if (left_m != right_m) {
    source.remark(Kind::understood,
                  fmt::format("the URDF's wheel radii differ: left {:g} m, right {:g} m", left_m, right_m));
  }
}

}  // namespace umbsim

#include "sim/urdf/swivels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sim/urdf/wheel_shape.h"

namespace umbsim {
namespace {

constexpr double kParallel_rad = 0.1;
// Two wheels of one caster have one radius and one axle, within this share of the radius.
constexpr double kSameAxle = 0.05;
// A caster wheel is at most this many drive wheel radii high.
constexpr double kLargest_radii = 1.5;

// On a continuous horizontal joint of the fork; joints that are held may lie between them.
bool rolls_in(const std::vector<Body>& bodies, int index, int top) {
  if (!bodies[index].continuous || !is_horizontal(bodies[index].axis)) return false;
  int i = bodies[index].parent;
  while (i > 0 && i != top && !bodies[i].continuous) i = bodies[i].parent;
  return i == top;
}

FoundSupport fork_of(const std::vector<Body>& bodies, int top, const std::string& link) {
  FoundSupport support;
  support.fork = support.body = top;
  support.caster.link = link;
  support.caster.swivels = true;
  support.caster.swivel_point_m = bodies[top].origin_m;
  return support;
}

std::vector<int> bodies_of(const std::vector<std::pair<int, Shape>>& touching) {
  std::vector<int> indices;
  for (const auto& [index, shape] : touching) {
    if (std::find(indices.begin(), indices.end(), index) == indices.end()) indices.push_back(index);
  }
  return indices;
}

RollingWheel rolling(const UrdfSource& source, const std::vector<Body>& bodies, int index) {
  const WheelShape found = wheel_shape(source, bodies, index);
  if (!found.fault.empty()) source.fail_at_joint(bodies[index].joint, "cannot be a caster wheel: " + found.fault);
  return found.wheel;
}

// Wheels on one axle, which turn as they like: together they roll as one wheel in their middle, as they do in a turn.
void join_twins(const UrdfSource& source, const std::vector<Body>& bodies, const std::vector<int>& wheels,
                FoundSupport& support) {
  const RollingWheel first = rolling(source, bodies, wheels[0]);
  Eigen::Vector3d low = first.centre_m, high = first.centre_m;
  for (std::size_t i = 1; i < wheels.size(); ++i) {
    const Body& body = bodies[wheels[i]];
    const RollingWheel other = rolling(source, bodies, wheels[i]);
    const Eigen::Vector3d line = other.centre_m - first.centre_m;
    const Eigen::Vector3d& axis = bodies[wheels[0]].axis;
    const double off_m = (line - line.dot(axis) * axis).norm();
    if (axis.cross(body.axis).norm() > std::sin(kParallel_rad) || off_m > kSameAxle * first.radius_m ||
        std::abs(other.radius_m - first.radius_m) > kSameAxle * first.radius_m) {
      source.fail_at_link(body.link,
                          fmt::format("a second wheel on the floor behind the swivel {}, not beside the first on one "
                                      "axle with one radius; a caster has one wheel, or twins",
                                      source.joint_text(bodies[support.fork].joint)));
    }
    low = low.cwiseMin(other.centre_m);
    high = high.cwiseMax(other.centre_m);
    support.twins.push_back(wheels[i]);
  }
  support.wheel = wheels[0];
  support.caster.centre_m = (low + high) / 2;
  support.caster.radius_m = first.radius_m;
  if (wheels.size() > 1) {
    source.remark(Remark::Kind::understood, fmt::format("{}: {} wheels on one axle, taken as one in their middle",
                                                        source.joint_text(bodies[support.fork].joint), wheels.size()));
  }
}

}  // namespace

bool is_called_caster(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower.find("caster") != std::string::npos || lower.find("castor") != std::string::npos;
}

FoundSupport swivelling_support(const UrdfSource& source, const std::vector<Body>& bodies, int top,
                                const std::vector<std::pair<int, Shape>>& touching) {
  const Shape& shape = touching[0].second;
  FoundSupport support = fork_of(bodies, top, shape.link);
  const std::vector<int> wheels = bodies_of(touching);
  if (wheels == std::vector<int>{top} && shape.kind != Shape::Kind::box) {  // no wheel turns, the fork slides on it
    for (const auto& [index, part] : touching) support.caster.centre_m += part.centre_m() / double(touching.size());
    support.caster.radius_m = shape.radius_m;
    return support;
  }
  for (const int wheel : wheels) {
    if (rolls_in(bodies, wheel, top)) continue;
    source.fail_at_link(bodies[wheel].link,
                        "stands on the floor behind a swivel, but is neither a ball on the swivel axis "
                        "nor a wheel on a continuous horizontal joint of the fork");
  }
  join_twins(source, bodies, wheels, support);
  return support;
}

std::optional<FoundSupport> swivel_by_axle(const UrdfSource& source, const std::vector<Body>& bodies, int top,
                                           double wheel_radius_m) {
  for (int i = top + 1; i < int(bodies.size()); ++i) {
    if (!rolls_in(bodies, i, top)) continue;
    const double height_m = bodies[i].origin_m.z() + wheel_radius_m;
    if (!(height_m > 0) || height_m > kLargest_radii * wheel_radius_m) continue;
    FoundSupport support = fork_of(bodies, top, bodies[i].link);
    support.wheel = i;
    support.caster.centre_m = bodies[i].origin_m;
    support.caster.radius_m = height_m;
    source.remark(Remark::Kind::assumed,
                  fmt::format("{}: a caster wheel of radius {:.4g} m, which is the height of its "
                              "axle above the floor",
                              source.joint_text(bodies[i].joint), height_m));
    return support;
  }
  return std::nullopt;
}

}  // namespace umbsim

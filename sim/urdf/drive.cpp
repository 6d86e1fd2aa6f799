#include "sim/urdf/drive.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/urdf/drive_remarks.h"

namespace umbsim {
namespace {

constexpr double kCollinear_rad = 0.01;
constexpr double kRadiusRatio = 0.05;

struct Candidates {
  std::vector<RollingWheel> on_floor;
  std::vector<std::pair<int, std::string>> faults;  ///< body and why it cannot be a wheel
};

// Behind no other continuous joint: the wheels of a caster are not drive wheels.
bool can_drive(const std::vector<Body>& bodies, int index, bool revolute = false) {
  const bool turns = bodies[index].continuous || (revolute && is_limited_wheel(bodies[index]));
  if (!turns || !is_horizontal(bodies[index].axis)) return false;
  for (int i = bodies[index].parent; i > 0; i = bodies[i].parent) {
    if (bodies[i].continuous) return false;
  }
  return true;
}

// Balls are often given a joint as if they were wheels, and casters a wheel that rolls but does not swivel, without
// friction in Gazebo. Beside two wheels they are casters.
void drop_casters(const UrdfSource& source, const std::vector<Body>& bodies, std::vector<RollingWheel>& wheels) {
  const auto is_ball = [&](const RollingWheel& wheel) {
    const auto& shapes = bodies[wheel.body].shapes;
    return !shapes.empty() && shapes[0].kind == Shape::Kind::sphere;
  };
  const auto drop = [&](const auto& is_one, Remark::Kind kind, const char* why) {
    if (wheels.size() < 3 || wheels.size() - std::size_t(std::count_if(wheels.begin(), wheels.end(), is_one)) < 2)
      return;
    for (const RollingWheel& wheel : wheels) {
      if (is_one(wheel)) source.remark(kind, source.joint_text(bodies[wheel.body].joint) + why);
    }
    std::erase_if(wheels, is_one);
  };
  drop(is_ball, Remark::Kind::understood, ": a ball beside two wheels is a caster, whatever its joint");
  drop([&](const RollingWheel& wheel) { return rolls_as_caster(source, bodies[wheel.body]); }, Remark::Kind::assumed,
       ": a caster by its name or its friction in Gazebo, whose wheel does not swivel: taken as a ball");
}

Candidates find_candidates(const UrdfSource& source, const std::vector<Body>& bodies, const WheelSize& size,
                           bool revolute = false) {
  Candidates found;
  double floor = std::numeric_limits<double>::infinity();
  for (int i = 1; i < int(bodies.size()); ++i) {
    if (!can_drive(bodies, i, revolute)) continue;
    WheelShape shape = wheel_shape(source, bodies, i, size);
    if (!shape.fault.empty()) {
      found.faults.emplace_back(i, shape.fault);
    } else {
      found.on_floor.push_back(shape.wheel);
      floor = std::min(floor, shape.wheel.lowest_m());
    }
  }
  std::erase_if(found.on_floor, [&](const RollingWheel& wheel) {
    return wheel.lowest_m() > floor + kFloorTolerance_radii * wheel.radius_m;  // a brush, a conveyor roller
  });
  drop_casters(source, bodies, found.on_floor);
  return found;
}

std::string joint_list(const std::vector<Body>& bodies, const std::vector<RollingWheel>& wheels) {
  std::vector<std::string> names;
  for (const RollingWheel& wheel : wheels) names.push_back("'" + bodies[wheel.body].joint + "'");
  return fmt::format("{}", fmt::join(names, ", "));
}

double angle_rad(const Eigen::Vector3d& line, const Eigen::Vector3d& axis) {
  return std::atan2(line.cross(axis).norm(), std::abs(line.dot(axis)));
}

// The larger angle between the line through both centres and either joint axis.
double misalignment_rad(const std::vector<Body>& bodies, const RollingWheel& a, const RollingWheel& b) {
  const Eigen::Vector3d line = a.centre_m - b.centre_m;
  return std::max(angle_rad(line, bodies[a.body].axis), angle_rad(line, bodies[b.body].axis));
}

using Pair = std::pair<RollingWheel, RollingWheel>;

std::vector<Pair> collinear_pairs(const std::vector<Body>& bodies, const std::vector<RollingWheel>& wheels) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    for (std::size_t j = i + 1; j < wheels.size(); ++j) {
      if (misalignment_rad(bodies, wheels[i], wheels[j]) <= kCollinear_rad) pairs.emplace_back(wheels[i], wheels[j]);
    }
  }
  return pairs;
}

[[noreturn]] void refuse_more_wheels(const UrdfSource& source, const std::vector<Body>& bodies,
                                     const std::vector<RollingWheel>& on_floor, const Pair& drive) {
  std::vector<RollingWheel> others = on_floor;
  std::erase_if(others, [&](const auto& w) { return w.body == drive.first.body || w.body == drive.second.body; });
  for (const RollingWheel& wheel : on_floor) {
    const int steering = steered_by(bodies, wheel.body);
    if (steering == 0) continue;
    source.fail_at_joint(bodies[wheel.body].joint,
                         fmt::format("a wheel that is steered, by {}: a car is no differential drive (a caster swivels "
                                     "on a continuous joint)",
                                     source.joint_text(bodies[steering].joint)));
  }
  for (const RollingWheel& other : others) {
    for (const RollingWheel& wheel : {drive.first, drive.second}) {
      if (collinear_pairs(bodies, {wheel, other}).empty()) continue;
      source.fail_at_joint(bodies[other.body].joint,
                           fmt::format("two candidates for a wheel: it is collinear with the drive joints {} too; a "
                                       "differential drive has one wheel a side",
                                       joint_list(bodies, {drive.first, drive.second})));
    }
  }
  if (others.size() == 1) {
    source.fail_at_joint(bodies[others[0].body].joint,
                         fmt::format("a third wheel on the floor beside the drive joints {}, neither driven nor "
                                     "swivelling: make the joint fixed with a <sphere> (a ball caster), or put it "
                                     "behind a continuous upright swivel joint",
                                     joint_list(bodies, {drive.first, drive.second})));
  }
  source.fail(
      fmt::format("{} driven wheels (joints {}): skid steering is not supported; a differential drive has two "
                  "wheels on one axle and casters",
                  on_floor.size() == 4 ? "four" : std::to_string(on_floor.size()), joint_list(bodies, on_floor)));
}

[[noreturn]] void refuse_too_few(const UrdfSource& source, const std::vector<Body>& bodies, const Candidates& found) {
  if (!found.faults.empty()) {
    source.fail_at_joint(bodies[found.faults[0].first].joint, "cannot be a drive wheel: " + found.faults[0].second);
  }
  if (found.on_floor.empty()) {
    source.fail(
        "no drive wheels: no continuous joint with a horizontal axis (revolute ones do not count); a differential "
        "drive has two");
  }
  source.fail_at_joint(bodies[found.on_floor[0].body].joint,
                       "the only continuous joint with a wheel on the floor; a differential drive has two");
}

Pair automatic_pair(const UrdfSource& source, const std::vector<Body>& bodies, const Candidates& found) {
  if (found.on_floor.size() < 2) refuse_too_few(source, bodies, found);
  const std::vector<Pair> pairs = collinear_pairs(bodies, found.on_floor);
  if (!pairs.empty()) return pairs[0];
  const RollingWheel& a = found.on_floor[0];
  const RollingWheel& b = found.on_floor[1];
  source.fail_at_joint(
      bodies[b.body].joint,
      fmt::format("not collinear with {}: an axis is {:.3g} rad off the line between the wheel centres "
                  "(at most {:g})",
                  source.joint_text(bodies[a.body].joint), misalignment_rad(bodies, a, b), kCollinear_rad));
}

RollingWheel named_wheel(const UrdfSource& source, const std::vector<Body>& bodies, const std::string& joint,
                         const WheelSize& size) {
  const auto named = [&](const Body& body) { return body.joint == joint; };
  const int index = int(std::find_if(bodies.begin() + 1, bodies.end(), named) - bodies.begin());
  if (index == int(bodies.size()) || !bodies[index].continuous) {
    std::vector<std::string> names;
    for (const Body& body : bodies) {
      if (body.continuous) names.push_back("'" + body.joint + "'");
    }
    const std::string choices = fmt::format("continuous joints: {}", fmt::join(names, ", "));
    if (source.model().getJoint(joint)) source.fail_at_joint(joint, "a drive joint must be continuous; " + choices);
    source.fail(fmt::format("drive joint '{}' does not exist; {}", joint, choices));
  }
  if (!can_drive(bodies, index)) {
    source.fail_at_joint(joint, "cannot drive: its axis is not horizontal, or it is behind another continuous joint");
  }
  WheelShape shape = wheel_shape(source, bodies, index, size);
  if (!shape.fault.empty()) source.fail_at_joint(joint, "cannot be a drive wheel: " + shape.fault);
  return shape.wheel;
}

Pair named_pair(const UrdfSource& source, const std::vector<Body>& bodies, const DriveJoints& joints,
                const WheelSize& size) {
  if (joints.left.empty() || joints.right.empty() || joints.left == joints.right) {
    source.fail(fmt::format("name both drive joints or none: left is '{}', right is '{}'", joints.left, joints.right));
  }
  Pair pair{named_wheel(source, bodies, joints.left, size), named_wheel(source, bodies, joints.right, size)};
  const double off = misalignment_rad(bodies, pair.first, pair.second);
  if (off > kCollinear_rad) {
    source.fail_at_joint(joints.right,
                         fmt::format("not collinear with {}: an axis is {:.3g} rad off the line between the wheel "
                                     "centres (at most {:g})",
                                     source.joint_text(joints.left), off, kCollinear_rad));
  }
  return pair;
}

// Left is the +y side of the root link. An axle along its x leaves open which way is forward; names tell.
Drive with_sides(const UrdfSource& source, const std::vector<Body>& bodies, Pair pair, bool named) {
  const Eigen::Vector3d line = pair.first.centre_m - pair.second.centre_m;
  const std::string root = source.link_text(bodies[0].link);
  const bool across = std::abs(line.x()) > std::abs(line.y());
  const int by_name = across && !named ? left_by_name(source, bodies, pair) : 0;
  if (by_name == 2) std::swap(pair.first, pair.second);
  if (across && !named && by_name == 0) {
    source.fail(
        fmt::format("the axle of joints {} lies along x of the root {}, which should point forward: name the "
                    "left and right drive joints",
                    joint_list(bodies, {pair.first, pair.second}), root));
  }
  if (!across && line.y() < 0) {
    if (named) {
      source.fail_at_joint(bodies[pair.first.body].joint,
                           fmt::format("named left, but it lies on the right of {} in the root {} (x forward, y left)",
                                       source.joint_text(bodies[pair.second.body].joint), root));
    }
    std::swap(pair.first, pair.second);
  }
  return {{pair.first, pair.second}};
}

// Wheels are this large; else the file's lengths have another unit.
void check_size(const UrdfSource& source, const Body& body, const RollingWheel& wheel) {
  constexpr double kSmallest_m = 0.001, kLargest_m = 2;
  if (wheel.radius_m >= kSmallest_m && wheel.radius_m <= kLargest_m) return;
  source.fail_at_joint(
      body.joint, fmt::format("wheel radius {:g} m{}; it must be in [{:g}, {:g}]. URDF is in metres: is "
                              "a length, or the scale of a mesh, for millimetres?",
                              wheel.radius_m, wheel.taken_from.empty() ? "" : " from " + wheel.taken_from, kSmallest_m,
                              kLargest_m));
}

}  // namespace

Eigen::Isometry3d Drive::root_in_base() const {
  const Eigen::Vector3d y = (wheels[0].centre_m - wheels[1].centre_m).normalized();
  const Eigen::Vector3d x = y.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d base_in_root = Eigen::Isometry3d::Identity();
  base_in_root.linear().col(0) = x;
  base_in_root.linear().col(1) = y;
  base_in_root.linear().col(2) = x.cross(y);
  base_in_root.translation() = (wheels[0].centre_m + wheels[1].centre_m) / 2;
  return base_in_root.inverse();
}

Drive find_drive(const UrdfSource& source, const std::vector<Body>& bodies, const DriveJoints& joints,
                 const WheelSize& size) {
  const bool named = !joints.left.empty() || !joints.right.empty();
  Candidates found = find_candidates(source, bodies, size);
  if (found.on_floor.size() < 2 && found.faults.empty()) {
    const Candidates limited = find_candidates(source, bodies, size, true);
    if (limited.on_floor.size() >= 2) found = limited;
  }
  const Pair pair = named ? named_pair(source, bodies, joints, size) : automatic_pair(source, bodies, found);
  const auto in_pair = [&](const RollingWheel& w) { return w.body == pair.first.body || w.body == pair.second.body; };
  if (!std::all_of(found.on_floor.begin(), found.on_floor.end(), in_pair)) {
    refuse_more_wheels(source, bodies, found.on_floor, pair);
  }
  for (const RollingWheel& wheel : {pair.first, pair.second}) check_size(source, bodies[wheel.body], wheel);
  const double larger = std::max(pair.first.radius_m, pair.second.radius_m);
  if (std::abs(pair.first.radius_m - pair.second.radius_m) > kRadiusRatio * larger) {
    source.fail_at_joint(bodies[pair.second.body].joint,
                         fmt::format("wheel radius {:g} m against {:g} m of {}: the URDF is the nominal robot, the "
                                     "radii may differ by {:g} at most",
                                     pair.second.radius_m, pair.first.radius_m,
                                     source.joint_text(bodies[pair.first.body].joint), kRadiusRatio));
  }
  const Drive drive = with_sides(source, bodies, pair, named);
  remark_drive(source, bodies, drive);
  return drive;
}

}  // namespace umbsim

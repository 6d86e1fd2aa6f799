#include "sim/urdf_supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/urdf_wheel_shape.h"

namespace umbsim {
namespace {

// A sphere this close to the swivel axis, in its radii, has no trail: it is a ball.
constexpr double kBallTrail_radii = 0.05;
// A support nearer to the axle than this many wheel radii does not keep the robot from tipping.
constexpr double kOffAxle_radii = 0.1;

class SupportFinder {
 public:
  SupportFinder(const UrdfSource& source, const std::vector<Body>& bodies, const std::vector<int>& drive, double radius)
      : source_(source), bodies_(bodies), radius_m_(radius), top_(bodies.size(), 0) {
    for (int i = 1; i < int(bodies.size()); ++i) {
      const bool starts = std::count(drive.begin(), drive.end(), i) || is_swivel(i);
      top_[i] = top_[bodies[i].parent] > 0 ? top_[bodies[i].parent] : (starts ? i : 0);
    }
  }

  std::vector<Support> find(const std::vector<int>& drive) {
    for (int i = 0; i < int(bodies_.size()); ++i) {
      if (top_[i] == 0) add_fixed(bodies_[i]);
      if (top_[i] == i && i > 0 && !std::count(drive.begin(), drive.end(), i)) add_swivel(i);
    }
    const auto off_axle = [&](const Support& s) {
      return std::abs(s.caster.centre_m.x()) > kOffAxle_radii * radius_m_;
    };
    if (std::none_of(found_.begin(), found_.end(), off_axle)) refuse_to_fall_over();
    return found_;
  }

 private:
  bool is_swivel(int i) const { return bodies_[i].continuous && is_vertical(bodies_[i].axis); }
  double height_m(const Shape& shape) const { return shape.lowest_m() + radius_m_; }
  bool touches(const Shape& shape) const {
    return shape.kind != Shape::Kind::mesh && std::abs(height_m(shape)) <= kFloorTolerance_radii * radius_m_;
  }

  // A shape longer than a wheel is the hull, not a skid.
  bool is_skid(const Shape& shape) const {
    return shape.kind == Shape::Kind::sphere || shape.half_extent_m().head<2>().maxCoeff() <= radius_m_;
  }

  void add_ball(const Shape& shape) {
    Support support;
    support.caster.link = shape.link;
    support.caster.radius_m = shape.half_extent_m().z();
    support.caster.centre_m = shape.centre_m();
    found_.push_back(support);
  }

  void add_fixed(const Body& body) {
    for (const Shape& shape : body.shapes) {
      if (touches(shape) && is_skid(shape)) add_ball(shape);
      if (shape.kind == Shape::Kind::sphere && !touches(shape)) note_missed(shape);
    }
  }

  // A third support that misses the floor is the likeliest mistake: keep the nearest for the message.
  void note_missed(const Shape& shape) {
    if (!missed_ || std::abs(height_m(shape)) < std::abs(height_m(*missed_))) missed_ = shape;
  }

  // Shapes on the floor carried by the swivel `top` and everything behind it: none (a turning sensor), a ball, or a
  // caster wheel.
  void add_swivel(int top) {
    std::vector<std::pair<int, Shape>> touching;
    for (int i = top; i < int(bodies_.size()); ++i) {
      if (top_[i] != top) continue;
      for (const Shape& shape : bodies_[i].shapes) {
        if (touches(shape)) touching.emplace_back(i, shape);
      }
    }
    if (touching.empty()) return;
    const auto& [index, shape] = touching[0];
    if (touching.size() > 1 && touching[1].first != index) {
      source_.fail_at_link(bodies_[touching[1].first].link,
                           fmt::format("a second wheel on the floor behind the swivel {}; a caster has one",
                                       source_.joint_text(bodies_[top].joint)));
    }
    const Eigen::Vector3d arm = shape.centre_m() - bodies_[top].origin_m;
    const double trail = (arm - arm.dot(bodies_[top].axis) * bodies_[top].axis).norm();
    if (shape.kind == Shape::Kind::sphere && trail <= kBallTrail_radii * shape.radius_m) return add_ball(shape);
    found_.push_back(swivelling(top, index, shape));
  }

  Support swivelling(int top, int index, const Shape& shape) const {
    Support support;
    Caster& caster = support.caster;
    support.fork = top;
    caster.link = shape.link;
    caster.swivels = true;
    caster.swivel_point_m = bodies_[top].origin_m;
    if (index == top && shape.kind != Shape::Kind::box) {  // the wheel does not turn, the fork slides on it
      caster.centre_m = shape.centre_m();
      caster.radius_m = shape.radius_m;
      return support;
    }
    const bool rolls =
        index != top && bodies_[index].parent == top && bodies_[index].continuous && is_horizontal(bodies_[index].axis);
    if (!rolls) {
      source_.fail_at_link(shape.link,
                           "stands on the floor behind a swivel, but is neither a ball on the swivel axis "
                           "nor a wheel on a continuous horizontal joint of the fork");
    }
    const WheelShape found = wheel_shape(source_, bodies_, index);
    if (!found.fault.empty()) source_.fail_at_joint(bodies_[index].joint, "cannot be a caster wheel: " + found.fault);
    support.wheel = index;
    caster.centre_m = found.wheel.centre_m;
    caster.radius_m = found.wheel.radius_m;
    return support;
  }

  [[noreturn]] void refuse_to_fall_over() const {
    std::string what = "falls over: no third support off the axle. ";
    if (missed_) {
      what += fmt::format("The sphere of {} ends {:.1f} mm {} the floor on which the wheels stand",
                          source_.link_text(missed_->link), 1e3 * std::abs(height_m(*missed_)),
                          height_m(*missed_) > 0 ? "above" : "below");
    } else {
      what +=
          "Give a fixed link (joint type fixed) a <sphere> as <collision> that reaches the floor, or add a "
          "swivelling caster";
    }
    source_.fail_at_link(bodies_[0].link, what + fmt::format(" (at most {:.1f} mm off counts as touching)",
                                                             1e3 * kFloorTolerance_radii * radius_m_));
  }

  const UrdfSource& source_;
  const std::vector<Body>& bodies_;
  double radius_m_;
  std::vector<int> top_;  ///< the drive wheel or swivel a body hangs on; 0 for the base
  std::vector<Support> found_;
  std::optional<Shape> missed_;
};

}  // namespace

std::vector<Support> find_supports(const UrdfSource& source, const std::vector<Body>& bodies,
                                   const std::vector<int>& drive_bodies, double wheel_radius_m) {
  return SupportFinder(source, bodies, drive_bodies, wheel_radius_m).find(drive_bodies);
}

}  // namespace umbsim

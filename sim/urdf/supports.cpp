#include "sim/urdf/supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/urdf/swivels.h"
#include "sim/urdf/wheel_shape.h"

namespace umbsim {
namespace {

// A sphere this close to the swivel axis, in its radii, has no trail: it is a ball.
constexpr double kBallTrail_radii = 0.05;
// A support nearer to the axle than this many wheel radii does not keep the robot from tipping.
constexpr double kOffAxle_radii = 0.1;
// A robot that leans by more than this on the support that is to hold it was not meant to stand on it.
constexpr double kMostLean_rad = 0.0524;  // 3 degrees

class SupportFinder {
 public:
  SupportFinder(const UrdfSource& source, const std::vector<Body>& bodies, const std::vector<int>& drive, double radius)
      : source_(source), bodies_(bodies), radius_m_(radius), top_(bodies.size(), 0) {
    for (int i = 1; i < int(bodies.size()); ++i) {
      const bool starts = std::count(drive.begin(), drive.end(), i) || is_swivel(i);
      top_[i] = top_[bodies[i].parent] > 0 ? top_[bodies[i].parent] : (starts ? i : 0);
    }
  }

  std::vector<FoundSupport> find(const std::vector<int>& drive) {
    for (int i = 0; i < int(bodies_.size()); ++i) {
      if (top_[i] == 0) add_fixed(i);
      if (top_[i] == i && i > 0 && !std::count(drive.begin(), drive.end(), i)) add_swivel(i);
    }
    using Guess = void (SupportFinder::*)();
    for (const Guess guess : {&SupportFinder::take_visuals, &SupportFinder::take_missed, &SupportFinder::take_swivels,
                              &SupportFinder::take_meshes}) {
      if (!stands()) (this->*guess)();
    }
    if (!stands()) refuse_to_fall_over();
    for (FoundSupport& support : found_) {
      if (support.body > 0) support.caster.slide = slide_above(source_, bodies_, support.body);
    }
    return found_;
  }

 private:
  bool off_axle(const Eigen::Vector3d& place) const { return std::abs(place.x()) > kOffAxle_radii * radius_m_; }
  bool stands() const {
    return std::any_of(found_.begin(), found_.end(),
                       [&](const FoundSupport& s) { return off_axle(s.caster.centre_m); });
  }

  template <class Take>
  void each_fixed(Take take) {
    for (int i = 0; i < int(bodies_.size()); ++i) {
      if (top_[i] == 0) take(i);
    }
  }

  void take(int body, const Shape& shape, const std::string& why) {
    add_ball(body, shape);
    source_.remark(Remark::Kind::assumed, fmt::format("{}: a caster, by {}", source_.link_text(shape.link), why));
  }

  void take_visuals() {
    each_fixed([&](int i) {
      for (const Shape& shape : bodies_[i].visuals) {
        const bool round = shape.kind == Shape::Kind::sphere || shape.kind == Shape::Kind::cylinder;
        if (round && touches(shape) && is_skid(shape)) take(i, shape, "its visual shape, which stands on the floor");
      }
    });
  }

  void take_missed() {
    if (!missed_ || !off_axle(missed_->centre_m())) return;
    const double lean_rad = std::abs(std::atan2(height_m(*missed_), missed_->centre_m().x()));
    if (std::min(lean_rad, M_PI - lean_rad) > kMostLean_rad) return;
    take(missed_body_, *missed_,
         fmt::format("its ball, which ends {:.1f} mm {} the floor: the robot leans on it",
                     1e3 * std::abs(height_m(*missed_)), height_m(*missed_) > 0 ? "above" : "below"));
  }

  // The ball that reaches the floor from where the mesh is placed; what its radius is matters on cables only.
  void take_meshes() {
    each_fixed([&](int i) {
      std::vector<Shape> meshes = bodies_[i].shapes;
      if (meshes.empty()) meshes = bodies_[i].visuals;
      for (const Shape& mesh : meshes) {
        const double height_m = mesh.centre_m().z() + radius_m_;
        if (mesh.kind != Shape::Kind::mesh || !is_called_caster(mesh.link)) continue;
        Shape ball = mesh;
        ball.kind = Shape::Kind::sphere;
        ball.radius_m = height_m > 0 && height_m <= radius_m_ ? height_m : radius_m_ / 2;
        ball.pose.translation().z() = ball.radius_m - radius_m_;
        take(i, ball,
             fmt::format("its name; its mesh is taken as a ball of radius {:.3g} m on the floor", ball.radius_m));
      }
    });
  }

  bool is_swivel(int i) const { return bodies_[i].continuous && is_vertical(bodies_[i].axis); }
  double height_m(const Shape& shape) const { return shape.lowest_m() + radius_m_; }
  bool touches(const Shape& shape) const {
    return shape.kind != Shape::Kind::mesh && std::abs(height_m(shape)) <= kFloorTolerance_radii * radius_m_;
  }

  // A shape longer than a wheel is the hull, not a skid.
  bool is_skid(const Shape& shape) const {
    return shape.kind == Shape::Kind::sphere || shape.half_extent_m().head<2>().maxCoeff() <= radius_m_;
  }

  void add_ball(int body, const Shape& shape) {
    FoundSupport support;
    support.body = body;
    support.caster.link = shape.link;
    support.caster.radius_m = shape.half_extent_m().z();
    support.caster.centre_m = shape.centre_m();
    found_.push_back(support);
  }

  void add_fixed(int i) {
    for (const Shape& shape : bodies_[i].shapes) {
      if (touches(shape) && is_skid(shape)) add_ball(i, shape);
      if (shape.kind == Shape::Kind::sphere && !touches(shape)) note_missed(i, shape);
    }
  }

  // A third support that misses the floor is the likeliest mistake: keep the nearest for the message.
  void note_missed(int body, const Shape& shape) {
    if (missed_ && std::abs(height_m(shape)) >= std::abs(height_m(*missed_))) return;
    missed_ = shape;
    missed_body_ = body;
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
    const Eigen::Vector3d arm = shape.centre_m() - bodies_[top].origin_m;
    const double trail = (arm - arm.dot(bodies_[top].axis) * bodies_[top].axis).norm();
    const bool one = touching.size() == 1;
    if (one && shape.kind == Shape::Kind::sphere && trail <= kBallTrail_radii * shape.radius_m)
      return add_ball(top, shape);
    found_.push_back(swivelling_support(source_, bodies_, top, touching));
  }

  // Casters whose shapes are meshes, or none.
  void take_swivels() {
    for (int i = 1; i < int(bodies_.size()); ++i) {
      if (top_[i] != i || !is_swivel(i)) continue;
      if (auto support = swivel_by_axle(source_, bodies_, i, radius_m_)) found_.push_back(std::move(*support));
    }
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
    for (const Remark& r : source_.remarks()) {
      if (r.kind == Remark::Kind::ignored && r.text.find("no shape of URDF") != r.text.npos) what += ". " + r.text;
    }
    source_.fail_at_link(bodies_[0].link, what + fmt::format(" (at most {:.1f} mm off counts as touching)",
                                                             1e3 * kFloorTolerance_radii * radius_m_));
  }

  const UrdfSource& source_;
  const std::vector<Body>& bodies_;
  double radius_m_;
  std::vector<int> top_;  ///< the drive wheel or swivel a body hangs on; 0 for the base
  std::vector<FoundSupport> found_;
  std::optional<Shape> missed_;
  int missed_body_ = 0;
};

}  // namespace

Slide slide_above(const UrdfSource& source, const std::vector<Body>& bodies, int index) {
  for (int i = index; i > 0; i = bodies[i].parent) {
    const Body& body = bodies[i];
    if (!body.prismatic || !is_vertical(body.axis)) continue;
    const bool upwards = body.axis.z() > 0;
    Slide slide{body.joint, upwards ? body.upper : -body.lower, upwards ? -body.lower : body.upper};
    slide.up_m = std::max(0.0, slide.up_m);
    slide.down_m = std::max(0.0, slide.down_m);
    const JointSpring spring = source.spring(body.joint);
    slide.stiffness_npm = spring.stiffness;
    slide.preload_n = spring.stiffness * (upwards ? -spring.reference : spring.reference);
    if (slide.up_m + slide.down_m > 0) return slide;
  }
  return {};
}

std::vector<FoundSupport> find_supports(const UrdfSource& source, const std::vector<Body>& bodies,
                                        const std::vector<int>& drive_bodies, double wheel_radius_m) {
  return SupportFinder(source, bodies, drive_bodies, wheel_radius_m).find(drive_bodies);
}

}  // namespace umbsim

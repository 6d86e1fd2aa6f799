#include "sim/urdf/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "sim/model/inertia.h"

namespace umbsim {
namespace {

// A sensor of this share of the robot's mass may be given without an inertia of its own.
constexpr double kPointMassShare = 0.05;
// What turns about its own axis is taken as a disc, whose inertia its mass says.
constexpr double kWheelMassShare = 0.2;
// A part of unknown size is a ball of water.
constexpr double kDensity_kgpm3 = 1000;
// A revolute joint that turns this far turns for ever: a wheel twice round, a swivel once.
constexpr double kWheelTurns_rad = 4 * M_PI;
constexpr double kSwivelTurns_rad = 6.2;

double mass_of_links(const urdf::ModelInterface& model) {
  double sum = 0;
  for (const auto& [name, link] : model.links_) sum += link->inertial ? link->inertial->mass : 0;
  return sum;
}

// A robot's longest chain of joints is some thirty.
constexpr int kDeepest = 1000;

class BodyReader {
 public:
  explicit BodyReader(const UrdfSource& source) : source_(source), total_kg_(mass_of_links(source.model())) {}

  std::vector<Body> read() {
    const urdf::Link& root = *source_.model().getRoot();
    bodies_.push_back({});
    bodies_[0].link = root.name;
    add_link(root, 0, Eigen::Isometry3d::Identity());
    for (const auto& [name, link] : source_.model().links_) {
      if (!seen_.contains(name))
        source_.fail_at_link(name, "not connected to the root " + source_.link_text(root.name));
    }
    return std::move(bodies_);
  }

 private:
  // Adds a link, all that is fixed to it, and new bodies behind its moving joints. x_rl: link in root.
  void add_link(const urdf::Link& link, int body, const Eigen::Isometry3d& x_rl) {
    if (++depth_ > kDeepest)
      source_.fail_at_link(link.name, fmt::format("is more than {} joints from the root", kDeepest));
    if (!seen_.insert(link.name).second) source_.fail_at_link(link.name, "child of more than one joint");
    for (const auto& collision : link.collision_array) {
      if (!collision || !collision->geometry) continue;
      const Shape shape = make_shape(link.name, *collision->geometry, x_rl * to_eigen(collision->origin));
      const double smallest = shape.smallest_m();
      if (smallest > 0) {
        bodies_[body].shapes.push_back(shape);
        continue;
      }
      bodies_[body].flaws.push_back(
          {link.name, fmt::format("a size of its collision shape is {} m; it must be positive", smallest)});
      source_.remark(Remark::Kind::ignored,
                     fmt::format("{}: a collision shape with a size of {} m", source_.link_text(link.name), smallest));
    }
    for (const auto& visual : link.visual_array) {
      if (!visual || !visual->geometry) continue;
      const Shape shape = make_shape(link.name, *visual->geometry, x_rl * to_eigen(visual->origin));
      if (shape.smallest_m() > 0) bodies_[body].visuals.push_back(shape);
    }
    bodies_[body].inertial = lumped(bodies_[body].inertial, read_inertial(link, x_rl, bodies_[body]));
    for (const auto& joint : link.child_joints) {
      const Eigen::Isometry3d x_rj = x_rl * to_eigen(joint->parent_to_joint_origin_transform);
      const int owner = joint->type == urdf::Joint::FIXED ? body : add_body(*joint, body, x_rj);
      add_link(*source_.model().getLink(joint->child_link_name), owner, x_rj);
    }
    --depth_;
  }

  int add_body(const urdf::Joint& joint, int parent, const Eigen::Isometry3d& x_rj) {
    Body body;
    body.link = joint.child_link_name;
    body.joint = joint.name;
    body.continuous = joint.type == urdf::Joint::CONTINUOUS;
    body.revolute = joint.type == urdf::Joint::REVOLUTE;
    body.prismatic = joint.type == urdf::Joint::PRISMATIC;
    body.parent = parent;
    body.origin_m = x_rj.translation();
    const Eigen::Vector3d axis = x_rj.linear() * Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z);
    if (body.continuous && !(axis.norm() > 0)) source_.fail_at_joint(joint.name, "its axis has no direction (0 0 0)");
    if (axis.norm() > 0) body.axis = axis.normalized();
    if (joint.limits) {
      body.effort_limit_nm = joint.limits->effort;
      body.lower = joint.limits->lower;
      body.upper = joint.limits->upper;
    }
    if (joint.type == urdf::Joint::REVOLUTE && axis.norm() > 0) {
      const bool upright = std::abs(body.axis.z()) > M_SQRT1_2;
      body.continuous = body.upper - body.lower >= (upright ? kSwivelTurns_rad : kWheelTurns_rad);
    }
    if (!(body.effort_limit_nm >= 0)) {
      if (body.continuous) {
        source_.fail_at_joint(joint.name,
                              fmt::format("limit effort is {:g}; it must not be negative", body.effort_limit_nm));
      }
      body.effort_limit_nm = 0;  // of an arm's joint, which is held
    }
    bodies_.push_back(body);
    return int(bodies_.size()) - 1;
  }

  Inertial read_inertial(const urdf::Link& link, const Eigen::Isometry3d& x_rl, Body& carrier) const {
    if (!link.inertial || link.inertial->mass == 0) return {};
    const urdf::Inertial& in = *link.inertial;
    if (!(in.mass > 0) || !std::isfinite(in.mass)) {
      source_.fail_at_link(link.name, fmt::format("mass is {} kg; it must be positive", in.mass));
    }
    Inertial body{in.mass, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
    body.inertia_kgm2 << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
    const bool none = body.inertia_kgm2.isZero(0);
    const std::string fault =
        none ? fmt::format("a mass of {:g} kg without inertia: <inertia> is missing or zero", in.mass)
             : inertia_fault(body.inertia_kgm2);
    if (!fault.empty()) complete(link, fault, carrier, body.inertia_kgm2);
    return transformed(body, x_rl * to_eigen(in.origin));
  }

  // A light part's own inertia is little beside what its mass has by its place.
  void complete(const urdf::Link& link, const std::string& fault, Body& carrier, Eigen::Matrix3d& inertia) const {
    const double mass_kg = link.inertial->mass;
    const bool turns = link.parent_joint && link.parent_joint->type == urdf::Joint::CONTINUOUS;
    if (mass_kg > (turns ? kWheelMassShare : kPointMassShare) * total_kg_) source_.fail_at_link(link.name, fault);
    carrier.flaws.push_back({link.name, fault, true});
    if (inertia.isZero(0) && link.parent_joint && link.parent_joint->type == urdf::Joint::FIXED) {
      source_.remark(Remark::Kind::ignored,
                     fmt::format("{}: {}; taken as a point", source_.link_text(link.name), fault));
      return;
    }
    const Eigen::Vector3d size_m = size_of(carrier, link.name, mass_kg);
    inertia = (mass_kg / 12 * (size_m.squaredNorm() - size_m.array().square())).matrix().asDiagonal();
    source_.remark(Remark::Kind::assumed,
                   fmt::format("{}: {}; taken as a uniform box of {:.3g} x {:.3g} x {:.3g} m",
                               source_.link_text(link.name), fault, size_m.x(), size_m.y(), size_m.z()));
  }

  // Of the box around the link's shapes, else of a ball's.
  static Eigen::Vector3d size_of(const Body& carrier, const std::string& link, double mass_kg) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
    for (const Shape& shape : carrier.shapes) {
      if (shape.link != link || shape.kind == Shape::Kind::mesh) continue;
      low = low.cwiseMin(shape.centre_m() - shape.half_extent_m());
      high = high.cwiseMax(shape.centre_m() + shape.half_extent_m());
    }
    if ((high.array() > low.array()).all()) return high - low;
    return Eigen::Vector3d::Constant(std::cbrt(mass_kg / kDensity_kgpm3));
  }

  const UrdfSource& source_;
  double total_kg_;
  int depth_ = 0;
  std::vector<Body> bodies_;
  std::set<std::string> seen_;
};

}  // namespace

double Shape::smallest_m() const {
  switch (kind) {
    case Kind::sphere:
      return radius_m;
    case Kind::cylinder:
      return std::min(radius_m, length_m);
    case Kind::box:
      return size_m.minCoeff();
    case Kind::mesh:
      break;
  }
  return mesh.scale.cwiseAbs().minCoeff();
}

Eigen::Isometry3d to_eigen(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  Eigen::Isometry3d x = Eigen::Isometry3d::Identity();
  x.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  x.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return x;
}

Shape make_shape(const std::string& link, const urdf::Geometry& geometry, const Eigen::Isometry3d& x_rs) {
  Shape shape;
  shape.link = link;
  shape.pose = x_rs;
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry)) {
    shape.kind = Shape::Kind::sphere;
    shape.radius_m = sphere->radius;
  } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
    shape.kind = Shape::Kind::cylinder;
    shape.radius_m = cylinder->radius;
    shape.length_m = cylinder->length;
  } else if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    shape.kind = Shape::Kind::box;
    shape.size_m = {box->dim.x, box->dim.y, box->dim.z};
  } else if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(&geometry)) {
    shape.mesh = {mesh->filename, {mesh->scale.x, mesh->scale.y, mesh->scale.z}};
  }
  return shape;
}

Eigen::Vector3d Shape::half_extent_m() const {
  const Eigen::Matrix3d r = pose.linear();
  switch (kind) {
    case Kind::sphere:
      return Eigen::Vector3d::Constant(radius_m);
    case Kind::box:
      return r.cwiseAbs() * size_m / 2;
    case Kind::cylinder: {
      const Eigen::Array3d along = r.col(2).array().abs();
      return radius_m * (1 - along.square()).max(0).sqrt() + length_m / 2 * along;
    }
    case Kind::mesh:
      break;
  }
  return Eigen::Vector3d::Zero();
}

std::vector<Body> read_bodies(const UrdfSource& source) { return BodyReader(source).read(); }

std::vector<Body> in_frame(std::vector<Body> bodies, const Eigen::Isometry3d& x_ar) {
  for (Body& body : bodies) {
    body.origin_m = x_ar * body.origin_m;
    body.axis = x_ar.linear() * body.axis;
    body.inertial = transformed(body.inertial, x_ar);
    for (auto* shapes : {&body.shapes, &body.visuals}) {
      for (Shape& shape : *shapes) shape.pose = x_ar * shape.pose;
    }
  }
  return bodies;
}

std::vector<int> mass_owners(const std::vector<Body>& bodies, const std::vector<bool>& separate) {
  std::vector<int> owners(bodies.size(), 0);
  for (std::size_t i = 1; i < bodies.size(); ++i) owners[i] = separate[i] ? int(i) : owners[bodies[i].parent];
  return owners;
}

std::vector<Inertial> lump_by_owner(const std::vector<Body>& bodies, const std::vector<int>& owners) {
  std::vector<Inertial> sums(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) sums[owners[i]] = lumped(sums[owners[i]], bodies[i].inertial);
  return sums;
}

}  // namespace umbsim

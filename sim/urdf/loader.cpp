#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/model/inertia.h"
#include "sim/model/robot_model.h"
#include "sim/urdf/bodies.h"
#include "sim/urdf/drive.h"
#include "sim/urdf/source.h"
#include "sim/urdf/supports.h"

namespace umbsim {
namespace {

// A wheel's mass sits on its axle. Up to this share of the radius nothing is said of the file's offset.
constexpr double kUnbalanced_radii = 0.1;

struct RollingMass {
  double mass_kg = 0;
  double spin_kgm2 = 0;
  double transverse_kgm2 = 0;
};

RollingMass rolling_mass(const UrdfSource& source, const Body& body, const Inertial& inertial, double radius_m) {
  const Eigen::Vector3d offset = inertial.com_m - body.origin_m;
  const double radial = (offset - offset.dot(body.axis) * body.axis).norm();
  if (radial > kUnbalanced_radii * radius_m) {
    source.remark(Remark::Kind::assumed, fmt::format("{}: its centre of mass is {:.3g} m off the joint axis; taken as "
                                                     "on it",
                                                     source.link_text(body.link), radial));
  }
  const double spin = body.axis.dot(inertial.inertia_kgm2 * body.axis);
  return {inertial.mass_kg, spin, (inertial.inertia_kgm2.trace() - spin) / 2};
}

bool has_shape(const urdf::Link& link) { return !link.collision_array.empty() || !link.visual_array.empty(); }
bool has_mass(const urdf::Link& link) { return link.inertial && link.inertial->mass > 0; }
bool is_fixed(const urdf::JointSharedPtr& joint) { return joint && joint->type == urdf::Joint::FIXED; }

// A hull without an inertial would leave a base of sensors only. Fine: a mere frame, a bracket on a link with mass, or
// the idiom of a separate link that holds nothing but the inertial.
void require_hull_mass(const UrdfSource& source, const Body& wheel) {
  const urdf::Link& hull = *source.model().getLink(source.model().getJoint(wheel.joint)->parent_link_name);
  if (has_mass(hull) || !has_shape(hull)) return;
  if (is_fixed(hull.parent_joint) && has_mass(*hull.getParent())) return;
  for (const auto& child : hull.child_links) {
    if (is_fixed(child->parent_joint) && has_mass(*child) && !has_shape(*child)) return;
  }
  source.fail_at_link(
      hull.name, fmt::format("massless: it has a shape and carries drive joint '{}', but no <inertial>", wheel.joint));
}

void check_base(const UrdfSource& source, const Body& root, const Inertial& base) {
  if (base.mass_kg == 0) source.fail_at_link(root.link, "massless: no link fixed to it has an <inertial>");
  const std::string fault = inertia_fault(base.inertia_kgm2);
  if (!fault.empty()) source.fail_at_link(root.link, "with all that is fixed to it: " + fault);
}

// Of the robot, where the file says nothing.
constexpr double kDriveWheelShare = 0.025, kForkShare = 0.01, kCasterWheelShare = 0.005;

RollingMass disc(double mass_kg, double radius_m) {
  return {mass_kg, mass_kg * radius_m * radius_m / 2, mass_kg * radius_m * radius_m / 4};
}

// A uniform disc stands in for what cannot be: what a wheel of a few per cent of the robot's mass weighs hardly shows.
RollingMass drive_wheel_mass(const UrdfSource& source, const Body& body, const Inertial& inertial, double robot_kg,
                             double radius_m) {
  std::string fault = inertial.mass_kg == 0 ? "without mass" : inertia_fault(inertial.inertia_kgm2);
  for (const Flaw& flaw : body.flaws) {
    if (fault.empty() && flaw.of_inertia && flaw.link == body.link) fault = flaw.what;
  }
  if (fault.empty()) {
    const RollingMass mass = rolling_mass(source, body, inertial, radius_m);
    if (mass.spin_kgm2 <= robot_kg * radius_m * radius_m) return mass;
    fault = fmt::format("its inertia about the axle, {:.3g} kg m^2, holds more than the whole robot's mass at its rim",
                        mass.spin_kgm2);
  }
  const RollingMass mass = disc(inertial.mass_kg > 0 ? inertial.mass_kg : kDriveWheelShare * robot_kg, radius_m);
  source.remark(Remark::Kind::assumed, fmt::format("{}: {}; taken as a uniform disc of {:.3g} kg",
                                                   source.link_text(body.link), fault, mass.mass_kg));
  return mass;
}

Wheel make_wheel(const UrdfSource& source, const Body& body, const Inertial& inertial, double robot_kg,
                 const RollingWheel& rolling) {
  const RollingMass mass = drive_wheel_mass(source, body, inertial, robot_kg, rolling.radius_m);
  Wheel wheel;
  wheel.joint = body.joint;
  wheel.radius_m = rolling.radius_m;
  wheel.width_m = rolling.width_m;
  wheel.mass_kg = mass.mass_kg;
  wheel.spin_inertia_kgm2 = mass.spin_kgm2;
  wheel.transverse_inertia_kgm2 = mass.transverse_kgm2;
  wheel.effort_limit_nm = body.effort_limit_nm;
  return wheel;
}

// The swivelling parts of a caster are light: what they weigh hardly shows.
void complete_fork(const UrdfSource& source, const Body& body, double robot_kg, Caster& caster) {
  const double r2 = caster.radius_m * caster.radius_m;
  Inertial& fork = caster.fork;
  const std::string fault = fork.mass_kg == 0 ? "without mass" : inertia_fault(fork.inertia_kgm2);
  if (fault.empty()) return;
  if (fork.mass_kg == 0) {
    fork.mass_kg = kForkShare * robot_kg;
    fork.com_m = caster.centre_m;
  }
  fork.inertia_kgm2 = fork.mass_kg * r2 * Eigen::Matrix3d::Identity();
  source.remark(Remark::Kind::assumed, fmt::format("{}: {}; taken as {:.3g} kg with a radius of gyration of {:.3g} m",
                                                   source.link_text(body.link), fault, fork.mass_kg, caster.radius_m));
}

RollingMass complete_wheel(const UrdfSource& source, const Body& body, const Inertial& inertial, double robot_kg,
                           double radius_m) {
  const std::string fault = inertial.mass_kg == 0 ? "without mass" : inertia_fault(inertial.inertia_kgm2);
  if (fault.empty()) return rolling_mass(source, body, inertial, radius_m);
  const double mass_kg = inertial.mass_kg > 0 ? inertial.mass_kg : kCasterWheelShare * robot_kg;
  source.remark(Remark::Kind::assumed,
                fmt::format("{}: {}; taken as a disc of {:.3g} kg", source.link_text(body.link), fault, mass_kg));
  return disc(mass_kg, radius_m);
}

double sum_of(const std::vector<Inertial>& masses) {
  double sum_kg = 0;
  for (const Inertial& mass : masses) sum_kg += mass.mass_kg;
  return sum_kg;
}

Caster make_caster(const UrdfSource& source, const std::vector<Body>& bodies, const std::vector<Inertial>& masses,
                   const FoundSupport& support) {
  Caster caster = support.caster;
  const double robot_kg = sum_of(masses);
  if (support.fork >= 0) {
    caster.fork = masses[support.fork];
    complete_fork(source, bodies[support.fork], robot_kg, caster);
  }
  if (support.wheel >= 0) {
    std::vector<int> wheels = support.twins;
    wheels.insert(wheels.begin(), support.wheel);
    for (const int wheel : wheels) {
      const RollingMass mass = complete_wheel(source, bodies[wheel], masses[wheel], robot_kg, caster.radius_m);
      const double beside_m = (bodies[wheel].inertial.com_m - caster.centre_m).dot(bodies[wheel].axis);
      caster.wheel_mass_kg += mass.mass_kg;
      caster.wheel_spin_inertia_kgm2 += mass.spin_kgm2;
      caster.wheel_transverse_inertia_kgm2 += mass.transverse_kgm2;
      if (wheels.size() > 1) caster.wheel_transverse_inertia_kgm2 += mass.mass_kg * beside_m * beside_m;
    }
  }
  return caster;
}

// What the model leaves out: moving parts that are held still, and hulls of meshes.
void remark_ignored(const UrdfSource& source, const std::vector<Body>& bodies, const std::vector<bool>& separate) {
  std::string still;
  int meshes = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto is_mesh = [](const Shape& shape) { return shape.kind == Shape::Kind::mesh; };
    meshes += int(std::count_if(bodies[i].shapes.begin(), bodies[i].shapes.end(), is_mesh));
    if (i > 0 && !separate[i]) still += (still.empty() ? "" : ", ") + bodies[i].joint;
  }
  if (!still.empty()) source.remark(Remark::Kind::ignored, "joints that are held at position zero: " + still);
  if (meshes > 0) source.remark(Remark::Kind::ignored, fmt::format("{} collision meshes that touch no floor", meshes));
}

// A robot this heavy on wheels this small has its masses in another unit.
void remark_mass(const UrdfSource& source, const RobotModel& robot) {
  constexpr double kHeaviest_kgpm3 = 1e7;  // total mass over the radius cubed; of public robots at most a tenth of it
  const double radius_m = robot.wheels[0].radius_m, mass_kg = robot.total_mass_kg();
  if (mass_kg < kHeaviest_kgpm3 * radius_m * radius_m * radius_m) return;
  source.remark(Remark::Kind::assumed,
                fmt::format("{:.4g} kg on wheels of radius {:.4g} m are taken as written: are the "
                            "masses in grams?",
                            mass_kg, radius_m));
}

}  // namespace

RobotModel load_robot(const std::string& urdf_file, const DriveJoints& joints, const WheelSize& size,
                      std::vector<Remark>* remarks) {
  const UrdfSource source(urdf_file);
  const std::vector<Body> in_root = read_bodies(source);
  const Drive drive = find_drive(source, in_root, joints, size);
  const std::vector<Body> bodies = in_frame(in_root, drive.root_in_base());
  const std::vector<int> wheel_bodies{drive.wheels[0].body, drive.wheels[1].body};
  const double radius_m = (drive.wheels[0].radius_m + drive.wheels[1].radius_m) / 2;
  const std::vector<FoundSupport> supports = find_supports(source, bodies, wheel_bodies, radius_m);

  std::vector<bool> separate(bodies.size(), false);
  for (const int wheel : wheel_bodies) separate[wheel] = true;
  for (const FoundSupport& support : supports) {
    if (support.fork >= 0) separate[support.fork] = true;
    if (support.wheel >= 0) separate[support.wheel] = true;
    for (const int twin : support.twins) separate[twin] = true;
  }
  const std::vector<Inertial> masses = lump_by_owner(bodies, mass_owners(bodies, separate));

  RobotModel model;
  model.name = source.model().getName();
  model.urdf = source.file_name();
  model.base = masses[0];
  check_base(source, bodies[0], model.base);
  const double half_m = (drive.wheels[0].centre_m - drive.wheels[1].centre_m).norm() / 2;
  for (int side = 0; side < 2; ++side) {
    const int body = wheel_bodies[side];
    require_hull_mass(source, bodies[body]);
    model.wheels[side] = make_wheel(source, bodies[body], masses[body], sum_of(masses), drive.wheels[side]);
    model.wheels[side].centre_m.y() = side == 0 ? half_m : -half_m;
    const Body& as_given = in_root[body];
    model.wheels[side].along_joint_m = (drive.wheels[side].centre_m - as_given.origin_m).dot(as_given.axis);
    model.outside_shapes = model.outside_shapes || !drive.wheels[side].taken_from.empty();
    model.wheels[side].slide = slide_above(source, bodies, body);
  }
  for (const FoundSupport& support : supports) model.casters.push_back(make_caster(source, bodies, masses, support));
  remark_mass(source, model);
  remark_ignored(source, bodies, separate);
  if (remarks) *remarks = source.remarks();
  return model;
}

}  // namespace umbsim

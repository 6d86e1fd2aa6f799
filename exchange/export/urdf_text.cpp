#include "exchange/export/urdf_text.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <array>
#include <cmath>
#include <sstream>

#include "core/error.h"

namespace umbsim::exchange {
namespace {

using tinyxml2::XMLElement;

XMLElement* named(XMLElement* robot, const char* kind, const std::string& name) {
  for (XMLElement* e = robot->FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
    const char* text = e->Attribute("name");
    if (text && name == text) return e;
  }
  return nullptr;
}

// The radius of every cylinder and sphere of the wheel's own link.
bool scale_wheel(XMLElement* link, double factor) {
  bool collision = false;
  for (const char* kind : {"visual", "collision"}) {
    for (XMLElement* part = link->FirstChildElement(kind); part; part = part->NextSiblingElement(kind)) {
      XMLElement* geometry = part->FirstChildElement("geometry");
      if (!geometry) continue;
      for (const char* shape : {"cylinder", "sphere"}) {
        XMLElement* e = geometry->FirstChildElement(shape);
        if (!e) continue;
        e->SetAttribute("radius", fmt::format("{:.9g}", e->DoubleAttribute("radius") * factor).c_str());
        collision = collision || std::string(kind) == "collision";
      }
    }
  }
  return collision;
}

// Moves the joint in its parent's frame, along the axis that the wheel turns about.
void move_joint(XMLElement* joint, double out_m) {
  XMLElement* origin = joint->FirstChildElement("origin");
  if (!origin) origin = joint->InsertNewChildElement("origin");
  std::array<double, 3> xyz{};
  std::istringstream in(origin->Attribute("xyz") ? origin->Attribute("xyz") : "0 0 0");
  in >> xyz[0] >> xyz[1] >> xyz[2];
  xyz[1] += out_m;
  origin->SetAttribute("xyz", fmt::format("{:.9g} {:.9g} {:.9g}", xyz[0], xyz[1], xyz[2]).c_str());
}

}  // namespace

std::string calibrated_urdf(const std::string& file, const RobotModel& model, const OdometryParameters& o) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
    throw InputError(SourceMark{file}, fmt::format("is no XML: {}", document.ErrorStr()));
  }
  XMLElement* robot = document.FirstChildElement("robot");
  if (!robot) throw InputError(SourceMark{file}, "has no <robot>");
  const double out_m = (o.wheelbase_m - model.wheelbase_m()) / 2;
  for (std::size_t side = 0; side < 2; ++side) {
    const Wheel& wheel = model.wheels[side];
    XMLElement* joint = named(robot, "joint", wheel.joint);
    const XMLElement* child = joint ? joint->FirstChildElement("child") : nullptr;
    XMLElement* link = child && child->Attribute("link") ? named(robot, "link", child->Attribute("link")) : nullptr;
    const double radius = side == 0 ? o.left_radius_m : o.right_radius_m;
    if (!link || !scale_wheel(link, radius / wheel.radius_m)) {
      throw InputError(SourceMark{file},
                       fmt::format("joint '{}': its wheel has no cylinder or sphere whose radius could be "
                                   "changed",
                                   wheel.joint));
    }
    move_joint(joint, side == 0 ? out_m : -out_m);
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

std::string diff_drive_sdf(const RobotModel& model, const OdometryParameters& o, const WheelContact& contact,
                           const std::string& provenance) {
  const double radius = (o.left_radius_m + o.right_radius_m) / 2;
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {0}\n     Put the plugin into the <model>, the <surface> into the <collision> of "
      "both "
      "wheels.\n     Gazebo's DiffDrive has one radius for both wheels: this is their mean; left {1:.9f} m, right "
      "{2:.9f} m. "
      "-->\n<sdf version=\"1.9\">\n  <model name=\"{3}\">\n"
      "    <plugin filename=\"gz-sim-diff-drive-system\" name=\"gz::sim::systems::DiffDrive\">\n"
      "      <left_joint>{4}</left_joint>\n      <right_joint>{5}</right_joint>\n"
      "      <wheel_separation>{6:.9f}</wheel_separation>\n      <wheel_radius>{7:.9f}</wheel_radius>\n"
      "      <odom_publish_frequency>50</odom_publish_frequency>\n    </plugin>\n"
      "    <!-- of each wheel's collision:\n    <surface>\n      <friction>\n        <ode>\n          <mu>{8:g}</mu>\n"
      "          <mu2>{8:g}</mu2>\n          <slip1>{9:g}</slip1>\n          <slip2>{10:g}</slip2>\n        </ode>\n"
      "      </friction>\n    </surface>\n    -->\n  </model>\n</sdf>\n",
      provenance, o.left_radius_m, o.right_radius_m, model.name, model.wheels[0].joint, model.wheels[1].joint,
      o.wheelbase_m, radius, contact.friction, contact.slip_along, contact.slip_across);
}

}  // namespace umbsim::exchange

#include "sim/urdf/completed.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>

namespace umbsim {
namespace {

using Eigen::Vector3d;
using Element = tinyxml2::XMLElement;

const Element* named(const Element& robot, const char* tag, const std::string& name) {
  for (const auto* e = robot.FirstChildElement(tag); e; e = e->NextSiblingElement(tag)) {
    if (e->Attribute("name") && name == e->Attribute("name")) return e;
  }
  return nullptr;
}

Vector3d axis_of(const Element& joint) {
  Vector3d axis = Vector3d::UnitX();  // the URDF's default
  const Element* e = joint.FirstChildElement("axis");
  if (e && e->Attribute("xyz")) std::sscanf(e->Attribute("xyz"), "%lf %lf %lf", &axis[0], &axis[1], &axis[2]);
  return axis.normalized();
}

// Roll and pitch that turn z onto `axis`.
std::string rpy_onto(const Vector3d& axis) {
  return fmt::format("{:.17g} {:.17g} 0", std::atan2(-axis.y(), std::hypot(axis.x(), axis.z())),
                     std::atan2(axis.x(), axis.z()));
}

void add_cylinder(Element& link, const Vector3d& axis, const Wheel& wheel) {
  while (Element* old = link.FirstChildElement("collision")) link.DeleteChild(old);
  tinyxml2::XMLDocument& document = *link.GetDocument();
  Element* collision = document.NewElement("collision");
  Element* origin = document.NewElement("origin");
  const Vector3d at = wheel.along_joint_m * axis;
  origin->SetAttribute("xyz", fmt::format("{:.17g} {:.17g} {:.17g}", at.x(), at.y(), at.z()).c_str());
  origin->SetAttribute("rpy", rpy_onto(axis).c_str());
  Element* geometry = document.NewElement("geometry");
  Element* cylinder = document.NewElement("cylinder");
  cylinder->SetAttribute("radius", fmt::format("{:.17g}", wheel.radius_m).c_str());
  cylinder->SetAttribute("length", fmt::format("{:.17g}", wheel.width_m).c_str());
  geometry->InsertEndChild(cylinder);
  collision->InsertEndChild(document.NewComment(" written by umbsim: the given size, or what bounds the mesh "));
  collision->InsertEndChild(origin);
  collision->InsertEndChild(geometry);
  link.InsertEndChild(collision);
}

}  // namespace

std::string urdf_with_wheels(const std::string& text, const RobotModel& robot) {
  if (!robot.outside_shapes) return text;
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  const Element* root = document.RootElement();
  for (const Wheel& wheel : robot.wheels) {
    const Element* joint = root ? named(*root, "joint", wheel.joint) : nullptr;
    const Element* child = joint ? joint->FirstChildElement("child") : nullptr;
    const Element* link = child && child->Attribute("link") ? named(*root, "link", child->Attribute("link")) : nullptr;
    if (link) add_cylinder(const_cast<Element&>(*link), axis_of(*joint), wheel);
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace umbsim

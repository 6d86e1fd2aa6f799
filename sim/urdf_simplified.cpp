#include "sim/urdf_simplified.h"

#include <string_view>

namespace umbsim {
namespace {

double number(const tinyxml2::XMLElement* element, const char* attribute) {
  return element ? element->DoubleAttribute(attribute) : 0;
}

double content(const tinyxml2::XMLElement* element) { return element ? element->DoubleText() : 0; }

void drop_children(tinyxml2::XMLElement& parent, const char* tag) {
  while (auto* child = parent.FirstChildElement(tag)) parent.DeleteChild(child);
}

}  // namespace

std::map<std::string, JointSpring> springs_of(const tinyxml2::XMLElement& robot) {
  std::map<std::string, JointSpring> springs;
  const auto add = [&](const char* joint, const JointSpring& spring) {
    if (joint && spring.stiffness > 0) springs[joint] = spring;
  };
  for (const auto* e = robot.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
    const auto* dynamics = e->FirstChildElement("dynamics");
    add(e->Attribute("name"), {number(dynamics, "spring_stiffness"), number(dynamics, "spring_reference")});
  }
  for (const auto* e = robot.FirstChildElement("gazebo"); e; e = e->NextSiblingElement("gazebo")) {
    add(e->Attribute("reference"),
        {content(e->FirstChildElement("springStiffness")), content(e->FirstChildElement("springReference"))});
  }
  return springs;
}

std::vector<std::string> simplify(tinyxml2::XMLElement& robot) {
  for (const char* tag : {"material", "gazebo", "transmission", "ros2_control", "sensor"}) drop_children(robot, tag);
  for (auto* link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) {
    for (auto* v = link->FirstChildElement("visual"); v; v = v->NextSiblingElement("visual"))
      drop_children(*v, "material");
  }
  std::vector<std::string> completed;
  for (auto* joint = robot.FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint")) {
    const char* given = joint->Attribute("type");
    const std::string_view type = given ? given : "";
    auto* limit = joint->FirstChildElement("limit");
    if (!limit && type != "revolute" && type != "prismatic") continue;
    bool missing = !limit;
    if (!limit) joint->InsertEndChild(limit = robot.GetDocument()->NewElement("limit"));
    for (const char* key : {"effort", "velocity"}) {
      if (limit->Attribute(key)) continue;
      limit->SetAttribute(key, "0");
      missing = true;
    }
    if (missing && joint->Attribute("name")) completed.push_back(joint->Attribute("name"));
  }
  return completed;
}

}  // namespace umbsim

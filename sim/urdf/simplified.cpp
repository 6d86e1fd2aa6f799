#include "sim/urdf/simplified.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace umbsim {
namespace {

double number(const tinyxml2::XMLElement* element, const char* attribute) {
  return element ? element->DoubleAttribute(attribute) : 0;
}

double content(const tinyxml2::XMLElement* element) { return element ? element->DoubleText() : 0; }

void drop_children(tinyxml2::XMLElement& parent, const char* tag) {
  while (auto* child = parent.FirstChildElement(tag)) parent.DeleteChild(child);
}

// Editors break and indent long attributes; urdfdom parts numbers at spaces only.
void plain_spaces(tinyxml2::XMLElement& element) {
  std::vector<std::pair<std::string, std::string>> changed;
  for (const auto* a = element.FirstAttribute(); a; a = a->Next()) {
    std::string value = a->Value();
    std::replace_if(
        value.begin(), value.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
    const auto first = value.find_first_not_of(' ');
    value = first == value.npos ? "" : value.substr(first, value.find_last_not_of(' ') - first + 1);
    if (value != a->Value()) changed.emplace_back(a->Name(), value);
  }
  for (const auto& [name, value] : changed) element.SetAttribute(name.c_str(), value.c_str());
  for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) plain_spaces(*child);
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

std::map<std::string, double> frictions_of(const tinyxml2::XMLElement& robot) {
  std::map<std::string, double> frictions;
  for (const auto* e = robot.FirstChildElement("gazebo"); e; e = e->NextSiblingElement("gazebo")) {
    const auto* mu = e->FirstChildElement("mu1") ? e->FirstChildElement("mu1") : e->FirstChildElement("mu");
    if (mu && e->Attribute("reference")) frictions[e->Attribute("reference")] = mu->DoubleText(1);
  }
  return frictions;
}

std::vector<std::pair<std::string, std::string>> drop_odd_collisions(tinyxml2::XMLElement& robot) {
  std::vector<std::pair<std::string, std::string>> dropped;
  for (auto* link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) {
    for (auto* next = link->FirstChildElement("collision"); next;) {
      auto* collision = std::exchange(next, next->NextSiblingElement("collision"));
      const auto* geometry = collision->FirstChildElement("geometry");
      const auto* shape = geometry ? geometry->FirstChildElement() : nullptr;
      const std::string_view name = shape ? shape->Name() : "";
      if (name == "sphere" || name == "cylinder" || name == "box" || name == "mesh") continue;
      if (link->Attribute("name")) dropped.emplace_back(link->Attribute("name"), name);
      link->DeleteChild(collision);
    }
  }
  return dropped;
}

std::vector<std::string> simplify(tinyxml2::XMLElement& robot) {
  for (const char* tag :
       {"material", "gazebo", "transmission", "ros2_control", "sensor", "xacro:property", "xacro:arg"})
    drop_children(robot, tag);
  plain_spaces(robot);
  for (auto* link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) {
    for (auto* v = link->FirstChildElement("visual"); v; v = v->NextSiblingElement("visual"))
      drop_children(*v, "material");
  }
  std::vector<std::string> completed;
  for (auto* joint = robot.FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint")) {
    for (const char* tag : {"dynamics", "mimic", "safety_controller", "calibration"}) drop_children(*joint, tag);
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

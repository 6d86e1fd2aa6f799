#include "sim/mesh/collada_points.h"

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

namespace umbsim {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using Element = tinyxml2::XMLElement;

std::vector<double> numbers(const Element& element) {
  std::vector<double> values;
  std::istringstream text(element.GetText() ? element.GetText() : "");
  for (double value; text >> value;) values.push_back(value);
  return values;
}

const Element* child_with_id(const Element& parent, const char* tag, const std::string& id) {
  for (const auto* e = parent.FirstChildElement(tag); e; e = e->NextSiblingElement(tag)) {
    if (e->Attribute("id") && id == e->Attribute("id")) return e;
  }
  return nullptr;
}

// "#name" -> "name".
std::string reference(const Element& element, const char* attribute) {
  const char* value = element.Attribute(attribute);
  return value && *value == '#' ? value + 1 : "";
}

std::vector<Vector3d> positions(const Element& mesh) {
  std::vector<Vector3d> points;
  const Element* vertices = mesh.FirstChildElement("vertices");
  const Element* input = vertices ? vertices->FirstChildElement("input") : nullptr;
  for (; input; input = input->NextSiblingElement("input")) {
    if (!input->Attribute("semantic", "POSITION")) continue;
    const Element* source = child_with_id(mesh, "source", reference(*input, "source"));
    const Element* array = source ? source->FirstChildElement("float_array") : nullptr;
    const std::vector<double> v = array ? numbers(*array) : std::vector<double>();
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) points.emplace_back(v[i], v[i + 1], v[i + 2]);
  }
  return points;
}

Affine3d transform(const Element& element) {
  Affine3d x = Affine3d::Identity();
  const std::string_view name = element.Name();
  const std::vector<double> v = numbers(element);
  if (name == "matrix" && v.size() == 16) {
    x.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
  } else if (name == "translate" && v.size() == 3) {
    x.translate(Vector3d(v[0], v[1], v[2]));
  } else if (name == "scale" && v.size() == 3) {
    x.scale(Vector3d(v[0], v[1], v[2]));
  } else if (name == "rotate" && v.size() == 4) {
    x.rotate(Eigen::AngleAxisd(v[3] * M_PI / 180, Vector3d(v[0], v[1], v[2]).normalized()));
  }
  return x;
}

using Geometries = std::map<std::string, std::vector<Vector3d>>;

void add_node(const Element& node, Affine3d x, const Geometries& geometries, std::vector<Vector3d>& points) {
  for (const auto* e = node.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    if (name == "node") {
      add_node(*e, x, geometries, points);
    } else if (name == "instance_geometry") {
      const auto found = geometries.find(reference(*e, "url"));
      if (found == geometries.end()) continue;
      for (const Vector3d& p : found->second) points.push_back(x * p);
    } else {
      x = x * transform(*e);
    }
  }
}

}  // namespace

std::vector<Vector3d> collada_points(const std::string& document) {
  tinyxml2::XMLDocument xml;
  xml.Parse(document.data(), document.size());
  std::vector<Vector3d> points;
  const Element* root = xml.Error() ? nullptr : xml.FirstChildElement("COLLADA");
  if (!root) return points;
  Geometries geometries;
  const Element* library = root->FirstChildElement("library_geometries");
  for (const auto* g = library ? library->FirstChildElement("geometry") : nullptr; g;
       g = g->NextSiblingElement("geometry")) {
    const Element* mesh = g->FirstChildElement("mesh");
    if (mesh && g->Attribute("id")) geometries[g->Attribute("id")] = positions(*mesh);
  }
  const Element* scenes = root->FirstChildElement("library_visual_scenes");
  const Element* scene = scenes ? scenes->FirstChildElement("visual_scene") : nullptr;
  if (scene) add_node(*scene, Affine3d::Identity(), geometries, points);
  const Element* asset = root->FirstChildElement("asset");
  const Element* unit = asset ? asset->FirstChildElement("unit") : nullptr;
  const double metres = unit ? unit->DoubleAttribute("meter", 1) : 1;
  for (Vector3d& p : points) p *= metres;
  return points;
}

}  // namespace umbsim

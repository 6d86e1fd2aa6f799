#include "sim/mesh/mesh_points.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "sim/mesh/collada_points.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

std::vector<fs::path> split_path(const char* variable, const fs::path& below) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::istringstream text(value ? value : "");
  for (std::string folder; std::getline(text, folder, ':');) {
    if (!folder.empty()) folders.push_back(fs::path(folder) / below);
  }
  return folders;
}

std::string first_file(const std::vector<fs::path>& choices) {
  std::error_code ignored;
  for (const fs::path& file : choices) {
    if (fs::is_regular_file(file, ignored)) return file;
  }
  return {};
}

std::string find_in_package(const fs::path& urdf, const fs::path& inside) {
  std::vector<fs::path> choices;
  const fs::path package = *inside.begin(), rest = inside.lexically_relative(package);
  for (fs::path above = urdf.parent_path();; above = above.parent_path()) {
    choices.push_back(above / inside);
    if (above.filename() == package) choices.push_back(above / rest);
    if (above == above.parent_path()) break;
  }
  for (const auto& [variable, below] : {std::pair{"ROS_PACKAGE_PATH", ""}, std::pair{"AMENT_PREFIX_PATH", "share"}}) {
    for (const fs::path& folder : split_path(variable, below)) choices.push_back(folder / inside);
  }
  // A package whose folder has another name, as that of a clone.
  for (fs::path above = urdf.parent_path();; above = above.parent_path()) {
    choices.push_back(above / rest);
    if (above == above.parent_path()) break;
  }
  return first_file(choices);
}

Points binary_stl(const std::string& data) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  Points points;
  std::uint32_t count = 0;
  if (data.size() < kHeader) return points;
  std::memcpy(&count, data.data() + kHeader - 4, 4);
  if (data.size() < kHeader + kTriangle * std::size_t(count)) return points;
  points.reserve(3 * std::size_t(count));
  for (std::size_t i = 0; i < count; ++i) {
    float corners[9];
    std::memcpy(corners, data.data() + kHeader + kTriangle * i + 12, sizeof corners);
    for (int k = 0; k < 9; k += 3) points.emplace_back(corners[k], corners[k + 1], corners[k + 2]);
  }
  return points;
}

// Lines that begin with `word` and hold three numbers.
Points lines_of(const std::string& data, const std::string& word) {
  Points points;
  std::istringstream lines(data);
  for (std::string line, first; std::getline(lines, line);) {
    std::istringstream words(line);
    Vector3d p;
    if (words >> first && first == word && words >> p.x() >> p.y() >> p.z()) points.push_back(p);
  }
  return points;
}

Points points_of(const std::string& data, std::string extension) {
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".obj") return lines_of(data, "v");
  if (extension == ".dae") return collada_points(data);
  if (extension != ".stl") return {};
  const Points text = data.starts_with("solid") ? lines_of(data, "vertex") : Points();
  return text.empty() ? binary_stl(data) : text;
}

}  // namespace

std::string find_mesh(const std::string& urdf_file, const std::string& name) {
  const fs::path urdf = fs::absolute(urdf_file).lexically_normal();
  for (const std::string scheme : {"package://", "model://"}) {
    if (name.starts_with(scheme)) return find_in_package(urdf, fs::path(name.substr(scheme.size())));
  }
  const std::string plain = name.starts_with("file://") ? name.substr(7) : name;
  return first_file({urdf.parent_path() / plain});
}

std::vector<Vector3d> mesh_points(const std::string& urdf_file, const MeshFile& mesh) {
  const std::string file = find_mesh(urdf_file, mesh.name);
  if (file.empty()) return {};
  std::ifstream stream(file, std::ios::binary);
  const std::string data((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  Points points = points_of(data, fs::path(file).extension());
  for (Vector3d& p : points) p = p.cwiseProduct(mesh.scale);
  const bool finite = std::all_of(points.begin(), points.end(), [](const Vector3d& p) { return p.allFinite(); });
  return finite ? points : Points();
}

}  // namespace umbsim

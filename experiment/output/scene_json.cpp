#include "experiment/output/scene_json.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>

#include "core/error.h"
#include "core/text/text_file.h"
#include "sim/mesh/mesh_points.h"

namespace umbsim {
namespace {

// About as many ellipses of a run.
constexpr std::size_t kPageEllipses = 20;
// Meshes of a page, bytes in all: the page of a run stays below 3 MB.
constexpr std::size_t kMeshBytes = 1'000'000;

double rounded(double value, double unit = 1e6) { return std::round(value * unit) / unit; }

Json pose_json(const Pose2& p) { return Json::array({rounded(p.x_m), rounded(p.y_m), rounded(p.theta_rad)}); }

Json path_json(const std::vector<Pose2>& path) {
  Json json = Json::array();
  for (const Pose2& pose : path) json.push_back(pose_json(pose));
  return json;
}

// 95 % ellipses along the way, [x, y, semi-axis a, b, angle of a, index of the pose in the path], in the floor frame,
// and the poses at which an absolute fix was taken.
void add_ellipses(Json& json, const RunDigest& digest, const PoseTrack& track) {
  const Pose2& X_WO = digest.truth.front();
  const std::size_t poses = digest.estimates.size();
  const std::size_t between = std::max<std::size_t>(1, poses / kPageEllipses);
  json["ellipses"] = Json::array();
  for (std::size_t i = 0; i < poses; ++i) {
    if (i % between != 0 && i + 1 != poses) continue;
    const UncertainPose& estimate = digest.estimates[i];
    const Ellipse e = ellipse_95(estimate.covariance);
    const Pose2 centre = X_WO * estimate.X_OB;
    json["ellipses"].push_back(Json::array({rounded(centre.x_m), rounded(centre.y_m), rounded(e.a_m), rounded(e.b_m),
                                            rounded(e.angle_rad + X_WO.theta_rad), i}));
  }
  if (track.fixes.empty()) return;
  json["fixes"] = Json::array();
  for (const std::size_t sample : track.fixes) {
    json["fixes"].push_back(std::min((sample + digest.stride - 1) / digest.stride, poses - 1));
  }
}

// Angles, loads, and the share of the time since the moment before in which a wheel slid.
Json wheels_json(const RunDigest& digest) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < digest.wheels.size(); ++i) {
    const WheelMoment& now = digest.wheels[i];
    Json row = Json::array({rounded(now.angle_rad[0], 1e3), rounded(now.angle_rad[1], 1e3), rounded(now.load_n[0], 10),
                            rounded(now.load_n[1], 10)});
    for (std::size_t w = 0; w < 2; ++w) {
      const double passed_s = i == 0 ? 0 : digest.time_s[i] - digest.time_s[i - 1];
      const double slid_s = i == 0 ? 0 : now.slid_s[w] - digest.wheels[i - 1].slid_s[w];
      row.push_back(passed_s > 0 ? rounded(slid_s / passed_s, 100) : 0);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? unsigned(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

Json meshes_json(const std::string& urdf_text, const std::string& urdf_file) {
  Json meshes = Json::object();
  std::size_t room = kMeshBytes;
  const std::regex name(R"re(<mesh[^>]*\sfilename\s*=\s*["']([^"']+)["'])re");
  for (auto it = std::sregex_iterator(urdf_text.begin(), urdf_text.end(), name); it != std::sregex_iterator(); ++it) {
    const std::string given = (*it)[1];
    const std::string file = find_mesh(urdf_file, given);
    std::error_code error;
    const std::string kind = std::filesystem::path(file).extension();
    if ((kind != ".stl" && kind != ".STL" && kind != ".dae") || meshes.contains(given)) continue;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error || size > room) continue;
    try {
      meshes[given] = base64(read_text_file(file, room));
      room -= std::size_t(size);
    } catch (const InputError&) {  // not readable: the replay leaves it out
    }
  }
  return meshes;
}

}  // namespace

void add_digest(Json& run, const RunDigest& digest, const PoseTrack* track) {
  run["time_s"] = Json::array();
  for (const double t : digest.time_s) run["time_s"].push_back(rounded(t, 1e3));
  run["truth"] = path_json(digest.truth);
  run["odometry"] = path_json(digest.odometry);
  if (!digest.wheels.empty()) run["wheels"] = wheels_json(digest);
  if (!digest.estimates.empty() && track) add_ellipses(run, digest, *track);
}

Json robot_scene_json(const std::string& urdf_text, const std::string& urdf_file, const RobotModel& robot) {
  return {{"name", robot.name},
          {"urdf", urdf_text},
          {"left_joint", robot.wheels[0].joint},
          {"right_joint", robot.wheels[1].joint},
          {"wheel_radius_m", robot.wheels[0].radius_m},
          {"weight_n", rounded(robot.total_mass_kg() * 9.81, 10)},
          {"meshes", meshes_json(urdf_text, urdf_file)}};
}

Json floor_scene_json(const Floor& floor) {
  Json json{{"friction", floor.friction}, {"slope_rad", floor.slope_rad}, {"downhill_rad", floor.downhill_rad}};
  json["cables"] = Json::array();
  for (const Cable& c : floor.cables) {
    json["cables"].push_back({{"x_m", c.x_m},
                              {"y_m", c.y_m},
                              {"direction_rad", c.direction_rad},
                              {"height_m", c.height_m},
                              {"length_m", c.length_m}});
  }
  json["patches"] = Json::array();
  for (const FrictionPatch& p : floor.patches) {
    json["patches"].push_back({{"x_m", p.x_m}, {"y_m", p.y_m}, {"radius_m", p.radius_m}, {"friction", p.friction}});
  }
  return json;
}

}  // namespace umbsim

#include "exchange/bag/transforms.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "core/error.h"
#include "exchange/text/column_meaning.h"

namespace umbsim::exchange {
namespace {

Eigen::Isometry3d isometry(const StampedPose& p) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() =
      Eigen::Quaterniond(p.quaternion[3], p.quaternion[0], p.quaternion[1], p.quaternion[2]).toRotationMatrix();
  X.translation() << p.position[0], p.position[1], p.position[2];
  return X;
}

// The last word of a namespaced frame.
std::string bare(const std::string& frame) { return frame.substr(frame.rfind('/') + 1); }

}  // namespace

void Transforms::add(const StampedPose& pose, bool is_static) {
  Edge& edge = edges_[pose.child];
  if (!edge.parent.empty() && edge.parent != pose.frame) {
    throw InputError(fmt::format("tf: frame '{}' has two parents, '{}' and '{}': two robots or two senders in one bag?",
                                 pose.child, edge.parent, pose.frame));
  }
  edge.parent = pose.frame;
  edge.is_static = is_static;
  edge.poses.push_back(pose);
}

std::vector<std::string> Transforms::edges() const {
  std::vector<std::string> all;
  for (const auto& [child, edge] : edges_) all.push_back(fmt::format("{}/{}", edge.parent, child));
  return all;
}

std::string Transforms::guess() const {
  static const std::set<std::string> kFixed = {"map", "world", "mocap", "vicon", "optitrack", "earth", "global"};
  static const std::set<std::string> kRobot = {"base_link", "base_footprint", "robot", "base"};
  std::set<std::string> found;
  for (const auto& [child, edge] : edges_) {
    if (!kRobot.count(bare(child))) continue;
    for (std::string at = edge.parent; !at.empty();) {
      const auto above = edges_.find(at);
      if (kFixed.count(bare(at)) && (above == edges_.end() || !kFixed.count(bare(above->second.parent)))) {
        found.insert(fmt::format("{}/{}", at, child));
      }
      at = above == edges_.end() ? "" : above->second.parent;
    }
  }
  // base_footprint below base_link (or above it) is the same robot.
  if (found.size() == 2) {
    const std::string a = bare(*found.begin()), b = bare(*std::next(found.begin()));
    if (a == "base_footprint" && b == "base_link") return *std::next(found.begin());
  }
  return found.size() == 1 ? *found.begin() : "";
}

std::vector<std::string> Transforms::chain(const std::string& parent, const std::string& child) const {
  std::vector<std::string> up;
  for (std::string at = child; at != parent;) {
    const auto edge = edges_.find(at);
    if (edge == edges_.end() || up.size() > edges_.size()) {
      throw InputError(fmt::format("tf: frame '{}' does not stand below '{}'; there are: {}", child, parent,
                                   fmt::join(edges(), ", ")));
    }
    up.push_back(at);
    at = edge->second.parent;
  }
  if (up.empty()) throw InputError(fmt::format("tf: '{}' and '{}' are one frame", parent, child));
  return up;
}

void Transforms::follow(const std::string& parent, const std::string& child,
                        const std::function<void(const StampedPose&)>& take) const {
  const std::vector<std::string> up = chain(parent, child);
  const auto moving = std::max_element(up.begin(), up.end(), [&](const std::string& a, const std::string& b) {
    return edges_.at(a).poses.size() < edges_.at(b).poses.size();
  });
  std::map<std::string, std::size_t> next;  // of every edge, the first pose that is still to come
  for (const StampedPose& step : edges_.at(*moving).poses) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    bool known = true;
    for (const std::string& frame : up) {
      const Edge& edge = edges_.at(frame);
      std::size_t& i = next[frame];
      while (i < edge.poses.size() && (edge.is_static || edge.poses[i].at <= step.at)) ++i;
      known = known && i > 0;
      if (i > 0) X = isometry(frame == *moving ? step : edge.poses[i - 1]) * X;
    }
    if (!known) continue;
    const Eigen::Quaterniond q(X.linear());
    take({step.at,
          parent,
          child,
          {X.translation().x(), X.translation().y(), X.translation().z()},
          {q.x(), q.y(), q.z(), q.w()}});
  }
}

}  // namespace umbsim::exchange

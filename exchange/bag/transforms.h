#pragma once

#include <map>
#include <string>
#include <vector>

#include "exchange/bag/ros_messages.h"

namespace umbsim::exchange {

/// The tree of frames that /tf and /tf_static describe, over time.
class Transforms {
 public:
  void add(const StampedPose& pose, bool is_static);

  /// Every frame with its parent.
  std::vector<std::string> edges() const;
  bool empty() const { return edges_.empty(); }
  /// "map/base_link" where one frame of a fixed world carries the robot's base; empty where that cannot be told.
  std::string guess() const;

  /// The poses of frame `child` seen from `parent` when the transform that moves most often says something; the others
  /// hold until they say something new. Throws InputError: no such frames, or not one above the other.
  void follow(const std::string& parent, const std::string& child,
              const std::function<void(const StampedPose&)>& take) const;

 private:
  struct Edge {
    std::string parent;
    bool is_static = false;
    std::vector<StampedPose> poses;
  };
  std::vector<std::string> chain(const std::string& parent, const std::string& child) const;
  std::map<std::string, Edge> edges_;  ///< by the child
};

}  // namespace umbsim::exchange

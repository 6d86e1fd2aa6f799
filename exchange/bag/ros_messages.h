#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "exchange/bag/bag.h"
#include "exchange/import/wheels/joint_states.h"

namespace umbsim::exchange {

/// A pose in space with what it is of.
struct StampedPose {
  Nanoseconds at = 0;
  std::string frame, child;  ///< child: empty where the message has none
  std::array<double, 3> position{};
  std::array<double, 4> quaternion{};  ///< x, y, z, w
};

using Bags = std::vector<std::unique_ptr<Bag>>;

/// Whether messages of this type hold poses that can be a truth.
bool holds_poses(const std::string& type);

/// Calls `take` for every message of a topic, file after file. `stamps`: how often the header's stamp was used rather
/// than the time of receipt, which is taken where the header has none.
/// Whether messages of this type hold commanded speeds.
bool holds_commands(const std::string& type);

void read_joint_states(const Bags& bags, const std::string& topic, const std::function<void(JointStates&)>& done);
void read_poses(const Bags& bags, const std::string& topic, const std::function<void(const StampedPose&)>& take);
/// `take`: stamp (of receipt where the type has none), linear speed along x and angular speed about z.
void read_commands(const Bags& bags, const std::string& topic,
                   const std::function<void(Nanoseconds, double, double)>& take);

}  // namespace umbsim::exchange

#pragma once

#include <string>

#include "recording/recording.h"

namespace umbsim::exchange {

/// When the log of an exported bag begins, Unix nanoseconds: ROS takes time 0 for no time at all.
constexpr std::int64_t kLogBegins_ns = 1'000'000'000'000'000'000;

/// All runs as one rosbag2 MCAP file: /joint_states, /odom (what the header's numbers make of the counts), /truth
/// (PoseStamped) and /tf, zstd chunks with indexes. `left_joint`, `right_joint`: names of the wheels' joints.
std::string mcap_log(const Recording& recording, const std::string& left_joint, const std::string& right_joint);

/// metadata.yaml of the bag's folder, by which `ros2 bag` finds `file`.
std::string rosbag2_metadata(const Recording& recording, const std::string& file);

}  // namespace umbsim::exchange

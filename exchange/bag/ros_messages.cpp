#include "exchange/bag/ros_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/error.h"
#include "exchange/bag/files/unpacked_file.h"

namespace umbsim::exchange {
namespace {

/// Where a type has its pose, and what stands before it.
struct PosePaths {
  std::string prefix;  ///< of all
  std::string position, orientation;
  bool child;
};

const std::map<std::string, PosePaths>& pose_types() {
  static const std::map<std::string, PosePaths> all = {
      {"geometry_msgs/PoseStamped", {"", "pose.position", "pose.orientation", false}},
      {"geometry_msgs/PoseWithCovarianceStamped", {"", "pose.pose.position", "pose.pose.orientation", false}},
      {"geometry_msgs/TransformStamped", {"", "transform.translation", "transform.rotation", true}},
      {"nav_msgs/Odometry", {"", "pose.pose.position", "pose.pose.orientation", true}},
      {"tf2_msgs/TFMessage", {"transforms.", "transform.translation", "transform.rotation", true}}};
  return all;
}

// The definition that the bag carries, else the one that ROS ships.
Definitions definitions_of(const Topic& t) {
  if (t.definition_encoding.empty() || t.definition.empty()) return shipped_definitions();
  Definitions all = parse_definition(t.type, t.definition, t.definition_encoding);
  all.insert(shipped_definitions().begin(), shipped_definitions().end());
  return all;
}

Wire wire_of(const Topic& t) {
  if (t.serialization == "cdr") return Wire::cdr;
  if (t.serialization == "ros1") return Wire::ros1;
  throw InputError(
      fmt::format("topic {}: messages are written as '{}' (must be cdr or ros1)", t.name, t.serialization));
}

std::vector<std::string> stamp_paths(const Topic& t, const std::string& prefix, const Definitions& definitions) {
  const auto header = definitions.find("std_msgs/Header");
  const bool old = header != definitions.end() && std::any_of(header->second.begin(), header->second.end(),
                                                              [](const Field& f) { return f.type == "time"; });
  const bool ros1_time = old || wire_of(t) == Wire::ros1;
  const auto time = definitions.find("builtin_interfaces/Time");
  const bool nsec =
      !ros1_time && time != definitions.end() && time->second.size() == 2 && time->second[1].name == "nsec";
  return {prefix + "header.stamp.sec", prefix + (nsec ? "header.stamp.nsec" : "header.stamp.nanosec")};
}

/// Reads one topic of one bag.
class TopicReader {
 public:
  TopicReader(const Topic& t, std::vector<std::string> paths, const std::string& prefix, bool stamped)
      : name_(t.name), reader_(make(t, std::move(paths), prefix, stamped)) {}

  void read(const BagMessage& m, MessageValues& values, std::size_t number) const {
    try {
      if (is_zstd(m.data, m.size)) {  // no CDR header and no message of ROS 1 that is read begins so
        const std::vector<std::uint8_t> message = unpacked_message(m.data, m.size);
        return reader_.read(message.data(), message.size(), values);
      }
      reader_.read(m.data, m.size, values);
    } catch (const InputError& e) {
      throw InputError(fmt::format("topic {}: message {}: {}", name_, number, e.what()));
    }
  }

 private:
  static MessageReader make(const Topic& t, std::vector<std::string> paths, const std::string& prefix, bool stamped) {
    try {
      const Definitions definitions = definitions_of(t);
      if (stamped) {
        const std::vector<std::string> stamp = stamp_paths(t, prefix, definitions);
        paths.insert(paths.begin(), stamp.begin(), stamp.end());
      }
      return MessageReader(t.type, definitions, paths, wire_of(t));
    } catch (const InputError& e) {
      throw InputError(fmt::format("topic {}: {}", t.name, e.what()));
    }
  }
  std::string name_;
  MessageReader reader_;
};

constexpr double kLatest_s = 4294967296.0;  // the most that ROS 1 holds: of the year 2106

/// How and when a message came.
struct Receipt {
  const std::string& topic;
  std::size_t number;
  Nanoseconds at;

  void check(const char* what, double sec) const {
    if (std::abs(sec) <= kLatest_s) return;
    throw InputError(
        fmt::format("topic {}: message {}: {} is {} s (must be within +-{:.0f})", topic, number, what, sec, kLatest_s));
  }
  /// The header's stamp, or the time of receipt where it was left at zero.
  Nanoseconds stamp(double sec, double nanosec) const {
    check("header.stamp.sec", sec);
    check("header.stamp.nanosec", 1e-9 * nanosec);
    const Nanoseconds stamped = Nanoseconds(sec) * 1'000'000'000 + Nanoseconds(nanosec);
    return stamped == 0 ? at : stamped;
  }
};

template <class Take>
void read_topic(const Bags& bags, const std::string& name, const std::vector<std::string>& paths,
                const std::string& prefix, const Take& take, bool stamped = true) {
  std::size_t number = 0;
  MessageValues values;
  for (const auto& bag : bags) {
    const std::vector<Topic>& topics = bag->topics();
    std::set<std::size_t> wanted;
    std::map<std::size_t, TopicReader> readers;
    for (std::size_t i = 0; i < topics.size(); ++i) {
      if (topics[i].name != name) continue;
      wanted.insert(i);
      readers.emplace(i, TopicReader(topics[i], paths, prefix, stamped));
    }
    if (wanted.empty()) continue;
    bag->read(wanted, [&](const BagMessage& m) {
      readers.at(m.topic).read(m, values, ++number);
      const Receipt receipt{name, number, m.received};
      receipt.check("its time of receipt", double(m.received / 1'000'000'000));
      try {
        take(values, receipt);
      } catch (const std::out_of_range&) {  // by at()
        throw InputError(fmt::format("topic {}: message {}: its definition is not that of a {}", name, number,
                                     topics[m.topic].type));
      }
    });
  }
}

std::string type_of(const Bags& bags, const std::string& topic) {
  std::string type;
  for (const auto& bag : bags) {
    for (const Topic& t : bag->topics()) {
      if (t.name == topic) type = t.type;
    }
  }
  return type;
}

}  // namespace

bool holds_commands(const std::string& type) {
  return type == "geometry_msgs/Twist" || type == "geometry_msgs/TwistStamped";
}

bool holds_poses(const std::string& type) { return pose_types().count(type) > 0; }

void read_joint_states(const Bags& bags, const std::string& topic, const std::function<void(JointStates&)>& done) {
  JointStates states(topic);
  read_topic(bags, topic, {"name", "position", "velocity"}, "", [&](const MessageValues& v, const Receipt& receipt) {
    states.add(receipt.stamp(v.numbers[0].at(0), v.numbers[1].at(0)), v.texts[2], v.numbers[3], v.numbers[4]);
  });
  done(states);
}

void read_poses(const Bags& bags, const std::string& topic, const std::function<void(const StampedPose&)>& take) {
  const PosePaths& p = pose_types().at(type_of(bags, topic));
  std::vector<std::string> paths = {p.prefix + "header.frame_id",
                                    p.prefix + (p.child ? "child_frame_id" : "header.frame_id")};
  for (const char* c : {".x", ".y", ".z"}) paths.push_back(p.prefix + p.position + c);
  for (const char* c : {".x", ".y", ".z", ".w"}) paths.push_back(p.prefix + p.orientation + c);
  if (!p.child) paths.erase(paths.begin() + 1);
  const std::size_t first = p.child ? 4 : 3;
  read_topic(bags, topic, paths, p.prefix, [&](const MessageValues& v, const Receipt& receipt) {
    for (std::size_t i = 0; i < v.numbers[0].size(); ++i) {
      StampedPose s{receipt.stamp(v.numbers[0][i], v.numbers[1].at(i)),
                    v.texts[2].at(i),
                    p.child ? v.texts[3].at(i) : "",
                    {},
                    {}};
      for (std::size_t k = 0; k < 3; ++k) s.position[k] = v.numbers[first + k].at(i);
      for (std::size_t k = 0; k < 4; ++k) s.quaternion[k] = v.numbers[first + 3 + k].at(i);
      for (std::string* name : {&s.frame, &s.child}) {
        if (name->starts_with('/')) name->erase(0, 1);  // of ROS 1's first years
      }
      take(s);
    }
  });
}

void read_commands(const Bags& bags, const std::string& topic,
                   const std::function<void(Nanoseconds, double, double)>& take) {
  const bool stamped = type_of(bags, topic) == "geometry_msgs/TwistStamped";
  const std::string prefix = stamped ? "twist." : "";
  const std::size_t first = stamped ? 2 : 0;
  read_topic(
      bags, topic, {prefix + "linear.x", prefix + "angular.z"}, "",
      [&](const MessageValues& v, const Receipt& receipt) {
        take(stamped ? receipt.stamp(v.numbers[0].at(0), v.numbers[1].at(0)) : receipt.at, v.numbers[first].at(0),
             v.numbers[first + 1].at(0));
      },
      stamped);
}

}  // namespace umbsim::exchange

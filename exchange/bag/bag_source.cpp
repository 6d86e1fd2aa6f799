#include "exchange/bag/bag_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/error.h"
#include "exchange/bag/ros_messages.h"
#include "exchange/bag/transforms.h"
#include "exchange/import/truth/planar_track.h"
#include "exchange/text/column_meaning.h"
#include "exchange/text/pose_columns.h"

namespace umbsim::exchange {
namespace {

const char* const kJointState = "sensor_msgs/JointState";
const char* const kOdometry = "nav_msgs/Odometry";
const char* const kTf = "tf2_msgs/TFMessage";

bool is_known(const std::string& type) { return type == kJointState || holds_poses(type) || holds_commands(type); }

// Whether a topic has both wheels by the names of its joints.
bool has_wheels(const JointStates& states) {
  bool left = false, right = false;
  for (const std::string& joint : states.joints()) {
    left = left || side_of(words_in(joint)) == 'l';
    right = right || side_of(words_in(joint)) == 'r';
  }
  return left && right;
}

}  // namespace

BagSource::BagSource(std::string path, const std::vector<std::string>& files, const ImportOptions& options)
    : path_(std::move(path)), options_(options) {
  for (const std::string& file : files) bags_.push_back(open_bag(file));
  std::map<std::string, Topic> by_name;
  for (const auto& bag : bags_) {
    for (const Topic& t : bag->topics()) by_name.emplace(t.name, t);
  }
  for (const auto& [name, topic] : by_name) topics_.push_back(topic);
  if (topics_.empty()) throw InputError(SourceMark{path_}, "holds no topics");
}

std::vector<std::string> BagSource::topics_of(const std::vector<std::string>& types) const {
  std::vector<std::string> names;
  for (const Topic& t : topics_) {
    if (std::find(types.begin(), types.end(), t.type) != types.end()) names.push_back(t.name);
  }
  return names;
}

std::string BagSource::list() const {
  std::string text;
  for (const Topic& t : topics_) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", t.name, t.type);
  return text;
}

const Topic& BagSource::topic(const std::string& name, const std::string& option) const {
  const auto found = std::find_if(topics_.begin(), topics_.end(), [&](const Topic& t) { return t.name == name; });
  if (found != topics_.end()) return *found;
  throw InputError(fmt::format("{}: {} {}: there is no such topic; there are: {}", path_, option, name, list()));
}

// The robot's own odometry, turned back into what its wheels must have rolled.
void BagSource::wheels_of_odometry(const std::string& name, Log& log) const {
  const double base = options_.wheelbase_m.value_or(0);
  if (base <= 0) {
    throw InputError(
        fmt::format("{}: wheels from odometry {} need the wheelbase that the robot computes with: give "
                    "--wheelbase METRES",
                    path_, name));
  }
  PlanarTrack track(name, "+z");
  std::size_t number = 0;
  read_poses(bags_, name, [&](const StampedPose& p) {
    ++number;
    track.add(p.at, p.position, p.quaternion, [&] { return fmt::format("{}: message {}", name, number); });
  });
  const Track t = track.take();
  log.left = {name + " left", WheelUnit::m, false, t.at, {}};
  log.right = {name + " right", WheelUnit::m, false, t.at, {}};
  double left = 0, right = 0;
  for (std::size_t i = 0; i < t.pose.size(); ++i) {
    if (i > 0) {
      const Pose2 step = inverse(t.pose[i - 1]) * t.pose[i];
      const double chord = std::copysign(std::hypot(step.x_m, step.y_m), step.x_m);
      const double way = chord / sinc(step.theta_rad / 2);
      left += way - base / 2 * step.theta_rad;
      right += way + base / 2 * step.theta_rad;
    }
    log.left.value.push_back(left);
    log.right.value.push_back(right);
  }
  log.found.push_back(
      fmt::format("wheels: from the robot's odometry {} ({} messages) by the wheelbase that it is said to "
                  "compute with, {:g} m",
                  name, t.at.size(), base));
}

// Where several commands pass through a robot (navigation, smoother, multiplexer), the last one is called cmd_vel.
std::string BagSource::choose_commands(Log& log) const {
  if (!options_.commands.empty()) {
    const Topic& t = topic(options_.commands, "--commands");
    if (holds_commands(t.type)) return t.name;
    throw InputError(fmt::format("{}: --commands {}: {} holds no speeds (must be geometry_msgs/Twist or TwistStamped)",
                                 path_, t.name, t.type));
  }
  std::vector<std::string> all = topics_of({"geometry_msgs/Twist", "geometry_msgs/TwistStamped"});
  std::erase_if(all, [](const std::string& name) { return name.find("cmd") == std::string::npos; });
  std::vector<std::string> last = all;
  std::erase_if(last, [](const std::string& name) { return !("/" + name).ends_with("/cmd_vel"); });
  if (all.size() == 1) return all.front();
  if (last.size() == 1) return last.front();
  if (!all.empty()) {
    log.found.push_back(
        fmt::format("commands: several topics, none read: {}; choose one with --commands", fmt::join(all, ", ")));
  }
  return "";
}

void BagSource::commands(Log& log) const {
  const std::string name = options_.commands == "none" ? "" : choose_commands(log);
  if (name.empty()) return;
  BodyCommands commands{name, {}, {}, {}};
  read_commands(bags_, name, [&](Nanoseconds at, double linear_mps, double angular_radps) {
    const std::size_t number = commands.at.size() + 1;
    if (!std::isfinite(linear_mps) || !std::isfinite(angular_radps)) {
      throw InputError(fmt::format("{}: {}: message {}: a speed is not a finite number", path_, name, number));
    }
    if (!commands.at.empty() && at < commands.at.back()) {
      throw InputError(fmt::format("{}: {}: message {}: its time comes before the one before: stamps must increase",
                                   path_, name, number));
    }
    commands.at.push_back(at);
    commands.linear_mps.push_back(linear_mps);
    commands.angular_radps.push_back(angular_radps);
  });
  if (commands.at.empty()) return;
  log.found.push_back(
      fmt::format("commands: {} messages of {}, turned into wheel speeds by the wheel radius and "
                  "wheelbase as believed",
                  commands.at.size(), name));
  log.body_command = std::move(commands);
}

void BagSource::named(const std::function<void()>& work) const {
  try {
    work();
  } catch (const InputError& e) {
    const std::string what = e.what();
    const bool told = what.find(path_) != what.npos || what.find(options_.source) != what.npos;
    throw InputError(told ? what : path_ + ": " + what);
  }
}

void BagSource::read_wheels(Log& log) const {
  log.found.push_back(fmt::format("{}: {} topics: {}", path_, topics_.size(), list()));
  for (const Topic& t : topics_) {
    if (!is_known(t.type)) log.found.push_back(fmt::format("not used: {} ({})", t.name, t.type));
  }
  if (!options_.encoders.empty()) {
    const Topic& chosen = topic(options_.encoders, "--encoders");
    if (chosen.type == kOdometry) {
      wheels_of_odometry(chosen.name, log);
      return commands(log);
    }
    if (chosen.type != kJointState) {
      throw InputError(fmt::format("{}: --encoders {}: {} holds no wheels (must be {} or {})", path_, chosen.name,
                                   chosen.type, kJointState, kOdometry));
    }
    read_joint_states(bags_, chosen.name, [&](JointStates& s) { s.into(log, options_); });
    return commands(log);
  }
  wheels_of_joints(log);
  commands(log);
}

void BagSource::wheels_of_joints(Log& log) const {
  const std::vector<std::string> names = topics_of({kJointState});
  std::vector<JointStates> with_wheels, all;
  for (const std::string& name : names) {
    read_joint_states(bags_, name, [&](JointStates& s) {
      if (has_wheels(s)) with_wheels.push_back(s);
      all.push_back(std::move(s));
    });
  }
  if (all.empty()) {
    throw InputError(
        fmt::format("{}: no topic holds wheels ({}); there are: {}. From the robot's own odometry: --encoders "
                    "TOPIC",
                    path_, kJointState, list()));
  }
  if (all.size() > 1 && with_wheels.size() != 1) {
    throw InputError(
        fmt::format("{}: several topics hold joints: {} (two robots in one bag?); choose one with --encoders", path_,
                    fmt::join(names, ", ")));
  }
  (all.size() == 1 ? all.front() : with_wheels.front()).into(log, options_);
}

std::string BagSource::choose_truth() const {
  if (!options_.truth.empty()) return options_.truth;
  std::vector<std::string> candidates, odometry;
  for (const Topic& t : topics_) {
    if (!holds_poses(t.type) || t.type == kTf || t.name == options_.encoders) continue;
    const bool own = t.type == kOdometry && (t.name.ends_with("/odom") || sounds_like_odometry(t.name));
    (own ? odometry : candidates).push_back(t.name);
  }
  if (candidates.size() == 1) return candidates.front();
  if (candidates.size() > 1) {
    throw InputError(fmt::format("{}: several topics may be the truth: {}; choose one with --truth", path_,
                                 fmt::join(candidates, ", ")));
  }
  if (!topics_of({kTf}).empty()) return "tf:";
  throw InputError(fmt::format(
      "{}: no topic holds a truth{}: give --truth TOPIC, or --truth-file; there are: {}", path_,
      odometry.empty() ? "" : fmt::format(" ({} is the robot's own odometry by its name)", fmt::join(odometry, ", ")),
      list()));
}

void BagSource::read_truth(Log& log) const {
  const std::string chosen = choose_truth();
  PlanarTrack track(chosen, options_.up);
  std::size_t number = 0;
  const auto take = [&](const StampedPose& p) {
    ++number;
    track.add(p.at, p.position, p.quaternion, [&] { return fmt::format("{}: {}: pose {}", path_, chosen, number); });
  };
  std::string what;
  if (chosen.starts_with("tf:")) {
    Transforms tree;
    for (const std::string& name : topics_of({kTf})) {
      read_poses(bags_, name, [&](const StampedPose& p) { tree.add(p, name.ends_with("tf_static")); });
    }
    const std::string frames = chosen == "tf:" ? tree.guess() : chosen.substr(3);
    // Frames may have a namespace: the parent is what a frame of the tree is called.
    std::string parent;
    for (const std::string& edge : tree.edges()) {
      for (std::size_t at = frames.find('/'); at != std::string::npos; at = frames.find('/', at + 1)) {
        if (edge.starts_with(frames.substr(0, at + 1))) parent = frames.substr(0, at);
      }
    }
    if (parent.empty()) {
      throw InputError(
          fmt::format("{}: which transform is the truth cannot be told: give --truth tf:PARENT/CHILD; there "
                      "are: {}",
                      path_, fmt::join(tree.edges(), ", ")));
    }
    tree.follow(parent, frames.substr(parent.size() + 1), take);
    what = fmt::format("tf, frame {} in {}", frames.substr(parent.size() + 1), parent);
  } else {
    const Topic& t = topic(chosen, "--truth");
    if (!holds_poses(t.type)) {
      throw InputError(fmt::format("{}: --truth {}: {} holds no poses", path_, t.name, t.type));
    }
    read_poses(bags_, t.name, take);
    what = fmt::format("{} ({})", t.name, t.type);
  }
  const std::size_t repeated = track.repeated();
  log.truth = track.take();
  log.found.push_back(fmt::format("truth: {} poses of {}{}", log.truth.at.size(), what,
                                  repeated ? fmt::format(", {} repeated ones left out", repeated) : ""));
}

}  // namespace umbsim::exchange

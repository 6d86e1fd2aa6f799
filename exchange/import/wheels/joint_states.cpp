#include "exchange/import/wheels/joint_states.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "exchange/import/wheels/joint_choice.h"

namespace umbsim::exchange {

void JointStates::add(Nanoseconds at, const std::vector<std::string>& names, const std::vector<double>& positions,
                      const std::vector<double>& velocities) {
  ++messages_;
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: message {} ({:.6f} s): {}", topic_, messages_, double(at) * 1e-9, what));
  };
  for (const auto* values : {&positions, &velocities}) {
    if (!values->empty() && values->size() != names.size()) {
      fail(fmt::format("{} names, but {} {}", names.size(), values->size(),
                       values == &positions ? "positions" : "velocities"));
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    Joint& joint = joints_[names[i]];
    if (!joint.at.empty() && at <= joint.at.back()) {
      fail(
          fmt::format("joint '{}': the time stamp does not come after the one before, {:.6f} s: stamps must increase; "
                      "two senders on one topic, or two logs in one?",
                      names[i], double(joint.at.back()) * 1e-9));
    }
    joint.at.push_back(at);
    if (!positions.empty()) joint.position.push_back(positions[i]);
    if (!velocities.empty()) joint.velocity.push_back(velocities[i]);
  }
}

std::vector<std::string> JointStates::joints() const {
  std::vector<std::string> names;
  for (const auto& [name, joint] : joints_) names.push_back(name);
  return names;
}

WheelSignal JointStates::signal(const std::string& name) const {
  const Joint& joint = joints_.at(name);
  const bool positions = joint.position.size() == joint.at.size();
  if (!positions && joint.velocity.size() != joint.at.size()) {
    throw InputError(
        fmt::format("{}: joint '{}' has neither a position nor a velocity in every message", topic_, name));
  }
  WheelSignal s{topic_ + " " + name, positions ? WheelUnit::rad : WheelUnit::radps, false, joint.at,
                positions ? joint.position : joint.velocity};
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    if (std::isfinite(s.value[i])) continue;
    throw InputError(fmt::format("{}: joint '{}': its {} at {:.6f} s is not a finite number", topic_, name,
                                 positions ? "position" : "velocity", double(s.at[i]) * 1e-9));
  }
  return s;
}

void JointStates::into(Log& log, const ImportOptions& options) const {
  const auto [left, right] = choose_joints(joints(), options, topic_);
  log.left = signal(left);
  log.right = signal(right);
  const auto what = [](const WheelSignal& s) {
    return s.unit == WheelUnit::rad ? "position, rad" : "velocity, rad/s, summed up";
  };
  log.found.push_back(
      fmt::format("left wheel: joint '{}' of {} ({} messages), {}", left, topic_, log.left.at.size(), what(log.left)));
  log.found.push_back(fmt::format("right wheel: joint '{}', {}", right, what(log.right)));
}

}  // namespace umbsim::exchange

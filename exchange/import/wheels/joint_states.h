#pragma once

#include <map>
#include <string>
#include <vector>

#include "exchange/import/log.h"
#include "exchange/import/options.h"

namespace umbsim::exchange {

/// Gathers sensor_msgs/JointState messages of one topic, whatever brought them.
class JointStates {
 public:
  explicit JointStates(std::string topic) : topic_(std::move(topic)) {}

  /// `positions` (rad) and `velocities` (rad/s): as many as names, or none. Throws InputError: other lengths, numbers
  /// that are not finite, stamps that do not increase.
  void add(Nanoseconds at, const std::vector<std::string>& names, const std::vector<double>& positions,
           const std::vector<double>& velocities);

  std::vector<std::string> joints() const;
  /// The two drive joints' positions, or speeds where there are no positions. Throws InputError.
  void into(Log& log, const ImportOptions& options) const;
  const std::string& topic() const { return topic_; }

 private:
  struct Joint {
    std::vector<Nanoseconds> at;
    std::vector<double> position, velocity;
  };
  WheelSignal signal(const std::string& joint) const;

  std::string topic_;
  std::map<std::string, Joint> joints_;
  std::size_t messages_ = 0;
};

}  // namespace umbsim::exchange

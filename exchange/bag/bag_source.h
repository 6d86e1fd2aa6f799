#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "exchange/bag/bag.h"
#include "exchange/import/source.h"

namespace umbsim::exchange {

/// A ROS bag of any kind, in one file or several that follow each other.
class BagSource : public Source {
 public:
  BagSource(std::string path, const std::vector<std::string>& files, const ImportOptions& options);

  void wheels(Log& log) const override {
    named([&] { read_wheels(log); });
  }
  void truth(Log& log) const override {
    named([&] { read_truth(log); });
  }
  /// Always: which topic it is, is asked for where it cannot be told.
  bool has_truth() const override { return true; }

 private:
  /// Puts the bag's name before what is wrong with a message.
  void named(const std::function<void()>& work) const;
  void read_wheels(Log& log) const;
  void read_truth(Log& log) const;
  std::vector<std::string> topics_of(const std::vector<std::string>& types) const;
  const Topic& topic(const std::string& name, const std::string& option) const;
  std::string list() const;
  void wheels_of_odometry(const std::string& name, Log& log) const;
  std::string choose_truth() const;
  /// Empty: none.
  std::string choose_commands(Log& log) const;
  void wheels_of_joints(Log& log) const;
  void commands(Log& log) const;

  std::string path_;
  std::vector<std::unique_ptr<Bag>> bags_;
  std::vector<Topic> topics_;  ///< of all files, by name
  const ImportOptions& options_;
};

}  // namespace umbsim::exchange

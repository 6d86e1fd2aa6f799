#include <fmt/format.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/progress.h"
#include "exchange/bag/bag.h"
#include "exchange/bag/files/unpacked_file.h"

namespace umbsim::exchange {
namespace {

class Ros1Bag : public Bag {
 public:
  Ros1Bag(const std::string& file, const UnpackedFile* unpacked) : file_(file) {
    guarded([&] {
      bag_.open(unpacked ? unpacked->path() : file, rosbag::bagmode::Read);
      rosbag::View view(bag_);
      for (const rosbag::ConnectionInfo* c : view.getConnections()) {
        const bool known =
            std::any_of(topics_.begin(), topics_.end(), [&](const Topic& t) { return t.name == c->topic; });
        if (!known) topics_.push_back({c->topic, short_type(c->datatype), c->msg_def, "ros1msg", "ros1"});
      }
    });
  }

  const std::vector<Topic>& topics() const override { return topics_; }

  void read(const std::set<std::size_t>& wanted, const std::function<void(const BagMessage&)>& take) const override {
    std::vector<std::string> names;
    for (const std::size_t topic : wanted) names.push_back(topics_[topic].name);
    guarded([&] {
      rosbag::View view(bag_, rosbag::TopicQuery(names));
      std::vector<std::uint8_t> bytes;
      Progress progress("reading " + std::filesystem::path(file_).filename().string(), int(view.size()));
      for (const rosbag::MessageInstance& m : view) {
        progress.step();
        const auto topic =
            std::find_if(topics_.begin(), topics_.end(), [&](const Topic& t) { return t.name == m.getTopic(); });
        bytes.resize(m.size());
        ros::serialization::OStream stream(bytes.data(), std::uint32_t(bytes.size()));
        m.write(stream);
        take({std::size_t(topic - topics_.begin()), Nanoseconds(m.getTime().toNSec()), bytes.data(), bytes.size()});
      }
    });
  }

 private:
  template <class Work>
  void guarded(const Work& work) const {
    try {
      work();
    } catch (const rosbag::BagUnindexedException&) {
      throw InputError(SourceMark{file_},
                       "is cut off: it has no index (was the recorder killed?); `rosbag reindex` repairs it");
    } catch (const rosbag::BagException& e) {
      throw InputError(SourceMark{file_}, fmt::format("is no whole ROS 1 bag: {}", e.what()));
    } catch (const ros::Exception& e) {
      throw InputError(SourceMark{file_}, fmt::format("is no whole ROS 1 bag: {}", e.what()));
    }
  }

  std::string file_;
  rosbag::Bag bag_;
  std::vector<Topic> topics_;
};

}  // namespace

std::unique_ptr<Bag> open_ros1(const std::string& file, const UnpackedFile* unpacked) {
  return std::make_unique<Ros1Bag>(file, unpacked);
}

}  // namespace umbsim::exchange

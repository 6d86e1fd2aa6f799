#include "exchange/export/mcap_log.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "exchange/bag/files/mcap_writer.h"
#include "exchange/export/one_log.h"
#include "exchange/export/ros_definitions.h"

namespace umbsim::exchange {
namespace {

/// A message as it grows.
class Message {
 public:
  Message() : cdr_(buffer_, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS, eprosima::fastcdr::Cdr::DDS_CDR) {
    cdr_.serialize_encapsulation();
  }

  Message& header(Nanoseconds at, const std::string& frame) {
    cdr_.serialize(std::int32_t(at / 1'000'000'000));
    cdr_.serialize(std::uint32_t(at % 1'000'000'000));
    return text(frame);
  }
  Message& text(const std::string& value) {
    cdr_.serialize(value);
    return *this;
  }
  Message& count(std::uint32_t value) {
    cdr_.serialize(value);
    return *this;
  }
  Message& numbers(std::initializer_list<double> values) {
    for (const double v : values) cdr_.serialize(v);
    return *this;
  }
  Message& zeros(std::size_t many) {
    for (std::size_t i = 0; i < many; ++i) cdr_.serialize(0.0);
    return *this;
  }
  /// Position or translation, and the quaternion.
  Message& pose(const Pose2& p) {
    return numbers({p.x_m, p.y_m, 0, 0, 0, std::sin(p.theta_rad / 2), std::cos(p.theta_rad / 2)});
  }
  std::string_view bytes() { return {buffer_.getBuffer(), cdr_.getSerializedDataLength()}; }

 private:
  eprosima::fastcdr::FastBuffer buffer_;
  eprosima::fastcdr::Cdr cdr_;
};

Nanoseconds stamp(double time_s) { return kLogBegins_ns + Nanoseconds(std::llround(time_s * 1e9)); }

/// The channels of an exported log.
struct Channels {
  std::uint16_t joints, odometry, truth, tf, commands;
};

bool has_commands(const Recording& recording) {
  return std::any_of(recording.runs.begin(), recording.runs.end(), [](const RecordedRun& r) { return r.has_commands; });
}

Channels add_channels(mcap::Writer& writer, bool commands) {
  const auto add = [&](const char* topic, const std::string& package, const std::string& name) {
    return writer.add_topic(topic, package + "/msg/" + name, ros2_definition(package + "/" + name));
  };
  return {add("/joint_states", "sensor_msgs", "JointState"), add("/odom", "nav_msgs", "Odometry"),
          add("/truth", "geometry_msgs", "PoseStamped"), add("/tf", "tf2_msgs", "TFMessage"),
          commands ? add("/cmd_vel", "geometry_msgs", "TwistStamped") : std::uint16_t(0)};
}

void add_counts(mcap::Writer& writer, const Channels& c, Nanoseconds at, const EncoderSample& s, double ticks,
                const std::array<std::string, 2>& joints) {
  const double k = 2 * M_PI / ticks;
  Message m;
  m.header(at, "").count(2).text(joints[0]).text(joints[1]);
  m.count(2).numbers({k * double(s.left_ticks), k * double(s.right_ticks)}).count(0).count(0);
  writer.add(c.joints, at, m.bytes());
}

// Speeds of the body that a drive controller turns into those of the wheels, by what it believes of them.
void add_command(mcap::Writer& writer, const Channels& c, Nanoseconds at, const EncoderSample& s,
                 const RecordedRobot& robot) {
  const double left = robot.wheel_radius_m * s.left_command_radps, right = robot.wheel_radius_m * s.right_command_radps;
  Message m;
  m.header(at, "base_link").numbers({(left + right) / 2, 0, 0, 0, 0, (right - left) / robot.wheelbase_m});
  writer.add(c.commands, at, m.bytes());
}

// Once a run: the odometry starts where the robot stands.
void add_odometry(mcap::Writer& writer, const Channels& c, Nanoseconds at, const Pose2& X_OB) {
  Message m;
  m.header(at, "odom").text("base_link").pose(X_OB).zeros(36).zeros(6).zeros(36);
  writer.add(c.odometry, at, m.bytes());
  Message tf;
  tf.count(2).header(at, "map").text("odom").pose({}).header(at, "odom").text("base_link").pose(X_OB);
  writer.add(c.tf, at, tf.bytes());
}

}  // namespace

std::string mcap_log(const Recording& recording, const std::string& left_joint, const std::string& right_joint) {
  mcap::Writer writer("ros2", "umbsim");
  const Channels channels = add_channels(writer, has_commands(recording));
  const double ticks = recording.robot.ticks_per_revolution;
  for (const Placed& p : one_log(recording)) {
    const std::vector<Pose2> odometry = reckoned(*p.run, believed(recording.robot));
    std::size_t t = 0;
    const auto truth_until = [&](double time_s) {
      for (; t < p.run->truth.size() && p.run->truth[t].time_s <= time_s; ++t) {
        const Nanoseconds at = stamp(p.begin_s + p.run->truth[t].time_s);
        writer.add(channels.truth, at, Message().header(at, "map").pose(p.run->truth[t].X_WB).bytes());
      }
    };
    for (std::size_t i = 0; i < odometry.size(); ++i) {
      const EncoderSample& s = p.run->encoders[i];
      truth_until(s.time_s);
      const Nanoseconds at = stamp(p.begin_s + s.time_s);
      add_counts(writer, channels, at, s, ticks, {left_joint, right_joint});
      add_odometry(writer, channels, at, odometry[i]);
      if (p.run->has_commands) add_command(writer, channels, at, s, recording.robot);
    }
    truth_until(p.to_s);
  }
  return writer.finish();
}

std::string rosbag2_metadata(const Recording& recording, const std::string& file) {
  const std::vector<Placed> log = one_log(recording);
  std::size_t counts = 0, poses = 0, commands = 0;
  for (const RecordedRun& run : recording.runs) {
    commands += run.has_commands ? run.encoders.size() : 0;
    counts += run.encoders.size();
    poses += run.truth.size();
  }
  const auto from = Nanoseconds(std::llround(log.front().from_s * 1e9)),
             to = Nanoseconds(std::llround(log.back().to_s * 1e9));
  std::string text = fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n  duration:\n    nanoseconds: {}\n"
      "  starting_time:\n    nanoseconds_since_epoch: {}\n  message_count: {}\n  topics_with_message_count:\n",
      to - from, kLogBegins_ns + from, 3 * counts + poses + commands);
  for (const auto& [topic, type, count] : {std::tuple{"/joint_states", "sensor_msgs/msg/JointState", counts},
                                           std::tuple{"/odom", "nav_msgs/msg/Odometry", counts},
                                           std::tuple{"/truth", "geometry_msgs/msg/PoseStamped", poses},
                                           std::tuple{"/tf", "tf2_msgs/msg/TFMessage", counts},
                                           std::tuple{"/cmd_vel", "geometry_msgs/msg/TwistStamped", commands}}) {
    if (count == 0) continue;
    text += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n        serialization_format: cdr\n"
        "        offered_qos_profiles: \"\"\n      message_count: {}\n",
        topic, type, count);
  }
  return text +
         fmt::format("  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - {}\n", file);
}

}  // namespace umbsim::exchange

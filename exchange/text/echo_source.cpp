#include "exchange/text/echo_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "exchange/import/truth/planar_track.h"
#include "exchange/import/wheels/joint_states.h"
#include "exchange/text/pose_columns.h"

namespace umbsim::exchange {
namespace {

constexpr std::size_t kHeader = 3;  // sec, nanosec, frame_id

/// Messages with a pose in them, by how many cells they have.
struct PoseMessage {
  const char* type;
  std::size_t cells;
  std::size_t position;  ///< where x stands; the quaternion follows z
};
constexpr std::array<PoseMessage, 4> kPoses = {{{"geometry_msgs/msg/PoseStamped", 10, 3},
                                                {"geometry_msgs/msg/TransformStamped", 11, 4},
                                                {"geometry_msgs/msg/PoseWithCovarianceStamped", 46, 3},
                                                {"nav_msgs/msg/Odometry", 89, 4}}};

Nanoseconds stamp(const Table& t, std::size_t row) { return t.time(row, 0, 1'000'000'000) + t.time(row, 1, 1); }

const PoseMessage* pose_message(const Table& t) {
  for (const PoseMessage& m : kPoses) {
    if (t.cells(0) == m.cells && t.is_number(0, m.position) && (m.position == 3 || !t.is_number(0, 3))) return &m;
  }
  return nullptr;
}

// names, then as many positions, velocities and efforts; an empty array leaves one blank cell.
void add_joint_state(const Table& t, std::size_t row, JointStates& states) {
  const std::size_t cells = t.cells(row);
  std::size_t at = kHeader;
  std::vector<std::string> names;
  while (at < cells && !t.is_blank(row, at) && !t.is_number(row, at)) names.emplace_back(t.cell(row, at++));
  if (names.empty()) t.fail(row, std::min(at, cells - 1), "no joint names follow the header: not a JointState");
  if (names.back() == "...") t.fail(row, at - 1, "the message was shortened: echo it with --full-length");
  const auto array = [&] {
    std::vector<double> values;
    if (at < cells && t.is_blank(row, at)) {
      ++at;
      return values;
    }
    for (std::size_t i = 0; i < names.size() && at < cells; ++i) values.push_back(t.number(row, at++));
    return values;
  };
  const std::vector<double> positions = array();
  const std::vector<double> velocities = array();
  array();
  if (at != cells) t.fail(row, at, fmt::format("{} cells do not make a JointState of {} joints", cells, names.size()));
  states.add(stamp(t, row), names, positions, velocities);
}

}  // namespace

bool EchoSource::looks_like(const Table& t) {
  if (!t.names().empty() || t.cells(0) < 10) return false;
  const auto is_integer = [&](std::size_t column) {
    const std::string_view cell = t.cell(0, column);
    return !cell.empty() && cell.find_first_not_of("0123456789") == std::string_view::npos;
  };
  return is_integer(0) && is_integer(1) && (t.is_blank(0, 2) || !t.is_number(0, 2));
}

bool EchoSource::has_truth() const { return pose_message(table_) != nullptr; }

void EchoSource::wheels(Log& log) const {
  if (const PoseMessage* m = pose_message(table_)) {
    throw InputError(fmt::format("{}: holds {}, no wheels: give it with --truth-file, and the JointState's as SOURCE",
                                 table_.file(), m->type));
  }
  JointStates states(table_.file());
  for (std::size_t row = 0; row < table_.rows(); ++row) add_joint_state(table_, row, states);
  log.found.push_back(
      fmt::format("{}: {} rows of `ros2 topic echo --csv`, sensor_msgs/msg/JointState", table_.file(), table_.rows()));
  states.into(log, options_);
}

void EchoSource::truth(Log& log) const {
  const PoseMessage* m = pose_message(table_);
  if (!m) throw InputError(fmt::format("{}: holds no poses: give the truth with --truth-file", table_.file()));
  table_.check_even();
  const std::string frames = fmt::format("{} {}", table_.cell(0, 2), m->position == 4 ? table_.cell(0, 3) : "");
  if (m->cells == 89 && options_.truth.empty() && sounds_like_odometry(table_.file() + " " + frames)) {
    throw InputError(
        fmt::format("{}: is the robot's own odometry by its names ({}), which is no truth: give --truth {} "
                    "if it is a tracker's",
                    table_.file(), frames, table_.cell(0, 2)));
  }
  PlanarTrack track(table_.file(), options_.up);
  for (std::size_t row = 0; row < table_.rows(); ++row) {
    const auto n = [&](std::size_t i) { return table_.number(row, m->position + i); };
    track.add(stamp(table_, row), {n(0), n(1), n(2)}, {n(3), n(4), n(5), n(6)},
              [&] { return fmt::format("{}: message {}", table_.file(), row + 1); });
  }
  log.truth = track.take();
  log.found.push_back(fmt::format("truth: {} messages {} ({})", log.truth.at.size(), m->type, frames));
}

}  // namespace umbsim::exchange

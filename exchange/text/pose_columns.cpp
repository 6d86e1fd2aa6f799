#include "exchange/text/pose_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"
#include "exchange/import/truth/planar_track.h"

namespace umbsim::exchange {
namespace {

/// Where a group's numbers stand.
struct Group {
  std::map<Role, std::size_t> at;
  bool repeated = false;

  bool has(Role role) const { return at.count(role) > 0; }
  bool turned() const {
    return has(Role::heading) || (has(Role::qx) && has(Role::qy) && has(Role::qz) && has(Role::qw));
  }
  bool whole() const { return has(Role::x) && has(Role::y) && turned(); }
};

std::map<std::string, Group> groups_of(const Columns& columns) {
  static const std::set<Role> kParts = {Role::x,  Role::y,  Role::z,  Role::qx,
                                        Role::qy, Role::qz, Role::qw, Role::heading};
  std::map<std::string, Group> groups;
  for (std::size_t i = 0; i < columns.count(); ++i) {
    const ColumnMeaning& m = columns.meaning(i);
    if (!kParts.count(m.role)) continue;
    Group& g = groups[m.group];
    // PlotJuggler adds yaw in radians and in degrees: the one that ROS has.
    if (!g.at.emplace(m.role, i).second && m.unit == "rad") g.at[m.role] = i;
  }
  return groups;
}

double length_factor(const Columns& columns, std::size_t column, const std::string& said) {
  const std::string unit = said.empty() ? columns.meaning(column).unit : said;
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  throw InputError(fmt::format("{}: the unit of column '{}' cannot be told: give --truth-unit m, cm or mm",
                               columns.table().file(), columns.name(column)));
}

double angle_factor(const Columns& columns, std::size_t column, const std::string& said) {
  const std::string unit = said.empty() ? columns.meaning(column).unit : said;
  if (unit == "rad") return 1;
  if (unit == "deg") return M_PI / 180;
  throw InputError(fmt::format("{}: the unit of column '{}' cannot be told: give --heading-unit rad or deg",
                               columns.table().file(), columns.name(column)));
}

Group chosen(const Columns& columns, const ImportOptions& o, std::string& label) {
  Group group;
  if (!o.x_column.empty() || !o.y_column.empty() || !o.heading_column.empty()) {
    label = "columns as given";
    group.at[Role::x] = columns.choose(columns.of(Role::x), o.x_column, "--x-column", "the truth's x");
    group.at[Role::y] = columns.choose(columns.of(Role::y), o.y_column, "--y-column", "the truth's y");
    group.at[Role::heading] =
        columns.choose(columns.of(Role::heading), o.heading_column, "--heading-column", "the truth's heading");
    return group;
  }
  std::vector<std::string> whole, odometry;
  const std::map<std::string, Group> groups = groups_of(columns);
  for (const auto& [name, g] : groups) {
    if (!g.whole()) continue;
    if (!o.truth.empty()) {
      if (columns.name(g.at.at(Role::x)).find(o.truth) != std::string::npos) whole.push_back(name);
    } else {
      (sounds_like_odometry(name) ? odometry : whole).push_back(name);
    }
  }
  const auto list = [&](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& n : names) text += (text.empty() ? "" : ", ") + columns.name(groups.at(n).at.at(Role::x));
    return text;
  };
  const std::string& file = columns.table().file();
  if (whole.size() > 1)
    throw InputError(
        fmt::format("{}: several groups of columns may be the truth: {}; say with --truth how its columns' "
                    "names begin",
                    file, list(whole)));
  if (whole.empty() && !odometry.empty())
    throw InputError(
        fmt::format("{}: {} is the robot's own odometry by its name, which is no truth: give --truth-file, "
                    "or --truth if it is a tracker's",
                    file, list(odometry)));
  if (whole.empty())
    throw InputError(
        fmt::format("{}: holds no truth (x, y and a heading or a quaternion): give --truth-file, or "
                    "--x-column, --y-column and --heading-column; there are: {}",
                    file, columns.list()));
  label = whole.front();
  return groups.at(whole.front());
}

// A heading that jumps by a turn and stays within one is wrapped; the tracker's samples are dense.
std::size_t unwrap(Track& track) {
  const auto [low, high] = std::minmax_element(
      track.pose.begin(), track.pose.end(), [](const Pose2& a, const Pose2& b) { return a.theta_rad < b.theta_rad; });
  if (track.pose.size() < 10 || high->theta_rad - low->theta_rad > 2 * M_PI + 1e-3) return 0;
  std::size_t jumps = 0;
  double add = 0;
  for (std::size_t i = 1; i < track.pose.size(); ++i) {
    const double step = track.pose[i].theta_rad + add - track.pose[i - 1].theta_rad;
    if (std::abs(step) > 1.5 * M_PI) {
      add -= std::copysign(2 * M_PI, step);
      ++jumps;
    }
    track.pose[i].theta_rad += add;
  }
  return jumps;
}

}  // namespace

bool sounds_like_odometry(const std::string& name) {
  const std::vector<std::string> words = words_in(name);
  const auto has = [&](const std::set<std::string>& wanted) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& w) { return wanted.count(w) > 0; });
  };
  return has({"odom", "odometry", "odo", "wheel", "wheels", "estimate", "estimated", "belief", "reckoning", "raw"}) &&
         !has({"truth", "mocap", "vicon", "optitrack", "qualisys", "gt", "slam", "vio", "tracker"});
}

Track track_of_columns(const Columns& columns, std::size_t time, std::int64_t time_ns, const ImportOptions& options,
                       std::vector<std::string>& found) {
  const Table& table = columns.table();
  std::string label;
  const Group g = chosen(columns, options, label);
  const double lx = length_factor(columns, g.at.at(Role::x), options.truth_unit);
  const double ly = length_factor(columns, g.at.at(Role::y), options.truth_unit);
  const bool quaternion = !g.has(Role::heading);
  const double turn = quaternion ? 1 : angle_factor(columns, g.at.at(Role::heading), options.heading_unit);
  PlanarTrack track(label, options.up);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.is_blank(row, g.at.at(Role::x))) continue;
    const auto number = [&](Role role) { return g.has(role) ? table.number(row, g.at.at(role)) : 0.0; };
    const auto where = [&] { return fmt::format("{}: row {} of numbers", table.file(), row + 1); };
    const Nanoseconds at = table.time(row, time, time_ns);
    const double x = lx * number(Role::x), y = ly * number(Role::y);
    if (quaternion) {
      track.add(at, {x, y, lx * number(Role::z)},
                {number(Role::qx), number(Role::qy), number(Role::qz), number(Role::qw)}, where);
    } else {
      track.add(at, {x, y, turn * number(Role::heading)}, where);
    }
  }
  Track result = track.take();
  const std::size_t jumps = quaternion ? 0 : unwrap(result);
  found.push_back(fmt::format("truth: {} poses of columns '{}', '{}', '{}'{}{}", result.at.size(),
                              columns.name(g.at.at(Role::x)), columns.name(g.at.at(Role::y)),
                              columns.name(g.at.at(quaternion ? Role::qz : Role::heading)),
                              quaternion  ? " (a quaternion)"
                              : turn == 1 ? ", rad"
                                          : ", deg",
                              jumps ? fmt::format(", {} turns unwrapped", jumps) : ""));
  return result;
}

}  // namespace umbsim::exchange

#include "exchange/text/column_meaning.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace umbsim::exchange {
namespace {

using Words = std::vector<std::string>;

bool has(const Words& words, const std::set<std::string>& wanted) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& w) { return wanted.count(w) > 0; });
}

// How units are written, by their text without blanks and signs.
const std::map<std::string, std::string>& spellings() {
  static const std::map<std::string, std::string> all = {{"rad", "rad"},
                                                         {"radian", "rad"},
                                                         {"radians", "rad"},
                                                         {"deg", "deg"},
                                                         {"degree", "deg"},
                                                         {"degrees", "deg"},
                                                         {"\xc2\xb0", "deg"},
                                                         {"rev", "rev"},
                                                         {"revs", "rev"},
                                                         {"revolutions", "rev"},
                                                         {"rotations", "rev"},
                                                         {"m", "m"},
                                                         {"meter", "m"},
                                                         {"meters", "m"},
                                                         {"metre", "m"},
                                                         {"metres", "m"},
                                                         {"mm", "mm"},
                                                         {"cm", "cm"},
                                                         {"tick", "ticks"},
                                                         {"ticks", "ticks"},
                                                         {"count", "ticks"},
                                                         {"counts", "ticks"},
                                                         {"pulse", "ticks"},
                                                         {"pulses", "ticks"},
                                                         {"radps", "rad/s"},
                                                         {"rad/s", "rad/s"},
                                                         {"rads", "rad/s"},
                                                         {"radpers", "rad/s"},
                                                         {"degps", "deg/s"},
                                                         {"deg/s", "deg/s"},
                                                         {"\xc2\xb0/s", "deg/s"},
                                                         {"dps", "deg/s"},
                                                         {"degpers", "deg/s"},
                                                         {"rpm", "rpm"},
                                                         {"mps", "m/s"},
                                                         {"m/s", "m/s"},
                                                         {"mpers", "m/s"},
                                                         {"ms", "ms"},
                                                         {"mm/s", "mm/s"},
                                                         {"mmps", "mm/s"},
                                                         {"s", "s"},
                                                         {"sec", "s"},
                                                         {"secs", "s"},
                                                         {"second", "s"},
                                                         {"seconds", "s"},
                                                         {"msec", "ms"},
                                                         {"millis", "ms"},
                                                         {"milliseconds", "ms"},
                                                         {"us", "us"},
                                                         {"\xc2\xb5s", "us"},
                                                         {"usec", "us"},
                                                         {"micros", "us"},
                                                         {"microseconds", "us"},
                                                         {"ns", "ns"},
                                                         {"nsec", "ns"},
                                                         {"nanosec", "ns"},
                                                         {"nanos", "ns"},
                                                         {"nanoseconds", "ns"}};
  return all;
}

std::string spelled(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (std::string(" ^-_").find(c) == std::string::npos) plain += char(std::tolower(static_cast<unsigned char>(c)));
  }
  if (plain == "rads1") plain = "rad/s";
  if (plain == "ms1") plain = "m/s";
  const auto found = spellings().find(plain);
  return found == spellings().end() ? "" : found->second;
}

// Of "left [rad/s]" the unit, and the name without it; else of "left_rad_s" the last words that are one.
std::string take_unit(std::string& name) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t from = name.rfind(open), to = name.rfind(close);
    if (from == std::string::npos || to == std::string::npos || to < from) continue;
    const std::string unit = spelled(name.substr(from + 1, to - from - 1));
    if (unit.empty()) continue;
    name.erase(from, to - from + 1);
    return unit;
  }
  const Words words = words_in(name);
  for (const std::size_t count : {std::size_t(3), std::size_t(2), std::size_t(1)}) {
    if (words.size() <= count) continue;
    std::string last;
    for (std::size_t i = words.size() - count; i < words.size(); ++i)
      last.append(words[i]).append(i + 1 < words.size() ? " " : "");
    // "rad s", "m s": a slash was not allowed there.
    if (count == 2 && (last == "rad s" || last == "deg s" || last == "m s" || last == "mm s"))
      last[last.find(' ')] = '/';
    const std::string unit = spelled(last);
    if (!unit.empty()) return unit;
  }
  return "";
}

bool is_wheel_unit(const std::string& unit) {
  return !unit.empty() && unit != "s" && unit != "ms" && unit != "us" && unit != "ns";
}

// What ROS messages hold: JointState's position and velocity, poses.
bool is_ros(const std::string& name) {
  return name.find('/') != std::string::npos || name.find("field.") == 0 || name.find("position[") != std::string::npos;
}

Role wheel_role(const Words& words, char side) {
  static const std::set<std::string> kCommand = {"command", "commands", "cmd",    "target",   "setpoint",
                                                 "desired", "ref",      "demand", "reference"};
  static const std::set<std::string> kElse = {"effort",      "torque", "current",      "voltage", "pwm",
                                              "temperature", "power",  "acceleration", "accel",   "acc"};
  if (has(words, kElse)) return Role::other;
  if (has(words, kCommand)) return side == 'l' ? Role::left_command : Role::right_command;
  return side == 'l' ? Role::left : Role::right;
}

Role pose_role(const Words& words) {
  static const std::set<std::string> kElse = {"twist",   "velocity",     "vel",   "covariance", "linear",
                                              "angular", "acceleration", "roll",  "pitch",      "cmd",
                                              "gyro",    "acc",          "speed", "vx",         "vy"};
  if (has(words, kElse) || words.empty()) return Role::other;
  const std::string& last = words.back();
  const bool turning = has(words, {"orientation", "rotation", "quaternion", "quat", "q"});
  if (last == "qx" || (turning && last == "x")) return Role::qx;
  if (last == "qy" || (turning && last == "y")) return Role::qy;
  if (last == "qz" || (turning && last == "z")) return Role::qz;
  if (last == "qw" || (turning && last == "w")) return Role::qw;
  if (last == "x") return Role::x;
  if (last == "y") return Role::y;
  if (last == "z") return Role::z;
  if (has({last}, {"theta", "yaw", "heading", "phi", "psi"})) return Role::heading;
  return Role::other;
}

}  // namespace

Words words_in(const std::string& name) {
  Words words;
  std::string word;
  const auto end = [&] {
    if (!word.empty()) words.push_back(word);
    word.clear();
  };
  char before = 0;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (!std::isalnum(byte) && byte < 0x80) {
      end();
    } else {
      if (std::isupper(byte) && std::islower(static_cast<unsigned char>(before))) end();
      if (std::isdigit(byte) && std::isalpha(static_cast<unsigned char>(before))) end();
      word += char(std::tolower(byte));
    }
    before = c;
  }
  end();
  return words;
}

char side_of(const Words& words) {
  const bool left = has(words, {"left", "l", "lft", "lh", "lw", "wl", "leftwheel", "wheelleft", "lwheel", "links"});
  const bool right =
      has(words, {"right", "r", "rgt", "rh", "rw", "wr", "rightwheel", "wheelright", "rwheel", "rechts"});
  return left == right ? 0 : left ? 'l' : 'r';
}

ColumnMeaning meaning_of(const std::string& column) {
  ColumnMeaning m;
  std::string name = column;
  m.unit = take_unit(name);
  Words words = words_in(name);
  while (words.size() > 1 && !spelled(words.back()).empty()) words.pop_back();
  m.ros = is_ros(column);
  if (words.empty()) return m;
  const std::set<std::string> kTime = {"time", "t", "timestamp", "stamp", "zeit"};
  if (has({words.back()}, kTime) || (has(words, kTime) && !is_wheel_unit(m.unit))) {
    m.role = Role::time;
    if (column == "__time") m.unit = std::string(1, 's');  // not = "s": GCC 12 then warns of an overlap
    return m;
  }
  m.rate = has(words, {"velocity", "vel", "speed", "rate", "omega"});
  m.per_sample = has(words, {"delta", "diff", "increment", "increments", "inc"});
  if (const char side = side_of(words)) {
    m.role = wheel_role(words, side);
    if (m.ros && m.unit.empty() && has({words.back()}, {"position", "velocity"})) {
      m.unit = words.back() == "position" ? "rad" : "rad/s";
    }
    return m;
  }
  m.role = pose_role(words);
  if (m.role == Role::other) return m;
  words.pop_back();
  static const std::set<std::string> kPart = {"position", "orientation", "pose",       "translation", "rotation",
                                              "pos",      "transform",   "quaternion", "quat",        "q"};
  for (const std::string& w : words) {
    if (!kPart.count(w)) m.group.append(m.group.empty() ? "" : "/").append(w);
  }
  if (m.ros && m.unit.empty()) m.unit = m.role == Role::heading ? "rad" : "m";
  return m;
}

}  // namespace umbsim::exchange

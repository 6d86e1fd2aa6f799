#include "exchange/bag/messages/definition.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "core/error.h"
#include "exchange/bag/messages/array_length.h"
#include "exchange/bag/messages/idl.h"

namespace umbsim::exchange {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t\r");
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

std::string package_of(const std::string& type) { return type.substr(0, type.find('/')); }

// "float64[<=5]", "string<=10", "Pose[2]": the bound does not change how it is written.
Field field_of(std::string type, const std::string& name, const std::string& package) {
  Field f;
  f.name = name;
  if (const std::size_t open = type.find('['); open != std::string::npos) {
    const std::string inside = type.substr(open + 1, type.find(']', open) - open - 1);
    f.is_array = true;
    if (!inside.empty() && inside.front() != '<') f.count = array_length(trimmed(inside));
    type.erase(open);
  }
  if (const std::size_t bound = type.find("<="); bound != std::string::npos) type.erase(bound);
  f.type = type;
  if (is_primitive(type)) return f;
  if (type == "Header")
    f.type = "std_msgs/Header";
  else if (type.find('/') == std::string::npos)
    f.type = package + "/" + type;
  f.type = short_type(f.type);
  return f;
}

// One text of `type name`, without constants.
std::vector<Field> fields_in(const std::string& type, const std::string& text) {
  std::vector<Field> fields;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::size_t blank = line.find_first_of(" \t");
    if (blank == std::string::npos) throw InputError(fmt::format("definition of {}: '{}' is no field", type, line));
    const std::string rest = trimmed(line.substr(blank));
    const std::string name = rest.substr(0, rest.find_first_of(" \t="));
    const std::string after = trimmed(rest.substr(name.size()));
    if (!after.empty() && after.front() == '=') continue;  // a constant
    fields.push_back(field_of(line.substr(0, blank), name, package_of(type)));
  }
  return fields;
}

const char* const kShipped = R"(builtin_interfaces/Time sec:int32 nanosec:uint32
std_msgs/Header stamp:builtin_interfaces/Time frame_id:string
geometry_msgs/Point x:float64 y:float64 z:float64
geometry_msgs/Vector3 x:float64 y:float64 z:float64
geometry_msgs/Quaternion x:float64 y:float64 z:float64 w:float64
geometry_msgs/Pose position:geometry_msgs/Point orientation:geometry_msgs/Quaternion
geometry_msgs/PoseStamped header:std_msgs/Header pose:geometry_msgs/Pose
geometry_msgs/PoseWithCovariance pose:geometry_msgs/Pose covariance:float64[36]
geometry_msgs/PoseWithCovarianceStamped header:std_msgs/Header pose:geometry_msgs/PoseWithCovariance
geometry_msgs/Transform translation:geometry_msgs/Vector3 rotation:geometry_msgs/Quaternion
geometry_msgs/TransformStamped header:std_msgs/Header child_frame_id:string transform:geometry_msgs/Transform
geometry_msgs/Twist linear:geometry_msgs/Vector3 angular:geometry_msgs/Vector3
geometry_msgs/TwistStamped header:std_msgs/Header twist:geometry_msgs/Twist
geometry_msgs/TwistWithCovariance twist:geometry_msgs/Twist covariance:float64[36]
nav_msgs/Odometry header:std_msgs/Header child_frame_id:string pose:geometry_msgs/PoseWithCovariance twist:geometry_msgs/TwistWithCovariance
sensor_msgs/JointState header:std_msgs/Header name:string[] position:float64[] velocity:float64[] effort:float64[]
tf2_msgs/TFMessage transforms:geometry_msgs/TransformStamped[]
)";

}  // namespace

std::string short_type(const std::string& type) {
  std::string slashed = type;
  for (std::size_t at; (at = slashed.find("::")) != std::string::npos;) slashed.replace(at, 2, 1, '/');
  if (const std::size_t at = slashed.find("/msg/"); at != std::string::npos) slashed.replace(at, 5, 1, '/');
  if (slashed == "tf/tfMessage") return "tf2_msgs/TFMessage";  // of ROS 1's first years; the same fields
  return slashed;
}

bool is_primitive(const std::string& type) {
  static const std::set<std::string> all = {"bool",   "byte",   "char",    "float32", "float64", "int8",
                                            "uint8",  "int16",  "uint16",  "int32",   "uint32",  "int64",
                                            "uint64", "string", "wstring", "time",    "duration"};
  return all.count(type) > 0;
}

Definitions parse_definition(const std::string& type, const std::string& text, const std::string& encoding) {
  if (encoding == "ros2idl") return parse_idl(text);
  Definitions all;
  std::string name = short_type(type), part;
  std::istringstream lines(text);
  const auto end = [&] { all[name] = fields_in(name, part); };
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("====")) {
      end();
      part.clear();
      name.clear();
    } else if (name.empty() && line.starts_with("MSG: ")) {
      name = short_type(trimmed(line.substr(5)));
    } else {
      part += line + "\n";
    }
  }
  end();
  return all;
}

const Definitions& shipped_definitions() {
  static const Definitions all = [] {
    Definitions definitions;
    std::istringstream lines(kShipped);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string type, word;
      words >> type;
      while (words >> word) {
        const std::size_t colon = word.find(':');
        definitions[type].push_back(field_of(word.substr(colon + 1), word.substr(0, colon), package_of(type)));
      }
    }
    return definitions;
  }();
  return all;
}

}  // namespace umbsim::exchange

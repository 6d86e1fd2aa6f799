#include "exchange/export/ros_definitions.h"

#include <map>
#include <vector>

namespace umbsim::exchange {
namespace {

struct Definition {
  const char* text;
  std::vector<std::string> parts;  ///< types in it
};

const std::map<std::string, Definition>& definitions() {
  static const std::map<std::string, Definition> all = {
      {"builtin_interfaces/Time", {"int32 sec\nuint32 nanosec\n", {}}},
      {"std_msgs/Header", {"builtin_interfaces/Time stamp\nstring frame_id\n", {"builtin_interfaces/Time"}}},
      {"geometry_msgs/Point", {"float64 x\nfloat64 y\nfloat64 z\n", {}}},
      {"geometry_msgs/Vector3", {"float64 x\nfloat64 y\nfloat64 z\n", {}}},
      {"geometry_msgs/Quaternion", {"float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n", {}}},
      {"geometry_msgs/Pose",
       {"Point position\nQuaternion orientation\n", {"geometry_msgs/Point", "geometry_msgs/Quaternion"}}},
      {"geometry_msgs/PoseStamped", {"std_msgs/Header header\nPose pose\n", {"std_msgs/Header", "geometry_msgs/Pose"}}},
      {"geometry_msgs/PoseWithCovariance", {"Pose pose\nfloat64[36] covariance\n", {"geometry_msgs/Pose"}}},
      {"geometry_msgs/Twist", {"Vector3  linear\nVector3  angular\n", {"geometry_msgs/Vector3"}}},
      {"geometry_msgs/TwistStamped",
       {"std_msgs/Header header\nTwist twist\n", {"std_msgs/Header", "geometry_msgs/Twist"}}},
      {"geometry_msgs/TwistWithCovariance", {"Twist twist\nfloat64[36] covariance\n", {"geometry_msgs/Twist"}}},
      {"geometry_msgs/Transform",
       {"Vector3 translation\nQuaternion rotation\n", {"geometry_msgs/Vector3", "geometry_msgs/Quaternion"}}},
      {"geometry_msgs/TransformStamped",
       {"std_msgs/Header header\nstring child_frame_id\nTransform transform\n",
        {"std_msgs/Header", "geometry_msgs/Transform"}}},
      {"nav_msgs/Odometry",
       {"std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
        "geometry_msgs/TwistWithCovariance twist\n",
        {"std_msgs/Header", "geometry_msgs/PoseWithCovariance", "geometry_msgs/TwistWithCovariance"}}},
      {"sensor_msgs/JointState",
       {"std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n",
        {"std_msgs/Header"}}},
      {"tf2_msgs/TFMessage", {"geometry_msgs/TransformStamped[] transforms\n", {"geometry_msgs/TransformStamped"}}}};
  return all;
}

void collect(const std::string& type, std::vector<std::string>& found) {
  for (const std::string& part : definitions().at(type).parts) {
    bool known = false;
    for (const std::string& f : found) known = known || f == part;
    if (known) continue;
    found.push_back(part);
    collect(part, found);
  }
}

}  // namespace

std::string ros2_definition(const std::string& type) {
  std::string text = definitions().at(type).text;
  std::vector<std::string> parts;
  collect(type, parts);
  for (const std::string& part : parts) {
    text += std::string(80, '=') + "\nMSG: " + part + "\n" + definitions().at(part).text;
  }
  return text;
}

}  // namespace umbsim::exchange

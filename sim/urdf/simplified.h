#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/urdf/source.h"

namespace umbsim {

/// Springs by joint, where the file gives them.
std::map<std::string, JointSpring> springs_of(const tinyxml2::XMLElement& robot);

/// Friction by link, where Gazebo's elements give one.
std::map<std::string, double> frictions_of(const tinyxml2::XMLElement& robot);

/// Takes out collisions that are no shape of URDF, as <capsule> or an empty <geometry>: link and what it was.
std::vector<std::pair<std::string, std::string>> drop_odd_collisions(tinyxml2::XMLElement& robot);

/// Takes out of a URDF what urdfdom stumbles over and nobody here needs, such as colours, and completes joint limits.
/// Names of the joints whose limits were missing or incomplete.
std::vector<std::string> simplify(tinyxml2::XMLElement& robot);

}  // namespace umbsim

#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "sim/urdf_source.h"

namespace umbsim {

/// Springs by joint, where the file gives them.
std::map<std::string, JointSpring> springs_of(const tinyxml2::XMLElement& robot);

/// Takes out of a URDF what urdfdom stumbles over and nobody here needs, such as colours, and completes joint limits.
/// Names of the joints whose limits were missing or incomplete.
std::vector<std::string> simplify(tinyxml2::XMLElement& robot);

}  // namespace umbsim

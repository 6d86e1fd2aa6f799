#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace umbsim {

/// Every corner of every geometry of a Collada document where its scene places it, in metres; its axes as they are.
/// Empty if it cannot be read.
std::vector<Eigen::Vector3d> collada_points(const std::string& document);

}  // namespace umbsim

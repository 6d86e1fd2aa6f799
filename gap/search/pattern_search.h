#pragma once

#include <Eigen/Core>
#include <functional>

namespace umbsim::gap {

/// Searches from `start` by steps along one coordinate at a time, or along two where none alone leads up, which are
/// halved where neither does: for functions without derivatives, and for places that a robot meets or misses. `step`:
/// first steps; `halvings`: how often they are halved.
Eigen::VectorXd pattern_search(const std::function<double(const Eigen::VectorXd&)>& value, Eigen::VectorXd start,
                               Eigen::VectorXd step, const Eigen::VectorXd& min, const Eigen::VectorXd& max,
                               int halvings, int most_values);

}  // namespace umbsim::gap

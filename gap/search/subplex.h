#pragma once

#include <Eigen/Core>
#include <functional>

namespace umbsim::gap {

/// Numbers with a high value near `start`, found without derivatives by subplex, simplices in subspaces (Rowan 1990,
/// NLopt's LN_SBPLX): for places that a robot meets or misses by millimetres. Never worse than `start`, which is put
/// within the bounds. `step`: first steps, at a share `least_step` of which the search ends; `most_values`: how often
/// `value` may be asked.
Eigen::VectorXd subplex(const std::function<double(const Eigen::VectorXd&)>& value, const Eigen::VectorXd& start,
                        const Eigen::VectorXd& step, const Eigen::VectorXd& min, const Eigen::VectorXd& max,
                        double least_step, int most_values);

}  // namespace umbsim::gap

#include "gap/pattern_search.h"

#include <algorithm>

namespace umbsim::gap {

Eigen::VectorXd pattern_search(const std::function<double(const Eigen::VectorXd&)>& value, Eigen::VectorXd start,
                               Eigen::VectorXd step, const Eigen::VectorXd& min, const Eigen::VectorXd& max,
                               int halvings, int most_values) {
  double best = value(start);
  int values = 1;
  const auto better = [&](Eigen::Index i, double by) {
    Eigen::VectorXd trial = start;
    trial[i] = std::clamp(trial[i] + by, min[i], max[i]);
    if (trial[i] == start[i] || values >= most_values) return false;
    ++values;
    const double there = value(trial);
    if (there <= best) return false;
    best = there;
    start = trial;
    return true;
  };
  for (int halved = 0; halved <= halvings && values < most_values;) {
    bool moved = false;
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      if (better(i, step[i])) {
        moved = true;
      } else if (better(i, -step[i])) {
        moved = true;
        step[i] = -step[i];  // go on that way
      }
    }
    if (moved) continue;
    step /= 2;
    ++halved;
  }
  return start;
}

}  // namespace umbsim::gap

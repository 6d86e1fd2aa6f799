#include "gap/search/pattern_search.h"

#include <algorithm>

namespace umbsim::gap {

Eigen::VectorXd pattern_search(const std::function<double(const Eigen::VectorXd&)>& value, Eigen::VectorXd start,
                               Eigen::VectorXd step, const Eigen::VectorXd& min, const Eigen::VectorXd& max,
                               int halvings, int most_values) {
  double best = value(start);
  int values = 1;
  const auto higher = [&](const Eigen::VectorXd& by) {
    const Eigen::VectorXd trial = (start + by).cwiseMax(min).cwiseMin(max);
    if (trial == start || values >= most_values) return false;
    ++values;
    const double there = value(trial);
    if (there <= best) return false;
    best = there;
    start = trial;
    return true;
  };
  const auto better = [&](Eigen::Index i, double by) { return higher(by * Eigen::VectorXd::Unit(start.size(), i)); };
  // Along a ridge no single number does better.
  const auto better_by_two = [&] {
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      for (Eigen::Index j = i + 1; j < start.size(); ++j) {
        for (const double sign_i : {1.0, -1.0}) {
          for (const double sign_j : {1.0, -1.0}) {
            Eigen::VectorXd by = Eigen::VectorXd::Zero(start.size());
            by[i] = sign_i * step[i];
            by[j] = sign_j * step[j];
            if (higher(by)) return true;
          }
        }
      }
    }
    return false;
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
    if (moved || better_by_two()) continue;
    step /= 2;
    ++halved;
  }
  return start;
}

}  // namespace umbsim::gap

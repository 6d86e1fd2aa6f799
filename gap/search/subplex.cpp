#include "gap/search/subplex.h"

#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

namespace umbsim::gap {
namespace {

constexpr double kLeastGain = 0.1;  // of log density, below which no step is worth another

using Numbers = std::vector<double>;

Numbers numbers_of(const Eigen::VectorXd& v) { return Numbers(v.data(), v.data() + v.size()); }

struct Best {
  const std::function<double(const Eigen::VectorXd&)>& value;
  Eigen::VectorXd at;
  double there = -1e301;
  int asked = 0;
};

double asked(const Numbers& x, Numbers&, void* data) {
  Best& best = *static_cast<Best*>(data);
  const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size()));
  const double there = best.value(at);
  ++best.asked;
  if (there > best.there) {
    best.at = at;
    best.there = there;
  }
  return there;
}

}  // namespace

Eigen::VectorXd subplex(const std::function<double(const Eigen::VectorXd&)>& value, const Eigen::VectorXd& start,
                        const Eigen::VectorXd& step, const Eigen::VectorXd& min, const Eigen::VectorXd& max,
                        double least_step, int most_values) {
  Best best{value, start.cwiseMax(min).cwiseMin(max)};
  // A simplex that has shrunk too early begins anew where it ended (Kelley 1999), as long as that leads up.
  for (double before = -1e302; best.there > before + kLeastGain && best.asked < most_values;) {
    before = best.there;
    nlopt::opt search(nlopt::LN_SBPLX, unsigned(start.size()));
    search.set_max_objective(asked, &best);
    search.set_lower_bounds(numbers_of(min));
    search.set_upper_bounds(numbers_of(max));
    search.set_initial_step(numbers_of(step));
    search.set_xtol_abs(numbers_of(least_step * step));
    search.set_ftol_abs(kLeastGain);
    search.set_maxeval(most_values - best.asked);
    Numbers x = numbers_of(best.at);
    double highest = 0;
    try {
      search.optimize(x, highest);
    } catch (const nlopt::roundoff_limited&) {
      // It is as near as numbers go.
    }
  }
  return best.at;
}

}  // namespace umbsim::gap

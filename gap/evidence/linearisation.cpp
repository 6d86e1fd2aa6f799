// Derivatives that a descent takes along.
#include "gap/evidence/model.h"

namespace umbsim::gap {
namespace {

constexpr double kBendShare = 0.01;  // of a step, squared, by which it may end elsewhere than its derivatives foretold,
constexpr double kBend = 1;          // or as much in squared standard deviations of the tracks

}  // namespace

// A step that ended elsewhere than foretold says how the derivatives along it really were (Broyden 1965). `scale`: of
// the numbers.
void Linearisation::learn(const Eigen::VectorXd& to, const std::vector<Eigen::VectorXd>& there,
                          const Eigen::VectorXd& scale) {
  const Eigen::VectorXd step = to - p;
  const Eigen::VectorXd direction = step.cwiseQuotient(scale.cwiseAbs2());
  const double length2 = step.dot(direction);
  for (std::size_t r = 0; r < columns.size(); ++r) {
    const Eigen::VectorXd missed = residual[r] - there[r] - columns[r] * step;
    columns[r] += missed * (direction / length2).transpose();
  }
  p = to;
  residual = there;
}

bool Linearisation::foretold(const Eigen::VectorXd& to, const std::vector<Eigen::VectorXd>& there) const {
  double moved = 0;
  double missed = 0;
  for (std::size_t r = 0; r < columns.size(); ++r) {
    const Eigen::VectorXd by = columns[r] * (to - p);
    moved += by.squaredNorm();
    missed += (residual[r] - by - there[r]).squaredNorm();
  }
  return missed <= kBend + kBendShare * moved;
}

}  // namespace umbsim::gap

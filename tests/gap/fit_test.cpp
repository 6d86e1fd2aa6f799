// Fits of effects in the simulator, where it cannot be driven everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>

#include "core/error.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

// A real robot that stands with one payload may tip over with a little less and with a little more: here its wheelbase
// is known to stand, and to tip over a step of the derivatives beside it, both ways.
TEST(Fit, EndsWhereTheRobotTipsOverOnEitherSide) {
  const Subject s(campaign({effect("wheelbase", {{"relative", 0.01}})}, 71));
  const Fit open = testing::fit_of(s.model, {"wheelbase"});
  const double step = open.hypotheses.front().parameters.front().step;
  const auto narrow = std::make_shared<bool>(false);
  const auto tipped = std::make_shared<int>(0);
  Simulator simulator = testing::simulator(s.replay);
  simulator.ticks = [ticks = simulator.ticks, at = open.p[0], step, narrow, tipped](
                        std::size_t run, const std::vector<Effect>& effects, double roughness) {
    if (*narrow && std::abs(effects.front().values.numbers.front() - at) > 0.6 * step) {
      ++*tipped;
      throw RunError("the robot tips over");
    }
    return ticks(run, effects, roughness);
  };
  const Model model(s.campaign, simulator, Scatter{});
  Linearisation steeper{open.p, model.residuals(open.predicted), open.columns};
  for (Eigen::MatrixXd& c : steeper.columns) c *= 1.5;
  *narrow = true;
  const Fit fit = model.fit(open.hypotheses, Eigen::VectorXd::Constant(1, open.p[0] + 0.5 * step), {}, {}, steeper);
  const double sd = std::sqrt(open.covariance(0, 0));
  std::cout << "at " << fit.p[0] << ", " << open.p[0] << " where it stands everywhere, sd " << sd << ", tipped over "
            << *tipped << " times\n";
  EXPECT_GT(*tipped, 0) << "the test asks for nothing";
  EXPECT_NEAR(fit.p[0], open.p[0], sd);
}

}  // namespace
}  // namespace umbsim::gap

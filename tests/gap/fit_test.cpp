// Fits of effects in the simulator, where it cannot be driven everywhere.
#include <gtest/gtest.h>

#include <algorithm>
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

// Wheels that point straight ahead scrub on no tyre: what soft tyres explain is not theirs.
TEST(Fit, CreditsAnEffectWithItsOwnNumbersAlone) {
  const Effect soft = effect("tyre_creep", {{"along", 0.03}, {"across", 0.03}});
  const Effect toe = effect("wheel_misalignment", {{"left_toe_rad", 0.006}});
  const auto own_evidence = [](const std::vector<Effect>& effects, std::uint64_t seed) {
    const Subject s(campaign(effects, seed));
    const std::vector<Hypothesis> all = plain_hypotheses(0.02, 2000);
    const auto left = std::find_if(all.begin(), all.end(), [](const Hypothesis& h) {
      return h.effect == "wheel_misalignment" && h.variant == "left, soft tyres";
    });
    const Fit fit = s.model.fit({*left}, Eigen::Vector3d(0.004, std::log(0.3), std::log(3)));
    std::cout << "toe " << 1e3 * fit.p[0] << " mrad: " << fit.own_evidence() << " of "
              << fit.log_evidence - s.model.none().log_evidence << "\n";
    return fit.own_evidence();
  };
  EXPECT_LT(own_evidence({soft}, 72), Thresholds{}.detect);
  EXPECT_GT(own_evidence({soft, toe}, 73), Thresholds{}.detect);
}

}  // namespace
}  // namespace umbsim::gap

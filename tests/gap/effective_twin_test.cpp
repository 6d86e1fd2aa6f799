// Radii and wheelbase that stand in the twin for what its causes leave.
#include "gap/answer/effective_twin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gap/answer/closure.h"
#include "gap/answer/twin.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

class EffectiveTwins : public ::testing::Test {
 protected:
  std::optional<EffectiveTwin> beside(const std::vector<std::string>& causes,
                                      const std::set<std::string>& excluded = {}) const {
    const Screen screen(subject_.model, excluded);
    const Fit none = subject_.model.none();
    if (!causes.empty()) {
      const Fit twin = testing::fit_of(subject_.model, causes);
      return effective_twin(subject_.model, screen, excluded, none, twin, held_out_closure(subject_.model, twin));
    }
    Closure nothing = held_out_closure(subject_.model, testing::fit_of(subject_.model, {"wheel_radius_difference"}));
    add_nothing(nothing);
    return effective_twin(subject_.model, screen, excluded, none, none, nothing);
  }

  // A wheelbase that is 1 % longer than believed.
  const Subject subject_{campaign({effect("wheelbase", {{"relative", 0.01}})}, 31)};
};

TEST_F(EffectiveTwins, ForetellWhatNothingNamedDoes) {
  const auto twin = beside({});
  ASSERT_TRUE(twin);
  EXPECT_EQ(twin->dimensions, std::vector<std::string>{"wheelbase"});
  const Effect wheelbase = twin->fit.effects().front();
  EXPECT_NEAR(wheelbase.values.numbers.front(), 0.01, 0.0005);
  EXPECT_GT(twin->closure.fraction, 0.97);
  std::cout << "wheelbase " << 100 * wheelbase.values.numbers.front() << " %, closure " << twin->closure.fraction
            << "\n";
}

TEST_F(EffectiveTwins, AreNotNeededBesideTheTrueCause) { EXPECT_FALSE(beside({"wheelbase"})); }

TEST_F(EffectiveTwins, AreNoneThatTheReaderExcludes) { EXPECT_FALSE(beside({}, {"wheelbase"})); }

// Compliance takes nothing off what a wheelbase does: the wheelbase is fitted beside it, and foretells the runs.
TEST_F(EffectiveTwins, StandBesideACauseThatTakesLittle) {
  const auto twin = beside({"tyre_compliance"});
  ASSERT_TRUE(twin);
  EXPECT_EQ(twin->dimensions, std::vector<std::string>{"wheelbase"});
  EXPECT_GT(twin->closure.fraction, 0.97);
  std::cout << twin->fit.name() << ", closure " << twin->closure.fraction << "\n";
}

// A robot whose casters drag on tyres that creep, on squares and circles: turns on the spot and arcs are small by other
// shares, which no wheelbase foretells.
class ScrubbingTwins : public ::testing::Test {
 protected:
  static Recording driven(const std::string& shape, double heading_sd_rad) {
    Scenario s = testing::squares(2, 2);
    testing::add_noise(s, 7);
    s.truth.heading_sd_rad = heading_sd_rad;
    s.course.shape = shape;
    s.effects = {effect("wheelbase", {{"relative", 0.01}}), effect("caster_drag", {{"coefficient", 0.3}}),
                 effect("tyre_creep", {{"along", 0.05}})};
    return run_experiment(s, 0).recording;
  }

  static std::optional<EffectiveTwin> twin_of(double heading_sd_rad, const std::set<std::string>& excluded = {}) {
    const std::vector<Recording> parts{driven("square", heading_sd_rad), driven("circle", heading_sd_rad)};
    const Campaign both = joined(parts, {"squares", "circles"});
    const Replay squares(scenario_of(parts[0], "."), parts[0]), circles(scenario_of(parts[1], "."), parts[1]);
    const Model model(both, joined(both, {testing::simulator(squares), testing::simulator(circles)}), Scatter{});
    const Fit twin = testing::fit_of(model, {"wheelbase", "wheel_radius_scale"});
    const Closure closure = held_out_closure(model, twin);
    const auto found = effective_twin(model, Screen(model, excluded), excluded, model.none(), twin, closure);
    if (found) {
      std::cout << "left " << closure.after_mm << " mm, with scrub " << found->closure.after_mm << " mm, drag "
                << found->fit.p.tail(1) << "\n";
    }
    return found;
  }
};

TEST_F(ScrubbingTwins, ForetellSquaresFromCirclesAndCirclesFromSquares) {
  const auto twin = twin_of(0.002);
  ASSERT_TRUE(twin);
  ASSERT_EQ(twin->dimensions, std::vector<std::string>{"caster_drag"});
  const std::vector<Effect> effects = twin->fit.effects();
  const auto creep =
      std::find_if(effects.begin(), effects.end(), [](const Effect& e) { return e.info->name == "tyre_creep"; });
  EXPECT_NE(creep, effects.end());
  EXPECT_NEAR(twin->fit.p.tail(1)[0], 0.3, 0.1);
}

TEST_F(ScrubbingTwins, AreRealRobotsAlone) { EXPECT_FALSE(twin_of(3e-4)); }

TEST_F(ScrubbingTwins, AreNoneThatTheReaderExcludes) { EXPECT_FALSE(twin_of(0.002, {"tyre_creep"})); }

}  // namespace
}  // namespace umbsim::gap

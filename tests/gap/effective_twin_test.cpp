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
      return effective_twin(subject_.model, screen, none, twin, held_out_closure(subject_.model, twin));
    }
    Closure nothing = held_out_closure(subject_.model, testing::fit_of(subject_.model, {"wheel_radius_difference"}));
    add_nothing(nothing);
    return effective_twin(subject_.model, screen, none, none, nothing);
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

}  // namespace
}  // namespace umbsim::gap

// 95 % intervals of numbers: what they hold of a recording that this simulator made, and of any other.
#include "gap/output/parameter_estimates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "gap/hypotheses/hypothesis.h"
#include "gap/traits/number_errors.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::hypothesis_of;

/// Without any noise, so that an interval is all that else may be off.
ParameterEstimate estimate(const Hypothesis& hypothesis, const std::vector<double>& numbers,
                           const std::string& parameter, bool elsewhere) {
  Fit fit;
  fit.hypotheses = {hypothesis};
  fit.p = Eigen::Map<const Eigen::VectorXd>(numbers.data(), Eigen::Index(numbers.size()));
  fit.covariance.setZero(fit.p.size(), fit.p.size());
  Diagnosis d;
  d.elsewhere = elsewhere;
  for (const ParameterEstimate& e : parameter_estimates(fit, d)) {
    if (e.parameter == parameter) return e;
  }
  ADD_FAILURE() << hypothesis.effect << " has no " << parameter;
  return {};
}

constexpr double kHere = 0.03;  // standard deviation of a size by what a replay is off by

// The logarithm of a size is normal: as far from its estimate downwards as upwards, in factors.
TEST(Intervals, HoldWhatEnginesDifferBy) {
  const Hypothesis play = hypothesis_of("backlash", "both");
  const ParameterEstimate here = estimate(play, {0.007, 0.007}, "left_rad", false);
  const ParameterEstimate there = estimate(play, {0.007, 0.007}, "left_rad", true);
  const double log_sd = std::hypot(kHere, number_error_of("backlash").log);
  std::cout << here.ci95[0] << " to " << here.ci95[1] << ", elsewhere " << there.ci95[0] << " to " << there.ci95[1]
            << "\n";
  EXPECT_NEAR(here.ci95[0], here.value * std::exp(-1.96 * kHere), 1e-12);
  EXPECT_NEAR(here.ci95[1], here.value * std::exp(1.96 * kHere), 1e-12);
  EXPECT_NEAR(there.ci95[0], there.value * std::exp(-1.96 * log_sd), 1e-12);
  EXPECT_NEAR(there.ci95[1], there.value * std::exp(1.96 * log_sd), 1e-12);
  EXPECT_GT(there.ci95[1] - there.ci95[0], 4 * (here.ci95[1] - here.ci95[0]));
}

// On either side of its neutral value: what is larger is further from there.
TEST(Intervals, OfANegativeNumberAreItsMirrorImage) {
  const Hypothesis toe = hypothesis_of("wheel_misalignment", "left");
  const ParameterEstimate left = estimate(toe, {0.01}, "left_toe_rad", true);
  const ParameterEstimate right = estimate(toe, {-0.01}, "left_toe_rad", true);
  EXPECT_NEAR(left.ci95[0], -right.ci95[1], 1e-15);
  EXPECT_NEAR(left.ci95[1], -right.ci95[0], 1e-15);
}

// What follows from rolling alone is the same in every engine.
TEST(Intervals, OfRollingAreTheSameElsewhere) {
  for (const char* effect : {"wheelbase", "carpet_drift", "wear"}) EXPECT_EQ(number_error_of(effect).log, 0) << effect;
  const Hypothesis wheelbase = hypothesis_of("wheelbase", "relative");
  const ParameterEstimate here = estimate(wheelbase, {0.005}, "relative", false);
  const ParameterEstimate there = estimate(wheelbase, {0.005}, "relative", true);
  EXPECT_EQ(here.ci95[0], there.ci95[0]);
  EXPECT_EQ(here.ci95[1], there.ci95[1]);
}

// What servos and readings lag by adds to a delay, however long it is.
TEST(Intervals, OfADelayHoldATime) {
  const double time_s = number_error_of("encoder_latency").time_s;
  EXPECT_GT(time_s, 0.002);
  for (const double delay_s : {0.02, 0.2}) {
    const ParameterEstimate e = estimate(hypothesis_of("encoder_latency", "delay"), {delay_s}, "seconds", true);
    const double share_s = delay_s * std::expm1(1.96 * kHere);
    EXPECT_NEAR(e.ci95[1] - e.value, std::hypot(share_s, 1.96 * time_s), 1e-12);
  }
}

TEST(Intervals, OfAPlaceAreAsWideAsEnginesDiffer) {
  const Hypothesis cable = bump_hypothesis(2, -0.17, 0);
  const std::vector<double> numbers(cable.parameters.size(), 0.006);
  const ParameterEstimate here = estimate(cable, numbers, "x_m", false);
  const ParameterEstimate there = estimate(cable, numbers, "x_m", true);
  EXPECT_NEAR(here.ci95[1] - here.value, 1.96 * 0.005, 1e-12);
  EXPECT_NEAR(there.ci95[1] - there.value, 1.96 * kPlaceElsewhere_m, 1e-12);
}

}  // namespace
}  // namespace umbsim::gap

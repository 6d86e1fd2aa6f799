// Chapter 5 of docs/fidelity.md on a coarse grid.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/fidelity/contact/cable.h"

namespace umbsim::fidelity {
namespace {

bool climbs(const CableCase& c) {
  return c.friction >= closed_form(c.robot.wheels[0].radius_m, c.height_m).least_friction;
}

std::string text(const CableCase& c) {
  return c.name + ", cable " + std::to_string(c.height_m) + " m, friction " + std::to_string(c.friction);
}

// The bar of the project; half of it is the sink of a hundredth of the height.
TEST(CableFidelity, RigidLimitIsTheClosedFormWhereItApplies) {
  constexpr double kBar = 0.03;
  for (const CableCase& c : cable_grid(Grid::coarse)) {
    const CableOutcome out = cross(in_rigid_limit(c));
    EXPECT_EQ(out.crossed, climbs(c)) << text(c);
    EXPECT_EQ(out.solver_fallbacks, 0) << text(c);
    if (climbs(c)) {
      EXPECT_NEAR(out.ratio, 1, kBar) << text(c);
    }
  }
}

// The default supports take their sink off the cable's height: 1.5 s / h.
TEST(CableFidelity, DefaultSoftnessTakesItsSinkOffTheHeight) {
  constexpr double kBlow = 0.012;  // slip and blow of the climb at 0.05 m/s, and steps of 1 ms
  for (CableCase c : cable_grid(Grid::coarse)) {
    if (!climbs(c)) continue;
    c.speed_mps = 0.05;
    const double expected = 1 - 1.5 * c.options.softness.static_sink_m / c.height_m;
    EXPECT_NEAR(cross(c).ratio, expected, kBlow) << text(c);
  }
}

TEST(CableFidelity, EitherWheelTheSame) {
  constexpr double kMirror = 1e-9;
  for (CableCase c : cable_grid(Grid::coarse)) {
    if (!climbs(c)) continue;
    const double left = cross(c).ratio;
    c.wheel = 1;
    EXPECT_NEAR(cross(c).ratio, left, kMirror) << text(c);
  }
}

}  // namespace
}  // namespace umbsim::fidelity

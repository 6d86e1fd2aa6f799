// Which worlds count as driven: every run to its end, near where its course ends.
#include "bench/worlds/run/world_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/worlds/run/compare.h"
#include "bench/worlds/run/fault.h"

namespace umbsim::worlds {
namespace {

TEST(WorldRun, ARobotDrivesWhereEveryRunEndsNearTheEndOfItsCourse) {
  World w = plain_world("ours");
  const DrivenWorld driven = drive_world(w, {});
  EXPECT_TRUE(drives(w, driven));
  const double around_m = 4 * w.runs.recording.path.side_m;
  for (const double share : {-0.3, -0.2, 0.2, 0.3}) {  // a quarter of the way is allowed
    DrivenWorld off = driven;
    off.runs.back().truth.back().X_WB.x_m += share * around_m;
    EXPECT_EQ(drives(w, off), std::abs(share) < 0.25) << share;
  }
  for (const double turned_rad : {-0.8, -0.6, 0.6, 0.8}) {  // 0.7 rad are
    DrivenWorld off = driven;
    off.runs.front().truth.back().X_WB.theta_rad += turned_rad;
    EXPECT_EQ(drives(w, off), std::abs(turned_rad) < 0.7) << turned_rad;
  }
  DrivenWorld stopped = driven;
  stopped.arrived[1] = false;
  EXPECT_FALSE(drives(w, stopped));
}

// A reading is the newest that is old enough: 20 and 40 ms late are both one period of 40 ms late, and the answer says
// so.
TEST(DrawnFault, CountsAreLateByWholePeriods) {
  World w = plain_world("ours");
  w.driver.rate_hz = 25;
  RandomStream random(1, "fault");
  const DrawnFault late = draw_fault("encoder_latency", w, random);
  const auto seconds = [&](double drawn_s) {
    const Effect effect = late.at(drawn_s).effects.front();
    return effect.values.numbers[0];
  };
  EXPECT_NEAR(seconds(0.02), 0.04, 1e-12);
  EXPECT_NEAR(seconds(0.04), 0.04, 1e-12);
  EXPECT_NEAR(seconds(0.06), 0.08, 1e-12);
}

}  // namespace
}  // namespace umbsim::worlds

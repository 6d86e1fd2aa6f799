// Ten cables under the inner wheel on the first leg, as the extended test lays them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "experiment/run.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::shipped;

// Closed form for R 75, b 340, 10 mm: 0.573 degrees each. The bar of the project's table of figures is 0.3 degrees.
constexpr double kTenCables_deg = 5.7;
constexpr double kBar_deg = 0.3;

const std::vector<std::string> kQuiet{"noise={}", "runs.per_direction=1", "calibration.method=none",
                                      "truth.kind=endpoints"};

TEST(TenCables, TurnEachRunByTenTimesTheClosedForm) {
  const ExperimentResult r = run_experiment(shipped("extended_umbmark", kQuiet), 0);
  ASSERT_TRUE(r.extended && r.umbmark);
  const double cw_deg = degrees(r.extended->cw.heading_rad - r.umbmark->cw.heading_rad);
  const double ccw_deg = degrees(r.extended->ccw.heading_rad - r.umbmark->ccw.heading_rad);
  std::cout << fmt::format(
      "ten cables: cw {:.3f} deg, ccw {:.3f} deg, extended figure {:.3f} deg, {:.4f} per cable; "
      "solver fallbacks {} in {} steps\n",
      cw_deg, ccw_deg, degrees(r.extended->mean_abs_heading_error_rad), degrees(r.extended->per_bump_heading_error_rad),
      r.cost.solver_fallbacks, r.cost.steps);
  EXPECT_NEAR(cw_deg, -kTenCables_deg, kBar_deg) << "towards the right wheel, which is inside";
  EXPECT_NEAR(ccw_deg, kTenCables_deg, kBar_deg);
  EXPECT_NEAR(degrees(r.extended->mean_abs_heading_error_rad), 11.5, 2 * kBar_deg);
}

// The lecture's figure: where the cables lie changes the return position, but not the return heading.
TEST(TenCables, PositionDependsOnTheLegHeadingDoesNot) {
  std::vector<std::string> first = kQuiet, last = kQuiet;
  last.push_back("bumps.leg=4");
  const ExperimentResult a = run_experiment(shipped("extended_umbmark", first), 0);
  const ExperimentResult b = run_experiment(shipped("extended_umbmark", last), 0);
  const Cluster &at_first = a.extended->cw, &at_last = b.extended->cw;
  const double moved_m =
      std::hypot(at_first.centroid_x_m - at_last.centroid_x_m, at_first.centroid_y_m - at_last.centroid_y_m);
  const double turned_deg = degrees(std::abs(at_first.heading_rad - at_last.heading_rad));
  std::cout << fmt::format("cables on leg 4 instead of 1: end point {:.1f} mm away, heading {:.3f} deg\n",
                           1000 * moved_m, turned_deg);
  // 0.1 rad lost on the first leg displaces the end point of three further legs by about 0.1 times metres.
  EXPECT_GT(moved_m, 0.1);
  EXPECT_LT(turned_deg, kBar_deg);
}

TEST(TenCables, OuterWheelTurnsTheOtherWay) {
  std::vector<std::string> outer = kQuiet;
  for (const char* setting : {"bumps.wheel=outer", "bumps.count=1", "runs.directions=[cw]", "course.side_m=1"}) {
    outer.push_back(setting);
  }
  const ExperimentResult r = run_experiment(shipped("extended_umbmark", outer), 0);
  const OdometryParameters& o = r.odometry;
  const double turned_deg = degrees(return_errors(r.recording, o, "cw", true).at(0).theta_rad -
                                    return_errors(r.recording, o, "cw", false).at(0).theta_rad);
  std::cout << fmt::format("one cable, outer wheel, cw: {:+.4f} deg\n", turned_deg);
  EXPECT_NEAR(turned_deg, 0.573, 0.04 * 0.573);  // the bar for one cable is 4 %
}

// Legs of 3 m: on shorter ones a robot that a cable turned far comes back along the last cable.
std::vector<std::string> three_cables(const std::string& friction, const std::string& speed_mps) {
  std::vector<std::string> settings = kQuiet;
  for (const std::string& setting :
       {std::string("bumps={count: 3}"), std::string("course.side_m=3"), "floor.friction=" + friction,
        "course.linear_speed_mps=" + speed_mps}) {
    settings.push_back(setting);
  }
  return settings;
}

// tan psi is 0.554 for a 10 mm cable and R 75. Three cables, two directions.
TEST(TenCables, SaysWhereTheWheelCannotClimb) {
  constexpr int kLaid = 6;
  const double closed_form_deg = 0.573;
  struct Case {
    const char *friction, *speed_mps;
    bool grip, over;
  };
  for (const Case& c :
       {Case{"0.9", "0.2", true, true}, Case{"0.56", "0.05", true, true}, Case{"0.54", "0.2", false, true},
        Case{"0.3", "0.2", false, true}, Case{"0.3", "0.05", false, false}}) {
    const ExperimentResult r = run_experiment(shipped("extended_umbmark", three_cables(c.friction, c.speed_mps)), 0);
    const double each_deg = degrees(r.extended->per_bump_heading_error_rad);
    std::cout << fmt::format("friction {}, {} m/s: {} not crossed, {} without grip, {:.3f} deg per cable\n", c.friction,
                             c.speed_mps, r.cables.not_crossed, r.cables.without_grip, each_deg);
    EXPECT_EQ(r.cables.without_grip, c.grip ? 0 : kLaid) << c.friction;
    EXPECT_EQ(r.cables.not_crossed == 0, c.over) << c.friction << ", " << c.speed_mps;
    if (c.grip) {
      EXPECT_NEAR(each_deg, closed_form_deg, 0.04 * closed_form_deg) << c.friction;
    } else {
      EXPECT_GT(each_deg, 1.04 * closed_form_deg) << "momentum and the other wheel push it over, slipping";
    }
  }
}

}  // namespace
}  // namespace umbsim

// What a tracker does to the diagnosis: mounted by hand, and noisy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "core/random.h"
#include "gap/evidence/uneven_floor.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

/// The recording as a tracker sees it whose point is off the axle's middle and whose heading is off the drive axis.
Recording mounted(Recording recording, const Pose2& X_BM) {
  for (RecordedRun& run : recording.runs) {
    for (TruthSample& s : run.truth) s.X_WB = s.X_WB * X_BM;
  }
  return recording;
}

const Pose2 kByHand{0.002, -0.003, 0.005};
const Pose2 kTurned{0.0003, 0.0002, -0.006};

std::string first_of(const Diagnosis& d) {
  std::cout << fmt::format("{} ({:.0f} %)\n", d.causes.front().name, 100 * d.causes.front().probability);
  return d.causes.front().name;
}

// A robot whose wheels are toed alike drives askew, as one whose tracker is turned. The point that is off the axle
// tells them apart, and where the runs start.
TEST(MountedTracker, IsNoToe) {
  for (const Pose2& X_BM : {kByHand, kTurned}) {
    const Diagnosis d = Subject(mounted(campaign({}, 51), X_BM)).diagnosed();
    EXPECT_EQ(first_of(d), "none");
    EXPECT_LT(d.before_mm, 1.5 * d.noise_floor_mm) << "how it is mounted is no gap";
  }
  const std::vector<Effect> unequal{effect("wheel_radius_difference", {{"relative", 0.002}})};
  EXPECT_EQ(first_of(Subject(mounted(campaign(unequal, 52), kByHand)).diagnosed()), "wheel_radius_difference");
}

// Track errors of the first run's first reading that are its tracker's: along, across, heading.
Eigen::Vector3d mount_of(const Recording& recording) { return Subject(recording).model.mount_error(0).head(3); }

// Its point goes round in turns in place, and little else moves that.
TEST(MountedTracker, IsFoundWhateverTheRobotDoes) {
  const std::vector<Effect> wide{effect("wheelbase", {{"relative", 0.01}}),
                                 effect("carpet_drift", {{"metres_per_metre", 0.01}})};
  const std::vector<Effect> toed{effect("wheel_misalignment", {{"right_toe_rad", 0.006}})};
  for (const std::vector<Effect>& effects : {std::vector<Effect>{}, toed, wide}) {
    const Recording recording = campaign(effects, 55);
    EXPECT_EQ(mount_of(recording).norm(), 0) << "exact";
    EXPECT_EQ(Subject(recording).model.nuisance_sds().size(), 10u)
        << "another engine's, by much or by little, with four kinds of servos, or this one's with two";
    for (const Pose2& X_BM : {kByHand, kTurned}) {
      const Eigen::Vector3d found = mount_of(mounted(recording, X_BM));
      std::cout << fmt::format("{:.2f} {:.2f} mm, {:.2f} mrad\n", 1e3 * found[0], 1e3 * found[1], 1e3 * found[2]);
      EXPECT_NEAR(found[0], X_BM.x_m, 5e-4);
      EXPECT_NEAR(found[1], X_BM.y_m, 5e-4);
      const double askew = !effects.empty() && effects.front().info->name == "wheel_misalignment"
                               ? 0.003
                               : 0;  // toe of one wheel looks like a tracker turned by half of it
      EXPECT_NEAR(found[2], X_BM.theta_rad, askew + 5e-4);
    }
  }
}

// A track that was moved so that it starts at the origin does not say by its start that it is a simulator's.
TEST(MountedTracker, StartsThatWereMadeSayNothing) {
  Recording moved = mounted(campaign({}, 55), kByHand);
  for (RecordedRun& run : moved.runs) {
    const Pose2 back = Pose2{0, 0, run.start_heading_rad.value_or(0)} * inverse(run.truth.front().X_WB);
    for (TruthSample& s : run.truth) s.X_WB = back * s.X_WB;
    run.truth.front().X_WB.theta_rad = run.start_heading_rad.value_or(0);
  }
  EXPECT_GT(mount_of(moved).norm(), 0.003);
}

TEST(MountedTracker, ToeIsFoundByAnExactOne) {
  const std::vector<Effect> toed{effect("wheel_misalignment", {{"right_toe_rad", 0.006}})};
  EXPECT_EQ(first_of(Subject(campaign(toed, 53)).diagnosed()), "wheel_misalignment");
}

// Passes are matched by the smooth course: matched by what a camera saw, those would meet that its noise moved alike.
TEST(NoisyTracker, MakesNoUnevenFloor) {
  constexpr double kCamera_m = 0.01;
  Recording all = testing::turned_campaign({}, 54);
  RandomStream random(7, "camera");
  for (RecordedRun& run : all.runs) {
    for (TruthSample& s : run.truth) {
      s.X_WB.x_m += random.normal(0, kCamera_m);
      s.X_WB.y_m += random.normal(0, kCamera_m);
    }
  }
  all.truth_position_sd_m = kCamera_m;
  const Subject p(all);
  const auto found = find_uneven_floor(p.model, p.model.none());
  EXPECT_FALSE(found) << fmt::format("{:.1f} standard errors", found->sigmas);
}

// A total station's heading is what the robot's own counts add up to: it repeats well, and says nothing.
TEST(TotalStation, HeadingThatNobodySaw) {
  Recording all = campaign({effect("wheel_radius_difference", {{"relative", 0.004}})}, 58);
  const RecordedRobot& robot = all.robot;
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution / robot.wheelbase_m;
  RandomStream random(9, "total station");
  for (RecordedRun& run : all.runs) {
    std::size_t e = 0;
    const double first = run.truth.front().X_WB.theta_rad;
    for (TruthSample& s : run.truth) {
      while (e + 1 < run.encoders.size() && run.encoders[e].time_s < s.time_s) ++e;
      const double theta = first + k * double(run.encoders[e].right_ticks - run.encoders[e].left_ticks);
      s.X_WB = {random.normal(s.X_WB.x_m, 0.002), random.normal(s.X_WB.y_m, 0.002), theta};
    }
  }
  all.truth_position_sd_m = 0.002;
  all.truth_heading_sd_rad = M_PI;
  const Subject p(all);
  EXPECT_NEAR(p.model.noise().heading_sd_rad, M_PI, 1e-3);
  EXPECT_EQ(first_of(p.diagnosed()), "wheel_radius_difference");
}

}  // namespace
}  // namespace umbsim::gap

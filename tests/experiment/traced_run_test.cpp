// What happens at a place or at a moment, driven from shortly before it until it is over, against the whole run.
#include "experiment/replay/traced_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <memory>

#include "core/error.h"
#include "effects/contact.h"
#include "effects/geometry.h"
#include "experiment/drive/rolling_noise.h"
#include "experiment/replay/even_stretches.h"
#include "experiment/replay/recorded_shafts.h"
#include "sim/world.h"

namespace umbsim {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kLeg_s = 10;
constexpr double kTurn_s = 3;

double distance_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

// Four legs of two metres and turns on the spot, with ramps of half a second.
struct Squares {
  Squares() {
    for (int leg = 0; leg < 4; ++leg) {
      add(2.67, 2.67, kLeg_s);
      add(0, 0, 0.5);
      add(-1.2, 1.2, kTurn_s);
      add(0, 0, 0.5);
    }
  }
  void add(double left_radps, double right_radps, double duration_s) {
    for (int i = 0; i < int(std::lround(duration_s / kPeriod_s)); ++i) {
      const double ramp = std::min(1.0, i * kPeriod_s / 0.5);
      const double l = samples.empty() ? 0 : left.back(), r = samples.empty() ? 0 : right.back();
      EncoderSample s;
      s.time_s = double(samples.size()) * kPeriod_s;
      samples.push_back(s);
      left.push_back(l + ramp * (left_radps - l));
      right.push_back(r + ramp * (right_radps - r));
    }
  }
  ShaftDrive drive() const { return {samples, left, right, {}, {}, rolling}; }

  std::vector<EncoderSample> samples;
  std::vector<double> left;
  std::vector<double> right;
  std::vector<std::array<double, 2>> rolling;  // as ShaftDrive
};

class TracedRunTest : public ::testing::Test {
 protected:
  TracedRunTest() {
    rig_.robot = load_robot(UMBSIM_SOURCE_DIR "/robots/labmate.urdf");
    for (Motor& m : rig_.drivetrain.motor) m.torque_limit_nm = 1e6;  // shafts turn as they are told, as in replays
  }

  World world(const std::vector<Push>& pushes = {}) const {
    Floor floor = rig_.floor;
    return World(rig_.robot, rig_.drivetrain, floor, {}, pushes);
  }
  World bare() const {
    Floor floor = rig_.floor;
    floor.cables.clear();
    floor.patches.clear();
    return World(rig_.robot, rig_.drivetrain, floor, {});
  }

  // Largest distance between the run driven near what happens and the whole run; how far that is from a run in which
  // nothing happens; and the share of the time that was driven.
  void compare(const char* what, const std::vector<Push>& pushes, double most_driven) {
    World plain = bare();
    const TracedRun without = traced(plain, squares_.drive());
    World whole_world = world(pushes);
    const TracedRun whole = traced(whole_world, squares_.drive());
    World near_world = world(pushes);
    const std::vector<Pose2> near = driven_near(near_world, rig_, pushes, without);
    ASSERT_EQ(near.size(), whole.track.size());
    double off_m = 0, off_rad = 0, changed_m = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      off_m = std::max(off_m, distance_m(near[i], whole.track[i]));
      off_rad = std::max(off_rad, std::abs(near[i].theta_rad - whole.track[i].theta_rad));
      changed_m = std::max(changed_m, distance_m(without.track[i], whole.track[i]));
    }
    const double driven = near_world.cost().simulated_s / whole_world.cost().simulated_s;
    std::cout << fmt::format(
        "{}: moves the robot by {:.1f} mm; driven near it off by {:.2g} mm, {:.2g} rad; {:.0f} % of the time\n", what,
        1000 * changed_m, 1000 * off_m, off_rad, 100 * driven);
    EXPECT_GT(changed_m, 0.001);
    EXPECT_LT(off_m, 1e-6);
    EXPECT_LT(off_rad, 1e-6);
    EXPECT_LT(driven, most_driven);
  }

  // The same in as few steps as may be: largest distance, in metres, and the share of the steps.
  std::pair<double, double> in_few_steps(const char* what) const {
    ShaftDrive drive = squares_.drive();
    World each = world(), few = world();
    const std::vector<Pose2> whole = traced(each, drive, false).track;
    drive.stretches = std::make_shared<const EvenStretches>(even_stretches(
        drive.samples, {turned_by(drive.samples, drive.left_radps, 1), turned_by(drive.samples, drive.right_radps, 1)},
        {rig_.robot.wheels[0].radius_m, rig_.robot.wheels[1].radius_m}, rig_.robot.wheelbase_m()));
    const std::vector<Pose2> track = rolled(few, drive);
    EXPECT_EQ(track.size(), whole.size());
    double off_m = 0;
    for (std::size_t i = 0; i < std::min(track.size(), whole.size()); ++i)
      off_m = std::max(off_m, distance_m(track[i], whole[i]));
    const double steps = double(few.cost().steps) / double(each.cost().steps);
    std::cout << fmt::format("{}: off by {:.2g} mm in {:.0f} % of the steps\n", what, 1000 * off_m, 100 * steps);
    return {off_m, steps};
  }

  Rig rig_;
  Squares squares_;
};

TEST_F(TracedRunTest, RollsInFewSteps) {
  const auto [off_m, steps] = in_few_steps("rigid");
  EXPECT_LT(off_m, 1e-4);
  EXPECT_LT(steps, 0.25);
}

TEST_F(TracedRunTest, CreepsInFewSteps) {
  apply(TyreCreep{0.02, 0.02, 0, 0}, rig_);
  apply(CasterDrag{0.1, 0.05}, rig_);
  const auto [off_m, steps] = in_few_steps("a dragging caster on tyres that creep");
  EXPECT_LT(off_m, 1e-4);
  EXPECT_LT(steps, 0.25);
}

// Shaken shafts slide on a slippery floor from sample to sample, and not in one step of their mean speed.
TEST_F(TracedRunTest, IsShakenOnASlipperyFloorSampleBySample) {
  rig_.floor.friction = 0.02;
  for (std::size_t i = 0; i < squares_.samples.size(); ++i) {
    squares_.left[i] += i % 2 == 0 ? 0.02 : -0.02;
    squares_.right[i] += i % 2 == 0 ? 0.02 : -0.02;
  }
  const auto [off_m, steps] = in_few_steps("shaken");
  EXPECT_LT(off_m, 1e-4);
  EXPECT_GT(steps, 0.9);
  rig_.floor.friction = 1;
  EXPECT_LT(in_few_steps("shaken on a floor that holds").second, 0.5);
}

// What slides a little slides much where the steps before it leave other speeds.
TEST_F(TracedRunTest, SlidesAsMuchAfterFewSteps) {
  rig_.floor.friction = 0.04;
  World each = world();
  traced(each, squares_.drive(), false);
  ASSERT_GT(each.strain(0).slid_s, 5);
  EXPECT_LT(in_few_steps("braked on a slippery floor").first, 1e-4);
}

TEST_F(TracedRunTest, SlidesSampleBySample) {
  apply(WheelMisalignment{0.02, 0}, rig_);
  const auto [off_m, steps] = in_few_steps("toed");
  EXPECT_LT(off_m, 1e-5);
  EXPECT_GT(steps, 0.5);
}

TEST_F(TracedRunTest, TurnsEccentricWheelsSampleBySample) {
  apply(WheelEccentricity{0.001, 0, 0, 0}, rig_);
  const auto [off_m, steps] = in_few_steps("eccentric");
  EXPECT_EQ(off_m, 0);
  EXPECT_EQ(steps, 1);
}

TEST_F(TracedRunTest, ResumesAsIfItHadGoneOn) {
  const ShaftDrive drive = squares_.drive();
  World a = bare();
  a.place({0.1, 0.2, 0.3});
  for (std::size_t i = 1; i <= 700; ++i) drive.advance(a, i);
  World b = bare();
  b.resume(a.snapshot(), {});
  for (std::size_t i = 701; i < drive.samples.size(); ++i) {
    drive.advance(a, i);
    drive.advance(b, i);
  }
  EXPECT_EQ(a.pose().x_m, b.pose().x_m);
  EXPECT_EQ(a.pose().y_m, b.pose().y_m);
  EXPECT_EQ(a.pose().theta_rad, b.pose().theta_rad);
  EXPECT_EQ(a.encoder_angle(0), b.encoder_angle(0));
}

TEST_F(TracedRunTest, ACableOnALeg) {
  rig_.floor.cables.push_back({1.2, 0.17, M_PI / 2, 0.01, 0.08});
  compare("cable", {}, 0.4);
}

TEST_F(TracedRunTest, ASlipperyPatchInACorner) {
  rig_.floor.patches.push_back({2.1, 0.1, 0.15, 0.02});
  compare("patch", {}, 0.4);
}

TEST_F(TracedRunTest, AHoleAtTheStart) {
  rig_.floor.patches.push_back({0.02, 0.17, 0.04, 0});
  compare("hole", {}, 0.4);
}

TEST_F(TracedRunTest, APush) { compare("push", {{21.3, 0.1, 40, M_PI / 2, 0.2, 0}}, 0.1); }

// Beside a hole in the replay, over it where it was seen: it is felt there, and what it does is carried back.
TEST_F(TracedRunTest, MeetsAHoleWhereItWasSeen) {
  rig_.floor.patches.push_back({2.0, 0.17, 0.04, 0});
  World plain = bare();
  TracedRun without = traced(plain, squares_.drive());
  const auto largest_m = [](const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
    double most_m = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most_m = std::max(most_m, distance_m(a[i], b[i]));
    return most_m;
  };
  World at_its_replay = world();
  const std::vector<Pose2> felt = driven_near(at_its_replay, rig_, {}, without);
  const Pose2 beside{0, 0.3, 0};
  without.seen.assign(without.moments.size(), beside);
  World seen_beside_it = world();
  const std::vector<Pose2> missed = driven_near(seen_beside_it, rig_, {}, without);
  EXPECT_GT(largest_m(felt, without.track), 0.01);
  EXPECT_LT(largest_m(missed, without.track), 1e-9);
  // The hole is where it was seen: as if neither had moved.
  rig_.floor.patches.back().y_m += beside.y_m;
  World seen_over_it = world();
  const std::vector<Pose2> carried = driven_near(seen_over_it, rig_, {}, without);
  std::cout << fmt::format("moved with its hole: off by {:.2g} mm\n", 1000 * largest_m(carried, felt));
  EXPECT_LT(largest_m(carried, felt), 1e-3);
}

TEST_F(TracedRunTest, AHoleUnderARobotWithBacklash) {
  for (Motor& m : rig_.drivetrain.motor) m.backlash_rad = 0.03;
  rig_.floor.patches.push_back({2.0, 0.15, 0.08, 0});
  compare("hole, backlash", {}, 0.6);
}

// Toed wheels scrub: which grains they are on decides how far they come.
TEST_F(TracedRunTest, AHoleInARoughFloorUnderToedWheels) {
  apply(WheelMisalignment{0.004, 0.003}, rig_);
  RollingNoise rolling(1e-4, rig_);
  std::array<double, 2> shaft_rad{};
  for (std::size_t i = 0; i < squares_.samples.size(); ++i) {
    squares_.rolling.push_back(rolling.next(shaft_rad, {squares_.left[i], squares_.right[i]}, kPeriod_s));
    shaft_rad[0] += squares_.left[i] * kPeriod_s;
    shaft_rad[1] += squares_.right[i] * kPeriod_s;
  }
  rig_.floor.patches.push_back({2.0, 0.15, 0.08, 0});
  compare("hole, toe, rough floor", {}, 0.6);
}

TEST_F(TracedRunTest, KnowsFloorsThatDifferFromPlaceToPlace) {
  Floor floor;
  EXPECT_TRUE(same_everywhere(floor));
  floor.patches.push_back({1, 1, 0.1, 0.1});
  EXPECT_TRUE(same_everywhere(floor)) << "but for what lies there";
  floor.drift_y = 0.01;
  EXPECT_FALSE(same_everywhere(floor));
  floor = {};
  floor.ripples = random_ripples(0.001, 1, 1, 0);
  EXPECT_FALSE(same_everywhere(floor));
}

}  // namespace
}  // namespace umbsim

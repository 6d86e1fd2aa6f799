// Uneven floors from passes in different directions, the floor of closure, and what the catalogue lacks.
#include "gap/evidence/uneven_floor.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "gap/diagnose.h"
#include "gap/evidence/track_misfit.h"
#include "gap/replay/command_response.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;
using testing::turned_campaign;

const Effect kUneven = effect("uneven_floor", {{"rms_m", 0.002}, {"wavelength_m", 0.5}, {"seed", 5}});

TEST(UnevenFloor, HeightAndWavelengthFromTheShiftsOfPasses) {
  const Subject p(turned_campaign({kUneven}, 21));
  const auto found = find_uneven_floor(p.model, p.model.none());
  ASSERT_TRUE(found);
  std::cout << fmt::format("{:.1f} standard errors, rms {:.2f} mm of 2, wavelength {:.3f} m of 0.5\n", found->sigmas,
                           1000 * found->rms_m, found->wavelength_m);
  EXPECT_NEAR(found->rms_m, 0.002, 0.35 * 0.002);
  EXPECT_NEAR(found->wavelength_m, 0.5, 0.35 * 0.5);
}

// On waves of twice the length from axle to caster, the robot pitches one way there and the other way back.
TEST(UnevenFloor, WhereTheWayBackPitchesTheOtherWay) {
  int found = 0;
  for (const double seed : {1, 2, 3, 4, 5, 6}) {
    const Effect floor = effect("uneven_floor", {{"rms_m", 0.003}, {"wavelength_m", 0.35}, {"seed", seed}});
    const Subject p(turned_campaign({floor}, 25));
    const auto uneven = find_uneven_floor(p.model, p.model.none());
    std::cout << fmt::format("floor {}: {:.1f} standard errors\n", seed, uneven ? uneven->sigmas : 0.0);
    found += uneven ? 1 : 0;
  }
  EXPECT_EQ(found, 6);
}

TEST(UnevenFloor, NotOnAFlatFloorNorFromPassesInOneDirection) {
  const Subject flat(turned_campaign({effect("wheelbase", {{"relative", 0.01}})}, 22));
  EXPECT_FALSE(find_uneven_floor(flat.model, flat.model.none()));
  const Subject eccentric(turned_campaign({effect("wheel_eccentricity", {{"left_m", 0.001}})}, 23));
  EXPECT_FALSE(find_uneven_floor(eccentric.model, eccentric.model.none()));
  const Subject one_way(campaign({kUneven}, 21));
  EXPECT_FALSE(find_uneven_floor(one_way.model, one_way.model.none()));
}

TEST(UnevenFloor, IsNamedAndStaysOutOfTheTwin) {
  const Subject p(turned_campaign({kUneven}, 21));
  const Diagnosis d = p.diagnosed();
  ASSERT_EQ(d.causes.front().name, "uneven_floor");
  EXPECT_EQ(d.stage, "floor");
  EXPECT_FALSE(d.has_place);
  EXPECT_TRUE(d.causes.front().fit.driven_at(d.causes.front().fit.p).empty());
  EXPECT_TRUE(d.twin.driven_at(d.twin.p).empty());
  // Where it may not be named, above all no other effect is.
  EXPECT_EQ(p.diagnosed({"uneven_floor"}).causes.front().name, "unknown");
}

// What all turns share is no noise, even if no effect of the catalogue is allowed to say so.
TEST(Unknown, AWheelbaseThatTheCatalogueLacks) {
  const Subject p(turned_campaign({effect("wheelbase", {{"relative", -0.004}})}, 24));
  EXPECT_EQ(p.diagnosed().causes.front().name, "wheelbase");
  EXPECT_EQ(p.diagnosed({"wheelbase"}).causes.front().name, "unknown");
}

// Robots with nothing wrong stray by what the noise model foretells, in the mean over several campaigns.
TEST(TrackMisfit, NoiseAloneMakesWhatIsForetold) {
  double measured = 0;
  double foretold = 0;
  constexpr int kCampaigns = 6;
  for (std::uint64_t seed = 0; seed < kCampaigns; ++seed) {
    const Recording recording = campaign({}, 40 + seed);
    const Replay replay(scenario_of(recording, "."), recording);
    NoiseModel noise;
    // var(heading) = 2 k^2 / b^2 per metre of both wheels.
    noise.heading_rad2_pm = 2 * std::pow(1e-4 / recording.robot.wheelbase_m, 2);
    noise.along_m2_pm = 0.5e-8;
    Scatter scatter;
    scatter.radius = 3e-5;
    const Campaign joined = campaign_of(recording);
    const Model model(joined, testing::simulator(replay), scatter, noise);
    measured += mean_square_error_m2(model, model.none().predicted.tracks);
    for (const auto& run : noise_misfits_m2(model, 100)) {
      for (const double square : run) foretold += square / 100 / double(recording.runs.size());
    }
  }
  std::cout << fmt::format("root mean square {:.2f} mm, foretold {:.2f} mm\n", 1000 * std::sqrt(measured / kCampaigns),
                           1000 * std::sqrt(foretold / kCampaigns));
  EXPECT_GT(measured, 0.5 * foretold);
  EXPECT_LT(measured, 2 * foretold);
}

TEST(MotorScatter, GainsDifferFromRunToRun) {
  Scenario s = testing::squares(1, 8);
  s.noise.motor_scatter = 0.002;
  const Recording recording = run_experiment(s, 0).recording;
  s.noise.motor_scatter = 0;
  const Recording exact = run_experiment(s, 0).recording;
  const auto gains = [](const Recording& r, std::size_t run) {
    const CommandResponse f = command_response(r.runs[run], r.robot, counted_rad(r.runs[run], r.robot),
                                               2 * M_PI / r.robot.ticks_per_revolution);
    return Eigen::Vector2d(f.left_gain, f.right_gain);
  };
  double square = 0;
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    square += (gains(recording, r) - gains(exact, r)).squaredNorm();
    EXPECT_LT((gains(exact, r) - gains(exact, r % 2)).norm(), 1e-4) << "runs of a direction are alike";
  }
  const double sd = std::sqrt(square / double(2 * recording.runs.size()));
  std::cout << fmt::format("scatter of 32 gains {:.5f} of 0.002\n", sd);
  EXPECT_NEAR(sd, 0.002, 0.0007);
}

}  // namespace
}  // namespace umbsim::gap

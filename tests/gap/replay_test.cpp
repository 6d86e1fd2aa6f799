// What run_experiment drove is driven again from its ticks: the truth must come out.
#include "experiment/replay/replay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "gap/replay/command_response.h"
#include "recording/coarse_counts.h"
#include "tests/gap/recordings.h"

namespace umbsim {
namespace {

using testing::effect;
using testing::squares;

double distance_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// Distances from the truth, the largest of all runs, of the replay with and without the effects that it was driven
/// under.
struct Distances {
  double way_m = 0;          ///< anywhere, with the effects
  double end_m = 0;          ///< at the end, where the robot stands, with the effects
  double way_without_m = 0;  ///< anywhere, without them
  double end_without_m = 0;  ///< at the end, without them
};

Distances distances(const Scenario& scenario) {
  const Recording recording = run_experiment(scenario, 0).recording;
  Distances d;
  const Replay replay(scenario_of(recording, "."), recording);
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const std::vector<TruthSample>& truth = recording.runs[r].truth;
    const std::vector<Pose2> with = replay.poses(r, scenario.effects);
    for (std::size_t k = 0; k < truth.size(); ++k) d.way_m = std::max(d.way_m, distance_m(with[k], truth[k].X_WB));
    d.end_m = std::max(d.end_m, distance_m(with.back(), truth.back().X_WB));
    const std::vector<Pose2> without = replay.poses(r, {});
    for (std::size_t k = 0; k < truth.size(); ++k) {
      d.way_without_m = std::max(d.way_without_m, distance_m(without[k], truth[k].X_WB));
    }
    d.end_without_m = std::max(d.end_without_m, distance_m(without.back(), truth.back().X_WB));
  }
  return d;
}

/// Half of a control period of 20 ms at 0.3 m/s: the replay asks for speeds at the samples, where the driver's steps
/// hold each for a whole period. Gone wherever the robot stands.
constexpr double kHalfPeriod_m = 0.010 * 0.3;
/// Of an 8 m square, at its end.
constexpr double kEnd_m = 0.1e-3;
/// Of what an effect does: lost counts come back in the mean only; a cable stops a shaft within one period; the leg of
/// a push begins a period earlier for what the counts show.
constexpr double kInTheMean = 0.01, kCable = 0.01, kEvent = 0.1;

struct Case {
  const char* name;
  std::vector<Effect> effects;
  double share = 0;  ///< of the effect's own displacement that may be missed
};

class ReplayOfTicks : public ::testing::TestWithParam<Case> {};

TEST_P(ReplayOfTicks, EndsWhereTheRobotWas) {
  Scenario s = squares(2, 1);
  s.encoders.ticks_per_revolution = 1e6;
  s.effects = GetParam().effects;
  const Distances d = distances(s);
  std::cout << fmt::format("{}: {:.3f} mm on the way, {:.3f} mm at the end; without the effect {:.3f} and {:.3f} mm\n",
                           GetParam().name, 1000 * d.way_m, 1000 * d.end_m, 1000 * d.way_without_m,
                           1000 * d.end_without_m);
  EXPECT_LT(d.end_m, kEnd_m + GetParam().share * d.end_without_m);
  EXPECT_LT(d.way_m, kHalfPeriod_m + 2 * kEnd_m + GetParam().share * d.way_without_m);
  // Where there is an effect, the replay without it must miss: the test can fail.
  if (!s.effects.empty()) {
    EXPECT_GT(d.way_without_m, 2 * d.way_m);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Effects, ReplayOfTicks,
    ::testing::Values(
        Case{"nominal", {}},
        Case{"wheel_radius_difference", {effect("wheel_radius_difference", {{"relative", 0.003}})}},
        Case{"wheelbase", {effect("wheelbase", {{"relative", 0.01}})}},
        Case{"wheel_eccentricity", {effect("wheel_eccentricity", {{"right_m", 1e-3}, {"right_phase_rad", 1}})}},
        Case{"carpet_drift", {effect("carpet_drift", {{"metres_per_metre", 0.004}, {"direction_rad", 0.8}})}},
        Case{"bump", {effect("bump", {{"height_m", 0.006}, {"x_m", 1}, {"y_m", -0.17}})}, kCable},
        Case{"tyre_compliance", {effect("tyre_compliance", {{"metres_per_newton", 2e-6}})}},
        Case{"push",
             {effect("push", {{"leg", 2}, {"seconds_into_leg", 3}, {"impulse_newton_seconds", 30}}, "cw-1")},
             kEvent},
        Case{"encoder_missed_counts", {effect("encoder_missed_counts", {{"right_probability", 0.004}})}, kInTheMean},
        Case{"encoder_latency", {effect("encoder_latency", {{"seconds", 0.1}})}, kInTheMean},
        Case{"encoder_sampling_22ms", {effect("encoder_sampling", {{"interval_s", 0.0222}})}, kInTheMean},
        Case{"encoder_sampling_100ms", {effect("encoder_sampling", {{"interval_s", 0.1}})}, kInTheMean}),
    [](const auto& test) { return std::string(test.param.name); });

/// Mean of the runs' largest distances from the truth.
double mean_distance_m(const Replay& replay, const std::vector<Effect>& effects, double roughness_m_per_sqrt_m) {
  double sum = 0;
  const Recording& recording = replay.recording();
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const std::vector<Pose2> track = replay.poses(r, effects, roughness_m_per_sqrt_m);
    double most = 0;
    for (std::size_t k = 0; k < track.size(); ++k) {
      most = std::max(most, distance_m(track[k], recording.runs[r].truth[k].X_WB));
    }
    sum += most;
  }
  return sum / double(recording.runs.size());
}

// One toed wheel drags the robot sideways as far as the other one gives way: every grain of a rough floor loosens both.
TEST(ReplayOnARoughFloor, LetsToedWheelsScrub) {
  constexpr double kRoughness = 2e-4;
  Scenario s = squares(2, 4);
  s.encoders.ticks_per_revolution = 1e6;
  s.noise.wheel_noise_m_per_sqrt_m = kRoughness;
  const auto distance = [&](double roughness) {
    const Recording recording = run_experiment(s, 0).recording;
    return mean_distance_m(Replay(scenario_of(recording, "."), recording), s.effects, roughness);
  };
  const double noise = distance(0);
  s.effects = {effect("wheel_misalignment", {{"left_toe_rad", 0.015}})};
  const double smooth = distance(0);
  const double rough = distance(kRoughness);
  std::cout << fmt::format(
      "mean of the largest distances: {:.2f} mm of noise, toed {:.2f} mm on a smooth floor, {:.2f} "
      "mm on a rough one\n",
      1000 * noise, 1000 * smooth, 1000 * rough);
  // Beyond the noise, which comes on top in squares.
  EXPECT_GT(smooth * smooth - noise * noise, 2 * (rough * rough - noise * noise));
}

TEST(ReplayOnARoughFloor, MovesNoRobotThatRolls) {
  Scenario s = squares(2, 1);
  const Recording recording = run_experiment(s, 0).recording;
  const Replay replay(scenario_of(recording, "."), recording);
  const std::vector<Pose2> smooth = replay.poses(0, {});
  const std::vector<Pose2> rough = replay.poses(0, {}, 2e-4);
  double most_m = 0;
  for (std::size_t k = 0; k < smooth.size(); ++k) most_m = std::max(most_m, distance_m(smooth[k], rough[k]));
  std::cout << fmt::format("a robot that rolls is moved by {:.4f} mm\n", 1000 * most_m);
  EXPECT_LT(most_m, 1e-4);
  EXPECT_GT(most_m, 0);
}

// A real encoder's staircase must not shake the robot off its path.
TEST(ReplayOfCoarseTicks, LosesLessThanATick) {
  Scenario s = squares(2, 1);
  s.encoders.ticks_per_revolution = 2000;
  const double tick_m = 2 * M_PI * 0.075 / 2000;
  const Distances d = distances(s);
  // A tick of difference between the wheels turns the robot by tick / wheelbase, seen over the 2.8 m of the diagonal.
  EXPECT_LT(d.end_m, tick_m / 0.340 * 2.83);
}

/// What a robot with a coarser encoder recorded, in the unit of the finer one that its owner believes in.
Recording coarse(double ticks, double believed) {
  Scenario s = squares(2, 1);
  s.encoders.ticks_per_revolution = ticks;
  Recording recording = run_experiment(s, 0).recording;
  recording.robot.ticks_per_revolution = believed;
  for (RecordedRun& run : recording.runs) {
    for (EncoderSample& e : run.encoders) {
      e.left_ticks = std::llround(double(e.left_ticks) * believed / ticks);
      e.right_ticks = std::llround(double(e.right_ticks) * believed / ticks);
    }
  }
  return recording;
}

// Steps of 3 mm at the wheels' rims shake the robot's heading by 9 mrad; their moments and the commands say better.
TEST(ReplayOfCoarseTicks, AKnownResolutionIsUndone) {
  const Recording recording = coarse(150, 2000);
  const Replay replay(scenario_of(recording, "."), recording);
  const auto worst_rad = [&](const std::vector<Effect>& effects) {
    double worst = 0;
    for (std::size_t r = 0; r < recording.runs.size(); ++r) {
      const std::vector<Pose2> track = replay.poses(r, effects);
      for (std::size_t k = 0; k < track.size(); ++k) {
        worst = std::max(worst, std::abs(track[k].theta_rad - recording.runs[r].truth[k].X_WB.theta_rad));
      }
    }
    return worst;
  };
  const double with = worst_rad({effect("encoder_resolution", {{"ticks_per_revolution", 152}})});
  const double without = worst_rad({});
  std::cout << fmt::format("heading off by up to {:.2f} mrad, {:.2f} mrad without the effect\n", 1000 * with,
                           1000 * without);
  EXPECT_LT(with, 1.2e-3);
  EXPECT_GT(without, 4 * with);
}

// The same of an encoder whose coarseness its owner knows: to a fortieth of a step here.
TEST(ReplayOfCoarseTicks, StepsThatAreKnownBoundTheAngle) {
  Scenario s = squares(2, 2);
  s.encoders.ticks_per_revolution = 360;
  const Recording recording = run_experiment(s, 0).recording;
  const double step_m = 2 * M_PI * recording.robot.wheel_radius_m / 360;
  const Replay replay(scenario_of(recording, "."), recording);
  double square_rad2 = 0, worst_m = 0;
  int n = 0;
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const std::vector<Pose2> track = replay.poses(r, {});
    for (std::size_t k = 0; k < track.size(); ++k, ++n)
      square_rad2 += std::pow(track[k].theta_rad - recording.runs[r].truth[k].X_WB.theta_rad, 2);
    worst_m = std::max(worst_m, distance_m(track.back(), recording.runs[r].truth.back().X_WB));
  }
  const double of_step = std::sqrt(square_rad2 / n) * recording.robot.wheelbase_m / step_m;
  std::cout << fmt::format("heading off by {:.3f} of a step (rms), ends by up to {:.2f} mm, a step is {:.2f} mm\n",
                           of_step, 1000 * worst_m, 1000 * step_m);
  EXPECT_LT(of_step, 0.05);  // 0.12 where the counts are smoothed alone
}

// A controller that holds the robot where a coarse count changes makes it tremble by a step: no rotation.
TEST(ReplayOfCommands, AStepToAndFroIsNoGain) {
  for (const double ticks : {70.0, 150.0, 500.0}) {
    const Recording recording = coarse(ticks, 2000);
    for (const RecordedRun& run : recording.runs) {
      const gap::CommandResponse f =
          gap::command_response(run, recording.robot, gap::counted_rad(run, recording.robot), 2 * M_PI / ticks);
      std::cout << fmt::format("{} ticks, {}: gains {:+.5f} {:+.5f}, uncertain by {:.5f}\n", ticks, run.id, f.left_gain,
                               f.right_gain, f.gain_sd);
      EXPECT_LT(std::abs(f.left_gain), 3 * f.gain_sd);
      EXPECT_LT(std::abs(f.right_gain), 3 * f.gain_sd);
    }
  }
}

// Ramps of two samples, and turns that are over before they are fast, show less than was asked for.
TEST(ReplayOfCommands, CommandFeaturesShowAsMuchOfADemandAsTheRecording) {
  for (const auto& [name, factor] : {std::pair<const char*, double>{"over_acceleration", 5},
                                     {"over_acceleration", 25},
                                     {"fast_turning", 2},
                                     {"fast_turning", 9}}) {
    Scenario s = squares(2, 2);
    s.effects = {effect(name, {{"factor", factor}})};
    const Recording recording = run_experiment(s, 0).recording;
    std::vector<std::vector<Stretch>> all;
    for (const RecordedRun& run : recording.runs) all.push_back(stretches(run, recording.robot));
    const CommandFeatures measured = measured_command_features(recording, all, 1);
    s.effects.clear();
    const Recording plain = run_experiment(s, 0).recording;
    const CommandFeatures foretold =
        Replay(scenario_of(plain, "."), plain).command_features({effect(name, {{"factor", factor}})});
    for (std::size_t i = 0; i < 3; ++i) {
      std::cout << fmt::format("{} x {}: command feature {} {:.3f}, foretold {:.3f}, asked {:.3f}\n", name, factor, i,
                               measured[i], foretold[i], std::log(factor));
      EXPECT_NEAR(foretold[i], measured[i], 0.05);
    }
  }
}

// Full speed or none: a set-point that jumps between two readings has no acceleration, and is no harder driver.
TEST(ReplayOfCommands, ASetPointThatJumpsSaysNothingOfAnAcceleration) {
  Recording recording = run_experiment(squares(2, 2), 0).recording;
  std::vector<std::vector<Stretch>> all;
  for (RecordedRun& run : recording.runs) {
    for (EncoderSample& e : run.encoders) {
      for (double* command : {&e.left_command_radps, &e.right_command_radps}) {
        *command = std::abs(*command) < 0.05 ? 0 : std::copysign(2.0, *command);
      }
    }
    all.push_back(stretches(run, recording.robot));
  }
  const CommandFeatures features = measured_command_features(recording, all, 1);
  std::cout << fmt::format("accelerations {:.3f} {:.3f}\n", features[0], features[1]);
  EXPECT_EQ(features[0], 0);
  EXPECT_EQ(features[1], 0);
}

// Counters that are read rarely stand still in between, however coarse they are: nothing else makes moving wheels do
// so.
TEST(ReplayOfCommands, RareSamplingShowsInCountsThatStandStill) {
  for (const double interval_s : {0.02, 0.0222, 0.0241, 0.05, 0.16, 0.2508}) {
    for (const double ticks : {0.0, 172.0}) {
      Scenario s = squares(1, 2);
      s.effects = {effect("encoder_sampling", {{"interval_s", interval_s}})};
      if (ticks > 0) s.effects.push_back(effect("encoder_resolution", {{"ticks_per_revolution", ticks}}));
      const Recording recording = run_experiment(s, 0).recording;
      std::vector<std::vector<Stretch>> all;
      for (const RecordedRun& run : recording.runs) all.push_back(stretches(run, recording.robot));
      const double measured = measured_command_features(recording, all, count_step(recording))[3];
      const double truth = std::log(interval_s * recording.encoder_rate_hz);
      std::cout << fmt::format("{} s, {} ticks: log of the ratio {:.4f} of {:.4f}\n", interval_s, ticks, measured,
                               truth);
      EXPECT_NEAR(measured, truth, 0.015);
    }
  }
}

TEST(Replay, EffectsOfTheScenarioActInEveryReplay) {
  const Effect wheelbase = effect("wheelbase", {{"relative", 0.01}});
  const Effect more = effect("wheelbase", {{"relative", 0.005}});
  const Recording recording = run_experiment(squares(1, 1), 0).recording;
  const Replay plain(scenario_of(recording, "."), recording);
  Scenario scenario = scenario_of(recording, ".");
  scenario.effects = {wheelbase};
  const Replay believed(scenario, recording);
  const auto apart_m = [](const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
    double worst = 0;
    for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, distance_m(a[k], b[k]));
    return worst;
  };
  EXPECT_EQ(apart_m(believed.poses(0, {}), plain.poses(0, {wheelbase})), 0);
  EXPECT_LT(apart_m(believed.poses(0, {more}), plain.poses(0, {effect("wheelbase", {{"relative", 0.015}})})), 1e-12);
  EXPECT_GT(apart_m(believed.poses(0, {}), plain.poses(0, {})), 0.01);
}

// A robot that sped up so hard that its caster left the floor, and came down again, did not tip over: its replay does
// not, either.
TEST(Replay, ACasterThatCameDownAgainWasNoFall) {
  Scenario s = squares(2, 1);
  s.course.linear_speed_mps = 1.8;
  s.course.linear_acceleration_mps2 = 4.8;  // for 0.375 s, where labmate stands 4.5
  s.floor_friction = 2;                     // so that it does not slip instead
  s.encoders.ticks_per_revolution = 20000;
  EXPECT_THROW(run_experiment(s, 0), RunError) << "else this shows nothing";
  s.physics.may_lean = true;
  const Recording recording = run_experiment(s, 0).recording;
  Scenario described = scenario_of(recording, ".");
  described.floor_friction = s.floor_friction;
  const Replay replay(described, recording);
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const double off_m = distance_m(replay.poses(r, {}).back(), recording.runs[r].truth.back().X_WB);
    std::cout << fmt::format("{}: {:.2f} mm at the end\n", recording.runs[r].id, 1000 * off_m);
    EXPECT_LT(off_m, 2e-3);
  }
}

TEST(ReplayOfCommands, CoarseEncodersCountInSteps) {
  const Recording recording = coarse(150, 2000);
  const Replay replay(scenario_of(recording, "."), recording);
  const auto counts = replay.counts(0, {effect("encoder_resolution", {{"ticks_per_revolution", 152}})});
  for (const auto& angle : counts) {
    const double steps = angle[0] * 150 / (2 * M_PI);
    ASSERT_NEAR(steps, std::round(steps), 0.01);
  }
}

TEST(ReplayOfCommands, CountsWhatTheEncodersCounted) {
  for (const auto& effects : {std::vector<Effect>{},
                              {effect("encoder_missed_counts", {{"left_probability", 0.01}})},
                              {effect("encoder_latency", {{"seconds", 0.1}})},
                              {effect("motor_response", {{"lag_s", 0.08}, {"gain_asymmetry", 0.02}})}}) {
    SCOPED_TRACE(effects.empty() ? "nominal" : effects[0].info->name);
    Scenario s = squares(2, 1);
    s.encoders.ticks_per_revolution = 1e6;
    s.effects = effects;
    const Recording recording = run_experiment(s, 0).recording;
    const Replay replay(scenario_of(recording, "."), recording);
    for (std::size_t r = 0; r < recording.runs.size(); ++r) {
      const std::vector<std::array<double, 2>> counts = replay.counts(r, effects);
      const std::vector<EncoderSample>& samples = recording.runs[r].encoders;
      ASSERT_EQ(counts.size(), samples.size());
      double worst_rad = 0, way_rad = 0;
      for (std::size_t i = 0; i < counts.size(); ++i) {
        const double counted[] = {double(samples[i].left_ticks) * 2 * M_PI / 1e6,
                                  double(samples[i].right_ticks) * 2 * M_PI / 1e6};
        for (std::size_t w = 0; w < 2; ++w) worst_rad = std::max(worst_rad, std::abs(counts[i][w] - counted[w]));
        way_rad = std::max(way_rad, std::abs(counted[0]));
      }
      std::cout << fmt::format("{} {}: {:.5f} of {:.1f} rad\n", effects.empty() ? "nominal" : effects[0].info->name,
                               recording.runs[r].id, worst_rad, way_rad);
      // A command holds for one period of 20 ms and is recorded at one of its ends.
      EXPECT_LT(worst_rad, 0.02 * 0.3 / 0.075 * 1.5);
    }
  }
}

TEST(Replay, RecordedDimensionsGoBeforeTheRobotFile) {
  Recording recording = run_experiment(squares(0.5, 1), 0).recording;
  recording.robot.wheel_radius_m *= 1.01;
  recording.robot.wheelbase_m *= 0.98;
  const Replay replay(scenario_of(recording, "."), recording);
  EXPECT_NEAR(replay.nominal().wheels[0].radius_m, 1.01 * 0.075, 1e-12);
  EXPECT_NEAR(replay.nominal().wheelbase_m(), 0.98 * 0.340, 1e-12);
}

// A circle never leads far from its start. Seen there, a wheelbase that is 5 % wider than believed must not turn the
// start: where the first heading is off it is corrected by what comes before the robot has turned.
TEST(Replay, AWrongWheelbaseOnACircleDoesNotTurnTheStart) {
  Scenario s = squares(1, 1);
  s.course.shape = "circle";
  s.course.radius_m = 0.4;
  s.effects = {effect("wheelbase", {{"relative", 0.05}})};
  Recording recording = run_experiment(s, 0).recording;
  const auto start_rad = [&] { return Replay(scenario_of(recording, "."), recording).poses(0, {}).front().theta_rad; };
  const double recorded_rad = recording.runs[0].truth[0].X_WB.theta_rad;
  EXPECT_NEAR(start_rad(), recorded_rad, 1e-3);
  recording.runs[0].truth[0].X_WB.theta_rad += 0.1;  // a first heading that alone is off is not believed
  EXPECT_NEAR(start_rad(), recorded_rad, 0.01);
}

// Largest change of the heading's error within a second, mean over the runs.
double mean_jump_rad(const Replay& replay, const std::vector<Effect>& effects) {
  constexpr double kSecond_s = 1;
  double sum = 0;
  const Recording& recording = replay.recording();
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const std::vector<Pose2> track = replay.poses(r, effects);
    const std::vector<TruthSample>& truth = recording.runs[r].truth;
    const auto off_rad = [&](std::size_t k) { return wrap_angle(truth[k].X_WB.theta_rad - track[k].theta_rad); };
    double most = 0;
    for (std::size_t i = 0, k = 0; k < track.size(); ++k) {
      while (truth[k].time_s - truth[i].time_s > kSecond_s) ++i;
      most = std::max(most, std::abs(off_rad(k) - off_rad(i)));
    }
    sum += most;
  }
  return sum / double(recording.runs.size());
}

// Whether a wheel comes across a hole of two centimetres is a matter of millimetres, by which a replay strays. A replay
// that knows nothing of the track shows the difference.
TEST(ReplayOfATrack, MeetsAHoleWhereTheRobotWasSeen) {
  Scenario s = squares(4, 6);
  s.noise.wheel_noise_m_per_sqrt_m = 3e-4;
  s.effects = {effect("wheel_lift", {{"x_m", 3.985}, {"y_m", 0.175}, {"length_m", 0.02}}),
               effect("wheel_lift", {{"x_m", 3.985}, {"y_m", -0.175}, {"length_m", 0.02}})};
  const Recording recording = run_experiment(s, 0).recording;
  const Replay seen(scenario_of(recording, "."), recording);
  const Replay unseen(scenario_of(recording, "."), recording, false);
  const double none = mean_jump_rad(seen, {});
  const double with_track = mean_jump_rad(seen, s.effects);
  const double without = mean_jump_rad(unseen, s.effects);
  std::cout << fmt::format(
      "mean of the largest jumps: no hole {:.2f} mrad, met by the replay {:.2f}, where seen {:.2f}\n", 1000 * none,
      1000 * without, 1000 * with_track);
  EXPECT_LT(with_track, 0.3 * none);
  EXPECT_LT(with_track, 0.5 * without);
}

}  // namespace
}  // namespace umbsim

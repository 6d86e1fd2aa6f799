// Recordings that another physics engine made: the names must be right; parameters and places are printed.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "calibration/intake/intake.h"
#include "gap/answer/closure.h"
#include "gap/output/parameter_estimates.h"
#include "tests/gap/recordings.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

// Nobody says which engine drove: how little turns, legs, tyres and lags stray does.
TEST(WhoseEngine, RunsWithoutAnEffectSayWhichDroveThem) {
  for (const std::uint64_t seed : {81u, 82u, 83u}) {
    const testing::Subject ours(testing::campaign({}, seed));
    const double another = ours.model.another_engine(ours.model.none());
    std::cout << fmt::format("this engine, seed {}: {:+.1f}\n", seed, another);
    EXPECT_LT(another, 0) << seed;
  }
  for (const char* name : {"case-01", "case-14"}) {
    const std::filesystem::path folder = std::filesystem::path(UMBSIM_SHARED_DIR) / "recordings/second-engine" / name;
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
    const Recording recording = read_recording(folder);
    const Replay replay(scenario_of(recording, folder.string()), recording);
    const Campaign campaign = campaign_of(recording);
    Model model(campaign, testing::simulator(replay), Scatter{});
    const double another = model.another_engine(model.none());
    std::cout << fmt::format("another engine, {}: {:+.1f}\n", name, another);
    EXPECT_GT(another, 0) << name;
    // What engines differ by leaves less of it to be explained, and hides more.
    const double misfit = model.with_little_differences().none().misfit / model.rows();
    model.take_for_another_engines();
    EXPECT_FALSE(model.engine_is_open());
    std::cout << fmt::format("  misfit {:.2f} -> {:.2f} of what noise makes, hidden {:.1f} -> {:.1f} mm\n", misfit,
                             model.none().misfit / model.rows(), most_hidden_mm(model, false), most_hidden_mm(model));
    EXPECT_LT(model.none().misfit / model.rows(), misfit);
    EXPECT_GT(most_hidden_mm(model), most_hidden_mm(model, false));
  }
}

// The robot is pulled outward in turns in place, by `rate` m/s at 1 rad/s and as the square of the rate, as in MuJoCo.
Recording pulled_outward(Recording recording, double rate) {
  for (RecordedRun& run : recording.runs) {
    Eigen::Vector2d pulled_m(0, 0);
    Pose2 last = run.truth.front().X_WB;
    for (std::size_t k = 1; k < run.truth.size(); ++k) {
      const Pose2 now = run.truth[k].X_WB;
      const double turn_rad = now.theta_rad - last.theta_rad, middle_rad = last.theta_rad + turn_rad / 2;
      const bool turns = std::hypot(now.x_m - last.x_m, now.y_m - last.y_m) < 0.05 * std::abs(turn_rad);
      const double turning_radps = turn_rad / (run.truth[k].time_s - run.truth[k - 1].time_s);
      if (turns)
        pulled_m += rate * turning_radps * turn_rad * Eigen::Vector2d(std::cos(middle_rad), std::sin(middle_rad));
      last = now;
      run.truth[k].X_WB.x_m += pulled_m[0];
      run.truth[k].X_WB.y_m += pulled_m[1];
    }
  }
  return recording;
}

// No effect is needed for that, and its size is found.
TEST(ContactsOfAnotherEngine, PullOutwardInTurnsInPlace) {
  constexpr double kRate = 1.5e-3;
  const testing::Subject p(pulled_outward(testing::campaign({}, 97), kRate));
  const Fit none = p.model.none();
  EXPECT_TRUE(p.model.another_engines(none));
  const double found = none.nuisance[column_of(0, kOutward)];
  std::cout << fmt::format("pulled outward by {:.2f} mm/s at 1 rad/s, found {:.2f}\n", 1000 * kRate, 1000 * found);
  EXPECT_NEAR(found, kRate, 0.1 * kRate);
  EXPECT_EQ(p.diagnosed().causes.front().name, "none");
}

// Contacts that differ move no counts. A motor whose commands say that it should turn faster is named though it moves
// no pose, and needs no margin for contacts.
TEST(CountsOfAnotherEngine, NeedNoMarginForContacts) {
  const std::filesystem::path folder = std::filesystem::path(UMBSIM_SHARED_DIR) / "recordings/second-engine/case-14";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  constexpr double kSlower = -0.004;
  Recording recording = read_recording(folder);
  for (RecordedRun& run : recording.runs) {
    for (EncoderSample& sample : run.encoders) sample.right_command_radps /= 1 + kSlower;
  }
  const Replay replay(scenario_of(recording, folder.string()), recording);
  const Campaign campaign = campaign_of(recording);
  Model model(campaign, testing::simulator(replay), Scatter{});
  const Diagnosis d = diagnose(model, {}, Thresholds{}, [](const std::string&, double) {});
  ASSERT_EQ(d.causes.front().name, "motor_response");
  EXPECT_FALSE(d.in_poses);
  for (const ParameterEstimate& e : parameter_estimates(d.causes.front(), d)) {
    if (e.parameter != "gain_asymmetry") continue;
    std::cout << fmt::format("{}: score {:.1f}, {:.4g} [{:.4g}, {:.4g}]\n", e.parameter, d.causes.front().score,
                             e.value, e.ci95[0], e.ci95[1]);
    EXPECT_TRUE(e.ci95[0] <= kSlower && kSlower <= e.ci95[1]);
  }
}

struct Labelled {
  const char* folder;
  const char* effect;  ///< "none" for no effect
  const char* parameter = "";
  double value = 0;
};

void PrintTo(const Labelled& label, std::ostream* out) { *out << label.folder; }

class SecondEngine : public ::testing::TestWithParam<Labelled> {};

TEST_P(SecondEngine, TheCauseIsNamed) {
  const Labelled& label = GetParam();
  const std::filesystem::path folder =
      std::filesystem::path(UMBSIM_SHARED_DIR) / "recordings/second-engine" / label.folder;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const Recording recording = read_recording(folder);
  intake::check_recording(recording, folder.string());
  const Replay replay(scenario_of(recording, folder.string()), recording);
  const Campaign campaign = campaign_of(recording);
  Model model(campaign, testing::simulator(replay), Scatter{});
  const Diagnosis d = diagnose(model, {}, Thresholds{}, [](const std::string&, double) {});
  const Cause& first = d.causes.front();
  std::string said = fmt::format("{}: {} (set {})", label.folder, first.name, fmt::join(d.set, ", "));
  double error = 0;
  for (const ParameterEstimate& e : parameter_estimates(first.fit, d)) {
    if (e.parameter != label.parameter) continue;
    error = std::abs(e.value - label.value) / std::abs(label.value);
    said += fmt::format(", {} {:.4g} [{:.4g}, {:.4g}], true {:.4g}: off by {:.1f} %", e.parameter, e.value, e.ci95[0],
                        e.ci95[1], label.value, 100 * error);
  }
  if (d.has_place) said += fmt::format(", at ({:.2f}, {:.2f}) m", d.place_m[0], d.place_m[1]);
  if (d.closure.known) said += fmt::format(", closure {:.3f}", d.closure.fraction);
  std::cout << said << "\n";
  EXPECT_EQ(first.name, label.effect);
  EXPECT_EQ(d.detected, std::string(label.effect) != "none");
  constexpr double kOtherEngine = 0.7;  // bar of the project's table of figures
  if (d.detected) {
    EXPECT_GT(d.closure.fraction, kOtherEngine);
  }
}

INSTANTIATE_TEST_SUITE_P(Case, SecondEngine,
                         ::testing::Values(Labelled{"case-01", "none"},
                                           Labelled{"case-02", "wheel_radius_difference", "relative", 0.002},
                                           Labelled{"case-03", "wheelbase", "relative", 0.01},
                                           Labelled{"case-05", "carpet_drift", "metres_per_metre", 0.004},
                                           Labelled{"case-06", "bump", "height_m", 0.006},
                                           Labelled{"case-09", "encoder_latency", "seconds", 0.1},
                                           Labelled{"case-10", "push", "impulse_newton_seconds", 22},
                                           Labelled{"case-11", "wheel_eccentricity", "right_m", 0.0015},
                                           Labelled{"case-12", "wheel_misalignment", "right_toe_rad", 0.006},
                                           Labelled{"case-14", "none"}),
                         [](const auto& test) {
                           std::string name = test.param.folder;
                           name[4] = '_';
                           return name;
                         });

}  // namespace
}  // namespace umbsim::gap

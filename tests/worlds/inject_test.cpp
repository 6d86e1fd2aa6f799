// Faults put into recordings are found again by the classical figures.
#include "bench/worlds/inject/inject.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "gap/trial/write/answers.h"
#include "umbmark/figures.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

const InjectionKind& kind_of(const std::string& name) {
  for (const InjectionKind& kind : injections()) {
    if (kind.name == name) return kind;
  }
  throw std::logic_error(name);
}

Recording spoil(const Recording& real, const std::string& name, double size, Injection& done) {
  return spoiled(real, kind_of(name), size, 3, done);
}

// Two runs straight on: the wheels turn once around in 10 s, read every 0.1 s, truth alongside.
Recording straight() {
  Recording r;
  r.robot = {"", 0.1, 0.4, 1000};
  r.encoder_rate_hz = 10;
  for (int run = 0; run < 4; ++run) {
    RecordedRun each;
    each.id = "cw-" + std::to_string(run + 1);
    each.direction = "cw";
    for (int k = 0; k <= 100; ++k) {
      each.encoders.push_back({0.1 * k, 10 * k, 10 * k, 0, 0});
      each.truth.push_back({0.1 * k, {2 * M_PI * 0.1 * k / 100, 0, 0}});
    }
    r.runs.push_back(each);
  }
  return r;
}

TEST(Inject, CountsAreSpoiledByWhatTheAnswerSays) {
  Injection done;
  const Recording late = spoil(straight(), "late_counts", 0.2, done);
  EXPECT_NEAR(done.parameters["seconds"].get<double>(), 0.2, 1e-9);
  EXPECT_EQ(late.runs[0].encoders[50].left_ticks, 480);
  EXPECT_EQ(late.runs[0].encoders[1].left_ticks, 0);

  const Recording coarse = spoil(straight(), "coarse_counts", 40, done);
  EXPECT_NEAR(done.parameters["ticks_per_revolution"].get<double>(), 25, 1e-9);
  for (const EncoderSample& e : coarse.runs[0].encoders) EXPECT_EQ(e.left_ticks % 40, 0);

  const Recording rare = spoil(straight(), "rare_counts", 0.5, done);
  EXPECT_EQ(rare.runs[0].encoders[14].left_ticks, 100);
  EXPECT_EQ(rare.runs[0].encoders[15].left_ticks, 150);

  const Recording worn = spoil(straight(), "wear", 0.01, done);
  const std::string key = done.parameters.begin().key();
  const double per_run = done.parameters[key].get<double>();
  const bool left = key == "left_relative_per_run";
  for (std::size_t i = 0; i < 4; ++i) {
    const EncoderSample& e = worn.runs[i].encoders.back();
    EXPECT_EQ(left ? e.left_ticks : e.right_ticks, std::llround(1000 / (1 + per_run * double(i))));
    EXPECT_EQ(left ? e.right_ticks : e.left_ticks, 1000);
  }

  const Recording lost = spoil(straight(), "lost_counts", 0.1, done);
  std::int64_t missing = 0;
  for (const RecordedRun& run : lost.runs)
    missing += 2000 - run.encoders.back().left_ticks - run.encoders.back().right_ticks;
  EXPECT_NEAR(double(missing), 400, 60);  // of 4000 counts of one wheel, a tenth: standard deviation 19
}

TEST(Inject, WhatARecordingCannotCarryIsRefused) {
  Recording r = straight();
  r.runs.resize(3);
  Injection done;
  EXPECT_THROW(spoil(r, "wear", 0.01, done), InputError);
}

TEST(Inject, SeverityIsInUnitsOfWhatTheRunsDifferBy) {
  Recording r = straight();
  for (std::size_t run = 0; run < 4; ++run) {  // the robot ends 10 mm left or right of where its counts lead
    for (TruthSample& t : r.runs[run].truth) t.X_WB.y_m = (run % 2 ? 0.01 : -0.01) * t.time_s / 10;
  }
  Injection done;
  const Recording twice = spoil(r, "believed_radius", 0.02, done);
  // Of x alone, which has no noise; headings and y do not change: nothing to weigh it by.
  EXPECT_EQ(severity_of(r, twice), 0);
  EXPECT_FALSE(severity_of(
      [] {
        Recording one = straight();
        one.runs.resize(1);
        return one;
      }(),
      straight()));
}

class RealSquares : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(UMBSIM_SHARED_DIR) / "recordings" / "optiodom-square-1.7m";
    if (!fs::exists(folder_)) GTEST_SKIP() << "the OptiOdom recordings are not here";
    real_ = read_recording(folder_);
  }
  ErrorEstimate found(const Recording& r) const {
    const OdometryParameters believed{r.robot.wheel_radius_m, r.robot.wheel_radius_m, r.robot.wheelbase_m,
                                      r.robot.ticks_per_revolution};
    return umbmark(r, believed).heading;
  }
  fs::path folder_;
  Recording real_;
};

// Real noise cancels: the same runs with and without the fault.
TEST_F(RealSquares, UmbmarkFindsTheInjectedWheelbase) {
  Injection done;
  const Recording r = spoil(real_, "believed_wheelbase", 0.03, done);
  const double ratio = found(r).e_b / found(real_).e_b;
  EXPECT_NEAR(ratio, 1 + done.parameters["relative"].get<double>(), 0.001);
}

TEST_F(RealSquares, UmbmarkFindsTheInjectedGain) {
  Injection done;
  const Recording r = spoil(real_, "unequal_gain", 0.005, done);
  const double ratio = found(r).e_d / found(real_).e_d;
  EXPECT_NEAR(ratio, 1 + done.parameters["relative"].get<double>(), 0.0003);
}

TEST_F(RealSquares, AFolderOfATrialWithSealedAnswersAndTheUnspoiledBeside) {
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "injected");
  const InjectResult result = inject({folder_.string()}, folder, 9, 4);
  EXPECT_EQ(result.recordings + result.refused, 9u);
  EXPECT_GE(result.recordings, 8u);
  EXPECT_EQ(result.unspoiled, 1u);
  const Answers answers = read_answers(folder.answers());
  EXPECT_EQ(answers.size(), result.recordings);
  for (const auto& [name, answer] : answers) {
    EXPECT_EQ(name.find("optiodom"), std::string::npos);
    const Recording spoiled = read_recording(folder.recordings() / name);
    ASSERT_EQ(spoiled.runs.size(), real_.runs.size());
    for (std::size_t i = 0; i < spoiled.runs.size(); ++i)
      EXPECT_EQ(spoiled.runs[i].has_commands, real_.runs[i].has_commands);  // zeros of a robot that moves are refused
    EXPECT_TRUE(answer.severity().has_value());
  }
  EXPECT_FALSE(fs::exists(folder.root / "unspoiled" / "answers.json"));
}

}  // namespace
}  // namespace umbsim::worlds

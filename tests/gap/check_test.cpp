// Bad recordings are found and named before anything is fitted. Each is a good one with one thing spoiled.
#include "gap/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "tests/acceptance/program.h"
#include "tests/gap/recordings.h"

namespace umbsim::gap {
namespace {

const Recording& good() {
  static const Recording recording = [] {
    Scenario s = testing::squares(1, 2);
    testing::add_noise(s, 3);
    return run_experiment(s, 0).recording;
  }();
  return recording;
}

using Spoil = std::function<void(Recording&)>;

Spoil every_sample(const std::function<void(EncoderSample&)>& change) {
  return [change](Recording& r) {
    for (RecordedRun& run : r.runs) std::for_each(run.encoders.begin(), run.encoders.end(), change);
  };
}

Spoil every_pose(const std::function<void(Pose2&)>& change) {
  return [change](Recording& r) {
    for (RecordedRun& run : r.runs) {
      for (TruthSample& t : run.truth) change(t.X_WB);
    }
  };
}

Spoil scaled_truth(double factor) {
  return every_pose([factor](Pose2& p) {
    p.x_m *= factor;
    p.y_m *= factor;
  });
}

void swap_wheels(EncoderSample& s) { std::swap(s.left_ticks, s.right_ticks); }
void reverse_wheels(EncoderSample& s) {
  s.left_ticks = -s.left_ticks;
  s.right_ticks = -s.right_ticks;
}

struct Bad {
  const char* name;
  Spoil spoil;
  std::vector<std::string> says;  ///< what is wrong, and what to do
};

const std::vector<Bad>& bad_recordings() {
  static const std::vector<Bad> all = {
      {"no motion",
       [](Recording& r) {
         RecordedRun& run = r.runs[1];
         for (EncoderSample& s : run.encoders) s.left_ticks = s.right_ticks = 7;
         for (TruthSample& t : run.truth) t.X_WB = {0.001, 0, 0.01};
       },
       {"no motion", "Leave the run out"}},
      {"encoders that stand still", every_sample([](EncoderSample& s) { s.left_ticks = s.right_ticks = 0; }),
       {"encoders hardly at all"}},
      {"truth that stands still", every_pose([](Pose2& p) { p = {}; }), {"no motion in the truth"}},
      {"swapped wheels", every_sample(swap_wheels), {"left_ticks and right_ticks are swapped", "exchange the columns"}},
      {"wheels that count backwards", every_sample(reverse_wheels), {"backwards", "negate both"}},
      {"wheels swapped and backwards",
       every_sample([](EncoderSample& s) {
         swap_wheels(s);
         reverse_wheels(s);
       }),
       {"swapped", "backwards"}},
      {"a jump of the counter",
       [](Recording& r) {
         auto& s = r.runs[0].encoders;
         for (std::size_t i = s.size() / 3; i < s.size(); ++i) s[i].right_ticks += 5000;
       },
       {"right ticks jump", "Cut the run there"}},
      {"a counter that overflowed",
       [](Recording& r) {
         auto& s = r.runs[2].encoders;
         for (std::size_t i = s.size() / 2; i < s.size(); ++i) s[i].left_ticks -= 65536;
       },
       {"left ticks jump", "overflowed", "unwrap"}},
      {"truth with a gap",
       [](Recording& r) {
         auto& t = r.runs[0].truth;
         t.erase(t.begin() + 40, t.begin() + 90);
       },
       {"gap from", "Split the run"}},
      {"truth in millimetres", scaled_truth(1000), {"millimetres", "divide"}},
      {"truth in centimetres", scaled_truth(100), {"centimetres", "divide"}},
      {"truth off by ten", scaled_truth(10), {"wrong by 10"}},
      {"truth off by a tenth", scaled_truth(0.1), {"wrong by 10"}},
      {"wheel radius in millimetres", [](Recording& r) { r.robot.wheel_radius_m *= 1000; },
       {"wheel_radius_m is in millimetres", "divide by 1000"}},
      {"radians for ticks",
       every_sample([](EncoderSample& s) {
         s.left_ticks = std::lround(double(s.left_ticks) * 2 * M_PI / 2000);
         s.right_ticks = std::lround(double(s.right_ticks) * 2 * M_PI / 2000);
       }),
       {"radians"}},
      {"quadrature forgotten",
       every_sample([](EncoderSample& s) {
         s.left_ticks *= 4;
         s.right_ticks *= 4;
       }),
       {"quadrature"}},
      {"headings in degrees", every_pose([](Pose2& p) { p.theta_rad *= 180 / M_PI; }), {"degrees"}},
      {"headings wrapped", every_pose([](Pose2& p) { p.theta_rad = wrap_angle(p.theta_rad); }), {"unwrap"}},
      {"heading clockwise", every_pose([](Pose2& p) { p.theta_rad = -p.theta_rad; }), {"clockwise"}},
  };
  return all;
}

Recording spoiled(const Bad& bad) {
  Recording recording = good();
  bad.spoil(recording);
  return recording;
}

TEST(CheckRecording, AGoodOneHasNoLimits) { EXPECT_TRUE(check_recording(good(), "here").empty()); }

TEST(CheckRecording, NamesWhatIsWrong) {
  for (const Bad& bad : bad_recordings()) {
    SCOPED_TRACE(bad.name);
    try {
      check_recording(spoiled(bad), "the/folder");
      ADD_FAILURE() << "taken for a good one";
    } catch (const InputError& e) {
      acceptance::expect_says(e.what(), bad.says);
      acceptance::expect_says(e.what(), {"the/folder", "run "});
    }
  }
}

TEST(CheckRecording, TheProgramRefusesThemAllBeforeItWritesAnything) {
  for (const Bad& bad : bad_recordings()) {
    SCOPED_TRACE(bad.name);
    const acceptance::Desk desk;
    std::filesystem::create_directory(desk.home / "bad");
    write_recording(spoiled(bad), desk.home / "bad");
    const acceptance::Outcome outcome = desk.umbsim({"gap", "diagnose", "bad", "--out", "d"});
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    acceptance::expect_says(outcome.err, bad.says);
    EXPECT_FALSE(std::filesystem::exists(desk.home / "d"));
  }
}

TEST(CheckRecording, TheProgramRefusesAClockThatRunsBackwards) {
  const acceptance::Desk desk;
  Recording recording = good();
  std::swap(recording.runs[0].encoders[100].time_s, recording.runs[0].encoders[101].time_s);
  std::filesystem::create_directory(desk.home / "bad");
  write_recording(recording, desk.home / "bad");
  const acceptance::Outcome outcome = desk.umbsim({"gap", "diagnose", "bad", "--out", "d"});
  EXPECT_EQ(outcome.code, 2);
  acceptance::expect_says(outcome.err, {"encoders.csv", "time_s"});
  EXPECT_FALSE(std::filesystem::exists(desk.home / "d"));
}

TEST(CheckRecording, LimitsAreSaidButNotRefused) {
  const auto says = [](const Recording& recording, const std::string& what) {
    const std::vector<std::string> limits = check_recording(recording, "here");
    EXPECT_TRUE(std::any_of(limits.begin(), limits.end(), [&](const std::string& l) {
      return l.find(what) != std::string::npos;
    })) << what;
  };
  Recording one = good();
  one.runs.resize(1);
  says(one, "one run only");
  says(one, "one direction only");
  Recording single = good();
  single.runs.erase(std::remove_if(single.runs.begin(), single.runs.end(),
                                   [](const RecordedRun& run) { return run.id.back() != '1'; }),
                    single.runs.end());
  ASSERT_EQ(single.runs.size(), 2u);
  says(single, "no run was repeated");
  Recording ends = good();
  ends.truth_kind = "endpoints";
  for (RecordedRun& run : ends.runs) run.truth = {run.truth.front(), run.truth.back()};
  says(ends, "end points only");
}

}  // namespace
}  // namespace umbsim::gap

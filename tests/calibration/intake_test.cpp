// Bad recordings are found and named before anything is fitted. Each is a good one with one thing spoiled.
#include "calibration/intake/intake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <random>

#include "core/error.h"
#include "tests/acceptance/program.h"
#include "tests/gap/recordings.h"

namespace umbsim::intake {
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
      {"encoders that stand still",
       every_sample([](EncoderSample& s) { s.left_ticks = s.right_ticks = 0; }),
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
      {"wheel radius in millimetres",
       [](Recording& r) { r.robot.wheel_radius_m *= 1000; },
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
      {"heading clockwise",
       every_pose([](Pose2& p) { p.theta_rad = -p.theta_rad; }),
       {"mirrored", "theta_rad grows clockwise", "negate it"}},
      {"y to the right", every_pose([](Pose2& p) { p.y_m = -p.y_m; }), {"mirrored", "y_m grows to the right"}},
      {"x and y exchanged",
       every_pose([](Pose2& p) { std::swap(p.x_m, p.y_m); }),
       {"mirrored", "x_m and y_m are exchanged"}},
      {"a left wheel that counts backwards",
       every_sample([](EncoderSample& s) { s.left_ticks *= -1; }),
       {"the left wheel counts backwards", "negate left_ticks"}},
      {"a right wheel that counts backwards",
       every_sample([](EncoderSample& s) { s.right_ticks *= -1; }),
       {"the right wheel counts backwards", "negate right_ticks"}},
      {"a dead counter",
       every_sample([](EncoderSample& s) { s.left_ticks = 0; }),
       {"left wheel hardly counts", "dead"}},
      {"a small jump of the counter",
       [](Recording& r) {
         auto& s = r.runs[3].encoders;
         for (std::size_t i = s.size() / 2; i < s.size(); ++i) s[i].left_ticks += 200;
       },
       {"left ticks jump by", "repair the counter"}},
      {"encoders with a gap",
       [](Recording& r) {
         auto& s = r.runs[1].encoders;
         s.erase(s.begin() + 300, s.begin() + 450);
       },
       {"encoders.csv has a gap", "Split the run"}},
      {"a truth that jumps",
       [](Recording& r) {
         auto& t = r.runs[0].truth;
         for (std::size_t i = t.size() / 2; i < t.size(); ++i) t[i].X_WB.y_m += 0.7;
       },
       {"the truth jumps by 0.7", "Cut the run there"}},
      {"one pose beside the track",
       [](Recording& r) { r.runs[1].truth[70].X_WB.x_m += 0.3; },
       {"m beside the track", "Delete the row"}},
      {"marks mistaken for each other",
       [](Recording& r) {
         auto& t = r.runs[2].truth;
         for (std::size_t i = t.size() / 3; i < t.size(); ++i) t[i].X_WB.theta_rad += M_PI / 2;
       },
       {"theta_rad jumps by 1.57", "mistook its marks"}},
      {"milliseconds",
       [](Recording& r) {
         for (RecordedRun& run : r.runs) {
           for (EncoderSample& s : run.encoders) s.time_s *= 1000;
           for (TruthSample& t : run.truth) t.time_s *= 1000;
         }
       },
       {"time_s is in milliseconds", "divide by 1000"}},
      {"a truth in other seconds",
       [](Recording& r) {
         for (TruthSample& t : r.runs[0].truth) t.time_s *= 0.1;
       },
       {"its time_s is 0.1 times what it should be"}},
      {"wheelbase in centimetres",
       [](Recording& r) { r.robot.wheelbase_m *= 100; },
       {"wheelbase_m is in centimetres", "divide by 100"}},
      {"half a wheelbase", [](Recording& r) { r.robot.wheelbase_m /= 2; }, {"wheelbase_m is half"}},
      {"a diameter for the radius", [](Recording& r) { r.robot.wheel_radius_m *= 2; }, {"may be the diameter"}},
      {"degrees for ticks",
       every_sample([](EncoderSample& s) {
         s.left_ticks = std::lround(double(s.left_ticks) * 360 / 2000);
         s.right_ticks = std::lround(double(s.right_ticks) * 360 / 2000);
       }),
       {"degrees, not counts"}},
      {"directions exchanged",
       [](Recording& r) {
         for (RecordedRun& run : r.runs) run.direction = run.direction == "cw" ? "ccw" : "cw";
       },
       {"its direction is", "set direction"}},
      {"a side in millimetres",
       [](Recording& r) { r.path.side_m *= 1000; },
       {"path.side_m", "millimetres (divide by 1000)"}},
      {"a speed off by ten",
       [](Recording& r) {
         r.path.linear_speed_mps = 10 * r.path.linear_speed_mps.value();
         for (RecordedRun& run : r.runs) run.linear_speed_mps.reset();
       },
       {"linear_speed_mps", "10 times too large"}},
      {"commands in metres per second",
       every_sample([](EncoderSample& s) {
         s.left_command_radps *= 0.075;
         s.right_command_radps *= 0.075;
       }),
       {"commands are in m/s"}},
      {"commands in revolutions per minute",
       every_sample([](EncoderSample& s) {
         s.left_command_radps *= 60 / (2 * M_PI);
         s.right_command_radps *= 60 / (2 * M_PI);
       }),
       {"revolutions per minute"}},
      {"commands exchanged",
       every_sample([](EncoderSample& s) { std::swap(s.left_command_radps, s.right_command_radps); }),
       {"left_command_radps and right_command_radps are swapped"}},
      {"commands reversed",
       every_sample([](EncoderSample& s) {
         s.left_command_radps *= -1;
         s.right_command_radps *= -1;
       }),
       {"commands have the wrong sign", "Negate"}},
      {"no commands in their columns",
       every_sample([](EncoderSample& s) { s.left_command_radps = s.right_command_radps = 0; }),
       {"all commands are zero", "leave out the columns"}},
  };
  return all;
}

// Only the first and the last pose of each run.
Recording end_points(Recording recording) {
  recording.truth_kind = "endpoints";
  for (RecordedRun& run : recording.runs) run.truth = {run.truth.front(), run.truth.back()};
  return recording;
}

// What a recording of end points shows, too.
const std::vector<Bad>& bad_end_points() {
  static const std::vector<Bad> all = {
      {"wheels that stand still",
       every_sample([](EncoderSample& s) { s.left_ticks = s.right_ticks = 0; }),
       {"no motion"}},
      {"a truth that stands still",
       [](Recording& r) { r.runs[0].truth[1].X_WB = r.runs[0].truth[0].X_WB; },
       {"the tracker saw nothing"}},
      {"swapped wheels", every_sample(swap_wheels), {"left_ticks and right_ticks are swapped"}},
      {"a left wheel that counts backwards",
       every_sample([](EncoderSample& s) { s.left_ticks *= -1; }),
       {"the left wheel counts backwards"}},
      {"a right wheel that counts backwards",
       every_sample([](EncoderSample& s) { s.right_ticks *= -1; }),
       {"the right wheel counts backwards"}},
      {"a dead counter", every_sample([](EncoderSample& s) { s.right_ticks = 0; }), {"right wheel hardly counts"}},
      {"truth in millimetres",
       [](Recording& r) {
         r.runs[0].truth[1].X_WB = {35, -12, -6.2};
       },
       {"m from its start", "millimetres"}},
      {"wheel radius off by ten", [](Recording& r) { r.robot.wheel_radius_m *= 10; }, {"wrong by 10"}},
      {"wheelbase in centimetres", [](Recording& r) { r.robot.wheelbase_m *= 100; }, {"wheelbase_m is in centimetres"}},
      {"headings wrapped", every_pose([](Pose2& p) { p.theta_rad = wrap_angle(p.theta_rad); }), {"not unwrapped"}},
      {"headings in degrees", every_pose([](Pose2& p) { p.theta_rad *= 180 / M_PI; }), {"degrees"}},
      {"radians for ticks",
       every_sample([](EncoderSample& s) {
         s.left_ticks = std::lround(double(s.left_ticks) * 2 * M_PI / 2000);
         s.right_ticks = std::lround(double(s.right_ticks) * 2 * M_PI / 2000);
       }),
       {"radians"}},
      {"an end that is none", [](Recording& r) { r.runs[1].truth[1].time_s /= 2; }, {"its end point is of"}},
  };
  return all;
}

Recording spoiled(const Bad& bad, Recording recording = good()) {
  bad.spoil(recording);
  return recording;
}

void expect_refused(const Recording& recording, const Bad& bad) {
  SCOPED_TRACE(bad.name);
  try {
    check_recording(recording, "the/folder");
    ADD_FAILURE() << "taken for a good one";
  } catch (const InputError& e) {
    std::cout << bad.name << ": " << e.what() << '\n';
    acceptance::expect_says(e.what(), bad.says);
    acceptance::expect_says(e.what(), {"the/folder", "run "});
  }
}

TEST(CheckRecording, AGoodOneHasNoLimits) { EXPECT_TRUE(check_recording(good(), "here").empty()); }

TEST(CheckRecording, NamesWhatIsWrong) {
  for (const Bad& bad : bad_recordings()) expect_refused(spoiled(bad), bad);
}

TEST(CheckRecording, NamesWhatIsWrongWithEndPoints) {
  EXPECT_NO_THROW(check_recording(end_points(good()), "here"));
  for (const Bad& bad : bad_end_points()) expect_refused(spoiled(bad, end_points(good())), bad);
}

// A robot that is pushed, hops or stands still is no fault of the recording.
TEST(CheckRecording, RealMishapsAreNoFaultsOfTheRecording) {
  for (const Effect& mishap :
       {testing::effect("push", {{"leg", 2}, {"seconds_into_leg", 2.0}, {"impulse_newton_seconds", 60}}, "cw-1"),
        testing::effect("bump", {{"x_m", 1.0}, {"y_m", -0.17}, {"height_m", 0.012}}),
        testing::effect("encoder_resolution", {{"ticks_per_revolution", 50}}),
        testing::effect("encoder_sampling", {{"interval_s", 0.2}})}) {
    Scenario s = testing::squares(1, 2);
    testing::add_noise(s, 5);
    s.effects = {mishap};
    EXPECT_NO_THROW(check_recording(run_experiment(s, 0).recording, "here")) << mishap.info->name;
  }
}

// A camera's noise makes the way of a slow robot longer, reading by reading, and is no wrong unit.
TEST(CheckRecording, ASlowRobotBeforeANoisyCamera) {
  Scenario s = testing::squares(1, 1);
  s.course.linear_speed_mps = 0.03;
  s.course.side_m = 0.5;
  Recording recording = run_experiment(s, 0).recording;
  recording.truth_position_sd_m = recording.truth_heading_sd_rad = 0.01;
  std::mt19937 bits(1);
  std::normal_distribution<double> noise(0, 0.01);
  every_pose([&](Pose2& p) { p = {p.x_m + noise(bits), p.y_m + noise(bits), p.theta_rad + noise(bits)}; })(recording);
  EXPECT_NO_THROW(check_recording(recording, "here"));
}

// What slips in one run goes and turns as its wheels say in others: its units are right.
TEST(CheckRecording, ARunOnIceIsNoWrongUnit) {
  Recording spins = good();  // by 4 rad, halfway along its first leg
  std::vector<TruthSample>& truth = spins.runs.front().truth;
  const double from_s = 2, takes_s = 2;
  const Pose2 there =
      std::find_if(truth.begin(), truth.end(), [&](const TruthSample& t) { return t.time_s >= from_s; })->X_WB;
  for (TruthSample& t : truth) {
    const double spun_rad = 4 * std::clamp((t.time_s - from_s) / takes_s, 0.0, 1.0);
    if (spun_rad > 0) t.X_WB = there * Pose2{0, 0, spun_rad} * (inverse(there) * t.X_WB);
  }
  EXPECT_NO_THROW(check_recording(spins, "here"));
  const auto halve = [](RecordedRun& run) {
    for (TruthSample& t : run.truth) t.X_WB.x_m /= 2, t.X_WB.y_m /= 2;
  };
  Recording slips = good();
  halve(slips.runs.front());
  EXPECT_NO_THROW(check_recording(slips, "here"));
  for (std::size_t r = 1; r < slips.runs.size(); ++r) halve(slips.runs[r]);
  EXPECT_THROW(check_recording(slips, "here"), InputError);
}

// One intake: whoever measures on a recording refuses it in the same words.
void expect_refused_by_the_program(const Recording& recording, const Bad& bad) {
  SCOPED_TRACE(bad.name);
  const acceptance::Desk desk;
  std::filesystem::create_directory(desk.home / "bad");
  write_recording(recording, desk.home / "bad");
  const acceptance::Outcome diagnosis = desk.umbsim({"gap", "diagnose", "bad", "--out", "d"});
  EXPECT_EQ(diagnosis.code, 2) << diagnosis.err;
  acceptance::expect_says(diagnosis.err, bad.says);
  const acceptance::Outcome calibration = desk.umbsim({"calibrate", "bad", "--out", "d"});
  EXPECT_EQ(calibration.code, 2) << calibration.out;
  EXPECT_EQ(calibration.err, diagnosis.err);
  EXPECT_FALSE(std::filesystem::exists(desk.home / "d"));
}

TEST(CheckRecording, TheProgramRefusesThemAllBeforeItWritesAnything) {
  for (const Bad& bad : bad_recordings()) expect_refused_by_the_program(spoiled(bad), bad);
  for (const Bad& bad : bad_end_points()) expect_refused_by_the_program(spoiled(bad, end_points(good())), bad);
}

TEST(CheckRecording, NoRealRecordingIsRefused) {
  const std::filesystem::path root = std::filesystem::path(UMBSIM_SHARED_DIR) / "recordings";
  if (!std::filesystem::is_directory(root)) GTEST_SKIP() << root << " is not here";
  int taken_in = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().filename() != "recording.yaml") continue;
    EXPECT_NO_THROW(take_in(entry.path().parent_path().string())) << entry.path();
    ++taken_in;
  }
  EXPECT_GT(taken_in, 20);
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
  says(end_points(good()), "end points only");
  Recording far = end_points(good());
  far.runs[0].truth[1].X_WB.x_m += 3;
  says(far, "are the units right?");
  Recording half = good();
  half.runs[1].truth.resize(half.runs[1].truth.size() * 6 / 10);
  says(half, "of the way only");
}

}  // namespace
}  // namespace umbsim::intake

#include "gap/trial/write/generate.h"

#include <gmock/gmock.h>

#include <atomic>
#include <set>

#include "core/error.h"
#include "gap/trial/write/even_tables.h"
#include "gap/trial/write/seal.h"
#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

const TrialSimulator kSimulator = fake_simulator;

GenerateResult generate(const fs::path& folder, const TrialPlan& plan = small_plan(), Shard shard = {}, int jobs = 1) {
  return generate_trial(plan, TrialFolder(folder), kSimulator, shard, jobs);
}

TEST(Generate, WritesOneRecordingForEachCaseAndSealsTheAnswers) {
  const Folder folder;
  const GenerateResult result = generate(folder.path / "t");
  EXPECT_EQ(result.cases, 17u);
  EXPECT_EQ(result.finished, 17u);
  const TrialFolder trial(folder.path / "t");
  ASSERT_TRUE(result.seal.has_value());
  EXPECT_EQ(*result.seal, sha256(text_of(trial.answers())));
  EXPECT_EQ(text_of(trial.seal()), *result.seal + "  answers.json\n");
  EXPECT_FALSE(fs::exists(trial.answer_parts()));
  const Answers answers = read_answers(trial.answers());
  std::map<Tier, int> tiers;
  for (const CaseEntry& entry : read_case_entries(trial)) {
    const Recording recording = read_recording(trial.recordings() / entry.name);
    const Answer& answer = answers.at(entry.name);
    ++tiers[answer.tier];
    EXPECT_EQ(recording.runs.size(), answer.tier == Tier::poor_runs ? 4u : 12u);
    EXPECT_EQ(recording.truth_kind, answer.tier == Tier::end_points ? "endpoints" : "track");
    EXPECT_EQ(entry.excluded, answer.excluded);
  }
  EXPECT_EQ(tiers, (std::map<Tier, int>{{Tier::no_effect, 3}, {Tier::single, 6}, {Tier::pairs, 2}, {Tier::outside, 2},
                                       {Tier::end_points, 2}, {Tier::poor_runs, 2}}));
}

TEST(Generate, TheSameBytesForAnyNumberOfJobs) {
  const Folder folder;
  generate(folder.path / "one", small_plan(), {}, 1);
  generate(folder.path / "four", small_plan(), {}, 4);
  EXPECT_EQ(files_of(folder.path / "one"), files_of(folder.path / "four"));
}

TEST(Generate, ShardsTogetherAreTheWhole) {
  const Folder folder;
  generate(folder.path / "whole");
  for (int i = 0; i < 3; ++i) {
    const GenerateResult part = generate(folder.path / "parts", small_plan(), {i, 3});
    EXPECT_EQ(part.seal.has_value(), i == 2) << "sealed when the last case stands, not before";
  }
  EXPECT_EQ(files_of(folder.path / "whole"), files_of(folder.path / "parts"));
}

TEST(Generate, GoesOnWhereItStopped) {
  const Folder folder;
  generate(folder.path / "whole");
  // Stops in the middle: the simulator fails after some drives.
  std::atomic<int> drives{0};
  const TrialSimulator failing = [&](const TrialDrive& drive) {
    if (++drives > 60) throw InputError("the disk is full");
    return fake_simulator(drive);
  };
  const TrialFolder trial(folder.path / "stopped");
  EXPECT_THROW(generate_trial(small_plan(), trial, failing, {}, 1), InputError);
  const std::size_t finished = std::size_t(std::distance(fs::directory_iterator(trial.recordings()), {}));
  ASSERT_GT(finished, 0u);
  ASSERT_LT(finished, 17u);
  EXPECT_FALSE(fs::exists(trial.answers()));
  std::map<std::string, fs::file_time_type> before;
  for (const auto& entry : fs::directory_iterator(trial.recordings())) {
    std::ofstream(entry.path() / "mark") << "kept";
    before[entry.path().filename().string()] = {};
  }
  EXPECT_EQ(generate(trial.root).finished, 17u);
  for (const auto& [name, time] : before) {
    EXPECT_TRUE(fs::remove(trial.recordings() / name / "mark")) << name << " was made again";
  }
  EXPECT_EQ(files_of(trial.root), files_of(folder.path / "whole"));
}

TEST(Generate, AnotherTrialIsNotWrittenIntoTheSameFolder) {
  const Folder folder;
  generate(folder.path / "t");
  TrialPlan other = small_plan();
  other.seed = 12;
  EXPECT_THROW(generate(folder.path / "t", other), InputError);
  folder.write("mine/letter.txt", "not a trial");
  EXPECT_THROW(generate(folder.path / "mine"), InputError);
}

// What a look at folders and headers tells, without reading ticks and poses.
TEST(Secrecy, NamesTimesAndHeadersAreTheSameWhateverTheEffect) {
  const Folder folder;
  TrialPlan plan = small_plan();
  plan.cases = {4, 8, 4, 4, 0, 0};
  plan.platforms.count = 1;
  plan.noise.level = {1, 1};
  generate(folder.path / "t", plan);
  const TrialFolder trial(folder.path / "t");
  std::set<std::string> headers;
  std::set<std::set<std::string>> layouts;
  std::set<fs::file_time_type> times;
  for (const CaseEntry& entry : read_case_entries(trial)) {
    const fs::path recording = trial.recordings() / entry.name;
    std::set<std::string> layout;
    times.insert(fs::last_write_time(recording));
    for (const auto& file : fs::recursive_directory_iterator(recording)) {
      layout.insert(fs::relative(file.path(), recording).string());
      times.insert(fs::last_write_time(file.path()));
    }
    layouts.insert(layout);
    headers.insert(text_of(recording / "recording.yaml") + text_of(recording / kTrialUrdf));
  }
  EXPECT_EQ(headers.size(), 1u);
  EXPECT_EQ(layouts.size(), 1u);
  EXPECT_EQ(times.size(), 1u);
}

TEST(Secrecy, OutsideTheAnswersNothingSaysWhichCaseIsWhich) {
  const Folder folder;
  generate(folder.path / "t");
  const TrialFolder trial(folder.path / "t");
  for (const auto& [name, text] : files_of(trial.root)) {
    if (name == "answers.json" || name == "trial.yaml") continue;
    for (const char* hint : {"wheelbase:", "severity", "tier", "no_effect", "undetectable", "seed"}) {
      EXPECT_EQ(text.find(hint), std::string::npos) << name << " says " << hint;
    }
  }
}

TEST(Secrecy, AFilesSizeTellsItsRowsAndNothingElse) {
  const Folder folder;
  TrialPlan plan = small_plan();
  plan.platforms.count = 1;
  plan.cases = {3, 6, 0, 0, 0, 0};
  generate(folder.path / "t", plan);
  const TrialFolder trial(folder.path / "t");
  std::set<std::uintmax_t> encoders, truth;
  for (const CaseEntry& entry : read_case_entries(trial)) {
    const fs::path run = trial.recordings() / entry.name / "runs" / "cw-1";
    encoders.insert(fs::file_size(run / "encoders.csv"));
    truth.insert(fs::file_size(run / "truth.csv"));
  }
  EXPECT_EQ(encoders.size(), 1u);
  EXPECT_EQ(truth.size(), 1u);
}

TEST(Secrecy, FilledUpNumbersReadBackAsTheSameValues) {
  const Folder folder;
  Recording recording = planned_recording(small_plan(), draw_platform(small_plan(), 0), {{"a", "cw"}});
  recording.runs[0].has_commands = true;
  recording.runs[0].encoders = {{0, 0, 0, 0, 0}, {0.02, -12, 123456, -1.5, 0.000012345}};
  recording.runs[0].truth = {{0, {}}, {0.02, {-3.25, 1e-9, -6.283185307}}};
  write_recording(recording, folder.path);
  const Recording plain = read_recording(folder.path);
  write_even_tables(recording, folder.path);
  const Recording even = read_recording(folder.path);
  for (std::size_t i = 0; i < 2; ++i) {
    const EncoderSample &a = plain.runs[0].encoders[i], &b = even.runs[0].encoders[i];
    EXPECT_EQ(a.left_ticks, b.left_ticks);
    EXPECT_EQ(a.right_ticks, b.right_ticks);
    EXPECT_EQ(a.left_command_radps, b.left_command_radps);
    EXPECT_EQ(a.right_command_radps, b.right_command_radps);
    const TruthSample &c = plain.runs[0].truth[i], &d = even.runs[0].truth[i];
    EXPECT_EQ(c.X_WB.x_m, d.X_WB.x_m);
    EXPECT_EQ(c.X_WB.y_m, d.X_WB.y_m);
    EXPECT_EQ(c.X_WB.theta_rad, d.X_WB.theta_rad);
  }
}

// A coarse encoder must not show in the header: see drive_planned_runs.
TEST(Secrecy, TheHeaderHoldsTheTicksThatTheExperimenterBelievesIn) {
  const Folder folder;
  TrialPlan plan = small_plan();
  plan.effects = {&find_effect("encoder_resolution")};
  plan.cases = {2, 2, 0, 0, 0, 0};
  plan.platforms.count = 1;
  generate(folder.path / "t", plan);
  const TrialFolder trial(folder.path / "t");
  for (const CaseEntry& entry : read_case_entries(trial)) {
    EXPECT_EQ(read_recording(trial.recordings() / entry.name).robot.ticks_per_revolution,
              draw_platform(plan, 0).ticks_per_revolution);
  }
}

TEST(Seal, Sha256OfKnownTexts) {
  // FIPS 180-4, examples of NIST.
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Seal, ChangedAnswersAreRefused) {
  const Folder folder;
  const TrialFolder trial(folder.path);
  seal_answers(trial, "{}\n");
  EXPECT_TRUE(check_seal(trial.answers(), read_seal(trial)));
  EXPECT_FALSE(check_seal(trial.answers(), std::nullopt));
  folder.write("answers.json", "{} \n");
  EXPECT_THROW(check_seal(trial.answers(), read_seal(trial)), InputError);
}

TEST(Shards, AreParsedStrictly) {
  EXPECT_EQ(parse_shard("2/8").index, 1);  // from 0
  for (const char* wrong : {"", "2", "0/3", "4/3", "1/0", "a/b", "1/2x", "-1/2"}) {
    EXPECT_THROW(parse_shard(wrong), InputError) << wrong;
  }
}

TEST(WriteFileWhole, TakesANameWithoutAFolder) {
  const Folder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path);
  EXPECT_NO_THROW(write_file_whole("table.txt", "effects\n"));
  fs::current_path(before);
  EXPECT_EQ(text_of(folder.path / "table.txt"), "effects\n");
}

}  // namespace
}  // namespace umbsim::trial_testing

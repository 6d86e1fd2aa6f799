#include "gap/trial/score/leaks.h"

#include "gap/trial/write/generate.h"
#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

constexpr double kSurely = 0.01;
constexpr int kLabels = 5;
constexpr int kCases = 100;

std::vector<std::string> labels() {
  std::vector<std::string> all;
  for (int i = 0; i < kCases; ++i) all.push_back(std::string(1, char('a' + i % kLabels)));
  return all;
}

std::vector<std::vector<double>> noise_features() {
  RandomStream random(1, "features");
  std::vector<std::vector<double>> features(kCases, std::vector<double>(6));
  for (auto& f : features) {
    for (double& v : f) v = random.normal();
  }
  return features;
}

TEST(MetadataLeak, NoiseIsGuessedAtChance) {
  const LeakFigure leak = metadata_leak(noise_features(), labels());
  EXPECT_NEAR(leak.chance, 1.0 / kLabels, 0.02);
  EXPECT_GT(leak.p_value, kSurely);
}

// The test of the test: one feature of six, in units of its own, tells the label most of the time.
TEST(MetadataLeak, APlantedLeakIsFound) {
  auto features = noise_features();
  for (int i = 0; i < kCases; ++i)
    features[std::size_t(i)][3] = 1e6 * (i % kLabels) + 1e5 * features[std::size_t(i)][3];
  const LeakFigure leak = metadata_leak(features, labels());
  EXPECT_GT(leak.accuracy, 2.0 / kLabels);
  EXPECT_LT(leak.p_value, kSurely);
}

TEST(MetadataLeak, SeesSizesRowsNamesAndTimes) {
  const Folder folder;
  const auto recording = [&](const std::string& name, const std::string& rows, int hours) {
    folder.write(name + "/runs/cw-1/encoders.csv", rows);
    folder.write(name + "/recording.yaml", "format");
    const auto time = fs::file_time_type::clock::now() + std::chrono::hours(hours);
    for (const auto& entry : fs::recursive_directory_iterator(folder.path / name))
      fs::last_write_time(entry.path(), time);
    fs::last_write_time(folder.path / name, time);
    return metadata(folder.path / name);
  };
  const std::vector<double> plain = recording("aa", "1,2\n3,4\n", 0);
  const auto differ = [&](const std::vector<double>& other) {
    int count = 0;
    for (std::size_t k = 0; k < plain.size(); ++k) count += plain[k] != other[k];
    return count;
  };
  fs::remove_all(folder.path / "aa");
  EXPECT_GE(differ(recording("aa", "1,2\n3,4\n5,6\n", 0)), 3) << "a row more";
  fs::remove_all(folder.path / "aa");
  EXPECT_GE(differ(recording("aa", "1,2\n3,45\n", 0)), 2) << "a digit more";
  EXPECT_GE(differ(recording("b", "1,2\n3,4\n", 5)), 4) << "another name and time";
}

TEST(ShuffledLabels, AGoodDiagnosisStandsOutAndABadOneDoesNot) {
  const std::vector<std::string> truths = labels();
  const LeakFigure good = shuffled_labels(truths, truths);
  EXPECT_EQ(good.accuracy, 1);
  EXPECT_NEAR(good.chance, 1.0 / kLabels, 0.02) << "with shuffled answers it is at chance";
  EXPECT_LT(good.p_value, kSurely);
  const LeakFigure bad = shuffled_labels(truths, std::vector<std::string>(kCases, "a"));
  EXPECT_NEAR(bad.accuracy, bad.chance, 1e-9);
  EXPECT_GT(bad.p_value, kSurely);
}

// A generated trial in which nothing but ticks and poses differs: tests/acceptance does the same with the simulator.
TEST(MetadataLeak, AGeneratedTrialIsGuessedAtChance) {
  const Folder folder;
  TrialPlan plan = small_plan();
  plan.cases = {20, 40, 0, 0, 0, 0};
  const TrialFolder trial(folder.path / "t");
  generate_trial(plan, trial, fake_simulator, {}, 1);
  const Answers answers = read_answers(trial.answers());
  std::vector<std::vector<double>> features;
  std::vector<std::string> truths;
  for (const auto& [name, answer] : answers) {
    features.push_back(metadata(trial.recordings() / name));
    truths.push_back(answer.effects.empty() ? "none" : answer.effects.begin()->first);
  }
  EXPECT_GT(metadata_leak(features, truths).p_value, kSurely);
}

}  // namespace
}  // namespace umbsim::trial_testing

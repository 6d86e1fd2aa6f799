// What is learned of the errors of signatures from cases whose errors are known.
#include "bench/worlds/learn/learn.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>

#include "bench/worlds/draw/draw.h"
#include "core/text/text_file.h"

namespace umbsim::worlds {
namespace {

constexpr std::array<double, gap::kCourseParts + 1> kTrue{0.06, 0.6, 0.1, 0.2, 0.3};
constexpr double kSeen = 0.02;  // with which each share is seen

// A case in which every part has four pieces, off by what is drawn.
CaseShares drawn_case(std::mt19937_64& random) {
  CaseShares c{"case", "backlash", "planar", {}};
  gap::SignatureShares s;
  std::normal_distribution<double> unit;
  std::vector<double> seen;
  for (std::size_t part = 0; part < kTrue.size(); ++part) {
    for (int piece = 0; piece < 4; ++piece) {
      s.part.push_back(part);
      seen.push_back(kTrue[part] * unit(random) + kSeen * unit(random));
    }
  }
  const Eigen::Index n = Eigen::Index(seen.size());
  s.precision = Eigen::MatrixXd::Identity(n, n) / (kSeen * kSeen);
  s.pull = s.precision * Eigen::Map<Eigen::VectorXd>(seen.data(), n);
  for (std::size_t j = 0; j < kMotions.size(); ++j) {
    c.by_motion.push_back(s);
    c.by_motion.back().log_density = -(j == 2 ? 0 : 10);  // the third is likeliest
  }
  return c;
}

TEST(Learned, FindsTheErrorsThatCasesWereDrawnWith) {
  std::mt19937_64 random(5);
  std::vector<CaseShares> cases;
  for (int i = 0; i < 50; ++i) cases.push_back(drawn_case(random));
  const LearnedErrors found = learned(cases);
  std::array<double, kTrue.size()> sd{};
  for (std::size_t k = 0; k < gap::kCourseParts; ++k) sd[k] = found.errors.parts[k];
  sd.back() = found.errors.counts;
  for (std::size_t k = 0; k < kTrue.size(); ++k) {
    std::printf("%.3f, drawn with %.3f\n", sd[k], kTrue[k]);
    EXPECT_EQ(sd[k], kTrue[k]);
  }
  EXPECT_EQ(found.errors.motion, kMotions[2]);
  EXPECT_EQ(found.cases, 50u);
  EXPECT_GT(found.gain, 0);
}

TEST(Learned, SaysATenthWhereTheDataSayNothing) {
  std::mt19937_64 random(5);
  std::vector<CaseShares> cases{drawn_case(random)};
  for (gap::SignatureShares& s : cases[0].by_motion) {
    s.precision.setZero();
    s.pull.setZero();
  }
  for (const double sd : learned(cases).errors.parts) EXPECT_EQ(sd, 0.1);
}

TEST(CaseShares, AreTheSameAfterTheyWereWritten) {
  std::mt19937_64 random(5);
  const CaseShares before = drawn_case(random);
  const CaseShares after = read_shares(Json::parse(shares_json(before).dump()));
  EXPECT_EQ(after.effect, before.effect);
  EXPECT_EQ(after.engine, before.engine);
  ASSERT_EQ(after.by_motion.size(), before.by_motion.size());
  EXPECT_EQ(after.by_motion[1].part, before.by_motion[1].part);
  EXPECT_EQ(after.by_motion[1].pull, before.by_motion[1].pull);
  EXPECT_EQ(after.by_motion[1].precision, before.by_motion[1].precision);
  EXPECT_EQ(after.by_motion[1].log_density, before.by_motion[1].log_density);
}

// A push, while motors that are asked for too much are being looked at. The third case, a wrong radius, only rolls.
TEST(CaseShares, OfARecordingThatADiagnosisRefusesAreLeftOut) {
  const ScratchFolder scratch;
  write_text_file(scratch.path() / "worlds.yaml",
                  "format: umbsim-worlds/1\nname: learn\nseed: 10\nengines: [planar]\nruns: [plain_2]\n"
                  "drivers: [own]\ntrackers: [mocap]\ncases_per_engine: {single: 3}\n");
  const TrialFolder folder(scratch.path() / "worlds");
  draw_worlds(read_worlds((scratch.path() / "worlds.yaml").string()), folder, {0, 1}, 2);
  for (const auto& [name, answer] : read_answers(folder.answers())) {
    if (answer.effects.count("push") > 0)
      write_text_file(folder.recordings() / name / "recording.yaml", "format: umbsim-recording/1\n");
  }
  const SharesFound found = look_at_cases(folder, 2);
  EXPECT_EQ(found.refused, 1);
  ASSERT_EQ(found.cases.size(), 1u);
  EXPECT_EQ(found.cases[0].effect, "over_acceleration");
}

}  // namespace
}  // namespace umbsim::worlds

// Worlds from a seed: the same bytes on any number of threads, in any shards, after an interruption; and headers that
// say nothing of the effect.
#include "bench/worlds/draw/draw.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/error.h"
#include "core/text/text_file.h"
#include "gap/trial/write/answers.h"
#include "gap/trial/write/seal.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

using Bytes = std::map<std::string, std::string>;

Bytes bytes_of(const fs::path& folder) {
  Bytes bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      bytes[fs::relative(entry.path(), folder).string()] = read_text_file(entry.path(), std::size_t(1) << 30);
  }
  return bytes;
}

WorldsPlan plan_of(const std::string& text) {
  const ScratchFolder scratch;
  write_text_file(scratch.path() / "worlds.yaml", text);
  return read_worlds((scratch.path() / "worlds.yaml").string());
}

const std::string kShort =
    "format: umbsim-worlds/1\nname: short\nseed: 7\nengines: [ours]\nruns: [one_way]\ndrivers: [own, heading]\n"
    "trackers: [mocap, camera]\n";

Bytes drawn(const WorldsPlan& plan, const std::vector<Shard>& shards, int jobs) {
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "worlds");
  for (const Shard& shard : shards) draw_worlds(plan, folder, shard, jobs);
  EXPECT_TRUE(read_seal(folder).has_value());
  return bytes_of(folder.root);
}

TEST(Draw, TheSameBytesOnAnyNumberOfThreadsAndInAnyShards) {
  const WorldsPlan plan = plan_of(kShort + "cases_per_engine: {none: 1, single: 1, pair: 1, outside: 1}\n");
  const Bytes once = drawn(plan, {{0, 1}}, 1);
  EXPECT_GT(once.size(), 4 * 10u);
  EXPECT_EQ(drawn(plan, {{0, 1}}, 2), once);
  EXPECT_EQ(drawn(plan, {{1, 2}, {0, 2}}, 2), once);
}

TEST(Draw, GoesOnWhereItWasStopped) {
  const WorldsPlan plan = plan_of(kShort + "cases_per_engine: {none: 2, single: 1}\n");
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "worlds");
  EXPECT_FALSE(draw_worlds(plan, folder, {0, 2}, 1).seal);
  const DrawResult rest = draw_worlds(plan, folder, {0, 1}, 1);
  EXPECT_EQ(rest.drawn_now, 1u);  // the other two stand
  EXPECT_TRUE(rest.seal);
  EXPECT_EQ(bytes_of(folder.root), drawn(plan, {{0, 1}}, 1));
  EXPECT_EQ(draw_worlds(plan, folder, {0, 1}, 1).drawn_now, 0u);
}

TEST(Draw, AnotherPlanIsRefused) {
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "worlds");
  draw_worlds(plan_of(kShort + "cases_per_engine: {none: 1}\n"), folder, {0, 1}, 1);
  EXPECT_THROW(draw_worlds(plan_of(kShort + "cases_per_engine: {none: 2}\n"), folder, {0, 1}, 1), InputError);
}

// The same world without a fault, with one of the catalogue and with one outside it: all that is not data is the same.
TEST(Draw, HeaderAndSizesSayNothingOfTheEffect) {
  std::vector<DrawnCase> cases;
  for (const char* kind : {"none", "single", "outside", "pair"}) {
    const WorldsPlan plan = plan_of(kShort + "cases_per_engine: {" + kind + ": 1}\n");
    cases.push_back(draw_case(plan, world_cases(plan).front()));
  }
  const ScratchFolder scratch;
  std::vector<std::string> headers;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const fs::path folder = scratch.path() / std::to_string(i);
    fs::create_directories(folder);
    ASSERT_EQ(cases[i].worlds_redrawn, 0) << "another seed is needed: the worlds are not the same";
    write_recording(cases[i].recording, folder);
    headers.push_back(read_text_file(folder / "recording.yaml", 1 << 20));
    EXPECT_EQ(headers[i], headers[0]);
    for (std::size_t run = 0; run < cases[i].recording.runs.size(); ++run) {
      EXPECT_EQ(cases[i].recording.runs[run].encoders.size(), cases[0].recording.runs[run].encoders.size());
      EXPECT_EQ(cases[i].recording.runs[run].truth.size(), cases[0].recording.runs[run].truth.size());
    }
  }
}

// A handful of worlds from every engine of this build: each can be read, has a sealed answer and says what it cost.
// Drawn again, with other threads and shards, it is the same to the byte.
TEST(Draw, EveryEngineIsReadSealedAndTheSameAgain) {
  const WorldsPlan plan = plan_of(
      "format: umbsim-worlds/1\nname: handful\nseed: 5\nruns: [one_way]\ndrivers: [own, heading]\n"
      "cases_per_engine: {single: 1, outside: 1}\n");
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "worlds");
  const DrawResult result = draw_worlds(plan, folder, {0, 1}, 1);
  EXPECT_EQ(result.finished, 2 * engines().size());
  const Json answers = read_json(folder.answers()).at("cases");
  for (const CaseEntry& entry : read_case_entries(folder)) {
    const Recording r = read_recording(folder.recordings() / entry.name);
    EXPECT_EQ(r.runs.size(), 4u);
    const Json& world = answers.at(entry.name).at("world");
    EXPECT_GT(world.at("steps").get<double>(), 0);
    for (const char* key : {"engine", "driver", "tracker", "runs", "robot"}) EXPECT_TRUE(world.contains(key)) << key;
  }
  EXPECT_EQ(read_answers(folder.answers()).size(), result.cases);
  EXPECT_EQ(drawn(plan, {{1, 2}, {0, 2}}, 2), bytes_of(folder.root));
}

TEST(Plan, UnknownNamesAndKeysAreRefusedWithTheChoices) {
  const auto message = [](const std::string& text) {
    try {
      plan_of(text);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string base = "format: umbsim-worlds/1\ncases_per_engine: {none: 1}\n";
  EXPECT_NE(message(base + "drivers: [autopilot]\n").find("pursuit"), std::string::npos);
  EXPECT_NE(message(base + "engine: [ours]\n").find("engine"), std::string::npos);
  EXPECT_NE(message("format: umbsim-worlds/1\ncases_per_engine: {none: -1}\n").find(">= 0"), std::string::npos);
  EXPECT_EQ(message(base), "");
  EXPECT_EQ(message(resolved_worlds(plan_of(base))), "");
}

TEST(Plan, EffectsTakeTurns) {
  const WorldsPlan plan = plan_of("format: umbsim-worlds/1\nengines: [ours]\ncases_per_engine: {single: " +
                                  std::to_string(catalogue().size()) + ", triple: 5}\n");
  std::map<std::string, int> count;
  for (const WorldCase& c : world_cases(plan)) {
    const std::vector<std::string> faults = fault_names(plan, c);
    EXPECT_EQ(faults.size(), c.kind == CaseKind::triple ? 3u : 1u);
    EXPECT_EQ(std::set<std::string>(faults.begin(), faults.end()).size(), faults.size());
    if (c.kind == CaseKind::single) ++count[faults.front()];
  }
  EXPECT_EQ(count.size(), catalogue().size());
}

}  // namespace
}  // namespace umbsim::worlds

// Cases that are listed: the same bytes however they are drawn, the effect that the list names, and lists that are
// refused with file, line, key, value and bound.
#include "bench/worlds/draw/worlds_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/error.h"
#include "core/text/text_file.h"
#include "gap/trial/draw/severity.h"
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

WorldsList list_of(const std::string& text) {
  const ScratchFolder scratch;
  write_text_file(scratch.path() / "list.yaml", text);
  return read_worlds_list((scratch.path() / "list.yaml").string());
}

std::string message(const std::string& text) {
  try {
    list_of(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

const std::string kPlatforms =
    "platforms:\n"
    "  small:\n"
    "    robot: {wheel_radius_m: 0.045, wheelbase_m: 0.26, base_mass_kg: 12, caster_ahead_m: 0.17,"
    " mass_centre_ahead_m: 0.045, mass_centre_height_m: 0.03}\n"
    "    ticks_per_revolution: 4000\n"
    "    path: {side_m: 1, linear_speed_mps: 0.3, angular_speed_radps: 0.8}\n";

std::string text_of(const std::string& engine, const std::string& cases) {
  return "format: umbsim-worlds-list/1\nname: short\nseed: 3\n" + engine + "runs: plain_2\n" + kPlatforms + "cases:\n" +
         cases;
}

const std::string kCases =
    "  - {name: nothing, platform: small}\n"
    "  - {name: scale, platform: small, effects: {wheel_radius_scale: {relative: 0.02}}}\n"
    "  - {name: hidden, platform: small, effects: {wheelbase: {relative: 0.02}}, excluded: [wheelbase]}\n"
    "  - {name: wobble, platform: small, outside: {bent_axle: {relative: 0.01, wheel: 1}}}\n";

Bytes drawn(const WorldsList& list, const std::vector<Shard>& shards, int jobs) {
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "worlds");
  for (const Shard& shard : shards) draw_all(source_of(list), folder, shard, jobs);
  EXPECT_TRUE(read_seal(folder).has_value());
  return bytes_of(folder.root);
}

TEST(WorldsList, TheSameBytesOnAnyNumberOfThreadsAndInAnyShards) {
  const WorldsList list = list_of(text_of("engine: ours\n", kCases));
  const Bytes once = drawn(list, {{0, 1}}, 1);
  EXPECT_GT(once.size(), 4 * 10u);
  EXPECT_EQ(drawn(list, {{0, 1}}, 2), once);
  EXPECT_EQ(drawn(list, {{1, 2}, {0, 2}}, 2), once);
}

// Commands are obeyed by wheels 2 % larger: the true way of a leg is 2 % longer than its counts say.
TEST(WorldsList, TheEffectIsThatOfTheListAndItsAnswerIsSealed) {
  const WorldsList list = list_of(text_of("engine: ours\n", kCases));
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "worlds");
  draw_all(source_of(list), folder, {0, 1}, 2);
  const Json cases = read_json(folder.answers()).at("cases");
  std::map<std::string, std::string> tiers, names;
  for (const auto& [name, answer] : cases.items()) {
    const std::string given = answer.at("world").at("listed");
    names[given] = name;
    tiers[given] = answer.at("tier");
    EXPECT_NE(name, given) << "names give nothing away";
  }
  EXPECT_EQ(tiers["nothing"], "no_effect");
  EXPECT_EQ(tiers["scale"], "single");
  EXPECT_EQ(tiers["hidden"], "outside");
  EXPECT_EQ(tiers["wobble"], "outside");
  EXPECT_EQ(cases.at(names["scale"]).at("effects").at("wheel_radius_scale").at("relative"), 0.02);
  EXPECT_GT(cases.at(names["scale"]).at("severities").at("wheel_radius_scale").at("severity"), 1.0);
  const auto first_leg_m = [&](const char* given) {  // the first run turns right: nothing lies ahead of its first leg
    const Recording r = read_recording(folder.recordings() / names[given]);
    double most = 0;
    for (const TruthSample& t : r.runs.front().truth) most = std::max(most, t.X_WB.x_m);
    return most;
  };
  EXPECT_NEAR(first_leg_m("nothing"), 1, 0.003);
  EXPECT_NEAR(first_leg_m("scale"), 1.02, 0.003);
  EXPECT_EQ(read_answers(folder.answers()).size(), 4u);
  // What stands in the folder says nothing of the effects.
  EXPECT_EQ(read_text_file(folder.root / "worlds.yaml", 1 << 20).find("wheel"), std::string::npos);
}

TEST(WorldsList, AnotherListIsRefused) {
  const ScratchFolder scratch;
  const TrialFolder folder(scratch.path() / "worlds");
  const std::string one = "  - {name: nothing, platform: small}\n";
  const WorldsList list = list_of(text_of("engine: planar\n", one));
  draw_all(source_of(list), folder, {0, 1}, 1);
  const WorldsList other = list_of(text_of("engine: planar\n", one + "  - {name: more, platform: small}\n"));
  EXPECT_THROW(draw_all(source_of(other), folder, {0, 1}, 1), InputError);
  EXPECT_EQ(draw_all(source_of(list), folder, {0, 1}, 1).drawn_now, 0u);
}

TEST(WorldsList, BadListsAreRefusedWithFileLineKeyValueAndBound) {
  struct Bad {
    std::string engine, cases;
    std::vector<std::string> says;
  };
  const std::string good = "  - {name: a, platform: small}\n";
  const auto with = [](const std::string& effects) { return "  - {name: a, platform: small, " + effects + "}\n"; };
  const std::vector<Bad> bad = {
      {"engine: ode\n", good, {"list.yaml:4:", "engine", "ode", "bullet"}},
      {"engine: ours\noptions: {step_s: 2}\n", good, {"list.yaml:5:", "options.step_s", "2", "0.02"}},
      {"engine: ours\noptions: {cone: flat}\n", good, {"list.yaml:5:", "options.cone", "fine_step_s"}},
      {"engine: bullet\noptions: {solver: pgs}\n", good, {"options.solver", "pgs", "dantzig"}},
      {"engine: ours\ndriver: {rate_hz: 0}\n", good, {"driver.rate_hz", "0", "5"}},
      {"engine: ours\nnoise: {radius_scatter: -1}\n", good, {"noise.radius_scatter", "-1", "0"}},
      {"engine: ours\n", "  - {name: a, platform: huge}\n", {"list.yaml:12:", "cases[0].platform", "huge", "small"}},
      {"engine: ours\n", good + good, {"list.yaml:13:", "cases[1].name", "twice"}},
      {"engine: ours\n", with("effects: {square_wheels: {}}"), {"list.yaml:12:", "effects.square_wheels"}},
      {"engine: ours\n",
       with("effects: {wheelbase: {relative: 9}}"),
       {"list.yaml:12:", "effects.wheelbase.relative", "9", "<= "}},
      {"engine: ours\n",
       with("effects: {push: {run: cw-7, leg: 1, impulse_newton_seconds: 2}}"),
       {"effects.push.run", "cw-7", "ccw-2"}},
      {"engine: bullet\n", with("effects: {contact_patch: {width_m: 0.01}}"), {"contact_patch", "bullet"}},
      {"engine: ours\n", with("outside: {gremlins: {}}"), {"outside.gremlins", "bent_axle"}},
      {"engine: ours\n", with("outside: {bent_axle: {relative: -1}}"), {"outside.bent_axle.relative", "-1", "> 0"}},
      {"engine: ours\n", with("excluded: [tyres]"), {"excluded[0]", "tyres"}},
  };
  for (const Bad& b : bad) {
    const std::string text = message(text_of(b.engine, b.cases));
    for (const std::string& part : b.says) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  }
  EXPECT_EQ(message(text_of("engine: ours\n", good)), "");
}

// The list that came with the project, in the engine that it was made for.
TEST(WorldsList, TheListOfSixtySevenCasesIsComplete) {
  bool mujoco = false;
  for (const EngineKind& kind : engines()) mujoco = mujoco || kind.name == "mujoco";
  if (!mujoco) GTEST_SKIP() << "this build has no MuJoCo (libmujoco-dev)";
  const WorldsList list = read_worlds_list(UMBSIM_WORLDS_LISTS_DIR "/mujoco_67.yaml");
  EXPECT_EQ(list.worlds.size(), 6u);
  EXPECT_EQ(list.cases.size(), 67u);
  std::map<std::size_t, int> by_effects;
  for (const ListedCase& c : list.cases) ++by_effects[c.faults.effects.size()];
  EXPECT_EQ(by_effects, (std::map<std::size_t, int>{{0, 6}, {1, 51}, {2, 10}}));
  const Recording& r = list.worlds.at("labmate").runs.recording;
  EXPECT_EQ(r.runs.size(), 12u);
  EXPECT_EQ(r.truth_position_sd_m, 0.0003);
  for (const RecordedRun& run : r.runs) {
    EXPECT_EQ(run.turn_radius_m.value_or(0.4), 0.4);
    EXPECT_EQ(run.payload_kg.value_or(15), 15);
  }
}

}  // namespace
}  // namespace umbsim::worlds

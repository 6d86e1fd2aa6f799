// docs/scenario.md says what read_scenario does.
#include "experiment/scenario/scenario.h"
#include "experiment/sweep/sweep.h"
#include "tests/acceptance/markdown.h"
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

const std::string kScenarioPage = std::string(UMBSIM_SOURCE_DIR) + "/docs/scenario.md";

bool is_whole(const std::string& block) { return block.rfind("format:", 0) == 0; }

Scenario read(const Desk& desk, const std::string& text) {
  return read_scenario(desk.put("example.yaml", text).string());
}

TEST(ScenarioDocument, EveryExampleIsAccepted) {
  const Desk desk;
  const std::vector<std::string> blocks = fenced_blocks(kScenarioPage, "yaml");
  ASSERT_GE(blocks.size(), 2u);
  for (const std::string& block : blocks) {
    SCOPED_TRACE(block);
    EXPECT_NO_THROW(read(desk, is_whole(block) ? block : "format: umbsim-scenario/1\n" + block));
  }
}

// The first whole example shows every key at its default.
TEST(ScenarioDocument, TheCompleteExampleShowsTheDefaults) {
  const Desk desk;
  for (const std::string& block : fenced_blocks(kScenarioPage, "yaml")) {
    if (!is_whole(block)) continue;
    Scenario shown = read(desk, block), defaults = read(desk, "format: umbsim-scenario/1\n");
    shown.name = defaults.name;
    shown.description = defaults.description;
    shown.effects.clear();
    shown.odometry = {};
    shown.bumps = {};
    EXPECT_EQ(resolved_yaml(shown), resolved_yaml(defaults));
    return;
  }
  FAIL() << "no complete example";
}

using Keys = std::set<std::string>;

/// Every key of a map, with the keys above it: course.side_m.
void collect(const YAML::Node& node, const std::string& above, Keys& keys) {
  for (const auto& entry : node) {
    const std::string key = above + entry.first.Scalar();
    if (key == "effects") continue;
    if (entry.second.IsMap() && entry.second.size() > 0)
      collect(entry.second, key + ".", keys);
    else
      keys.insert(key);
  }
}

TEST(ScenarioDocument, NamesEveryKeyThatTheProgramWrites) {
  const Desk desk;
  const Scenario s = read(desk,
                          "format: umbsim-scenario/1\nbumps: {count: 1}\n"
                          "odometry: {left_radius_m: 1, right_radius_m: 1, wheelbase_m: 1}\n"
                          "noise: {wheel_noise_m_per_sqrt_m: 0.001}\n"
                          "uncertainty: {left_m_per_sqrt_m: 0.001, right_m_per_sqrt_m: 0.001}\n"
                          "fixes: [{leg: 1}]\n");
  Keys keys;
  collect(YAML::Load(resolved_yaml(s)), "", keys);
  ASSERT_GT(keys.size(), 40u);
  const std::string text = text_of(kScenarioPage);
  for (const std::string& key : keys) {
    EXPECT_NE(text.find("`" + key + "`"), std::string::npos) << key << " is not in docs/scenario.md";
  }
}

TEST(ShippedScenarios, AreReadAndSayWhatTheyAre) {
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(UMBSIM_SOURCE_DIR) / "scenarios")) {
    if (entry.is_directory()) continue;
    SCOPED_TRACE(entry.path().string());
    if (entry.path().parent_path().filename() == "trials") continue;  // not scenarios: tests/gap/trial reads them
    const bool is_sweep = entry.path().parent_path().filename() == "sweeps";
    const std::string file = entry.path().string();
    EXPECT_FALSE((is_sweep ? read_sweep(file).description : read_scenario(file).description).empty());
    EXPECT_EQ(text_of(entry.path()).rfind("# ", 0), 0u) << "begins with a comment";
  }
}

}  // namespace
}  // namespace umbsim::acceptance

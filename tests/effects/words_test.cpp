// Effects as a reader sees them: every effect of the catalogue has words, and they are shown in the units of the table.
#include "effects/words.h"

#include <gtest/gtest.h>

#include <iostream>
#include <set>

namespace umbsim {
namespace {

constexpr double kDegree = 0.017453292519943295;

std::vector<FoundParameter> typical(const EffectInfo& info, double share_of_interval) {
  std::vector<FoundParameter> found;
  for (const EffectParameter& p : info.parameters) {
    if (p.typical == p.neutral) continue;
    const double half = p.name == "leg" ? 0 : share_of_interval * std::abs(p.typical);
    found.push_back({p.name, p.typical, p.typical - half, p.typical + half});
  }
  return found;
}

TEST(Words, EveryEffectAndParameterHasThemInTheOrderOfTheCatalogue) {
  ASSERT_EQ(words().size(), catalogue().size());
  for (std::size_t i = 0; i < catalogue().size(); ++i) {
    const EffectInfo& info = catalogue()[i];
    ASSERT_EQ(words()[i].effect, info.name);
    ASSERT_EQ(words()[i].parameters.size(), info.parameters.size()) << info.name;
    EXPECT_FALSE(words()[i].noun.empty());
    for (std::size_t k = 0; k < info.parameters.size(); ++k) {
      EXPECT_EQ(words()[i].parameters[k].name, info.parameters[k].name);
      EXPECT_NO_THROW(shown(info, {info.parameters[k].name, 1, 0, 2})) << "a unit that its SI unit cannot be shown in";
    }
  }
}

// Prints all of them, to be read aloud.
TEST(Words, EverySentenceReadsLikeEnglish) {
  std::set<std::string> different;
  for (const EffectInfo& info : catalogue()) {
    const std::string sentence = found_sentence(info, typical(info, 0.1), {{"wheel", "right"}, {"run", "cw-1"}});
    std::cout << info.name << ": " << sentence << ".\n";
    EXPECT_EQ(sentence.find_first_of("{}[]_"), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find("  "), std::string::npos) << sentence;
    EXPECT_TRUE(std::islower(static_cast<unsigned char>(sentence[0]))) << sentence;
    EXPECT_NE(sentence.find("to"), std::string::npos) << "no interval: " << sentence;
    different.insert(sentence);
  }
  EXPECT_EQ(different.size(), catalogue().size());
}

TEST(Words, SignsBecomeWords) {
  const EffectInfo& wheelbase = find_effect("wheelbase");
  EXPECT_EQ(found_sentence(wheelbase, {{"relative", 0.005, 0.0037, 0.0063}}),
            "the wheelbase is 0.50 % (0.37 to 0.63 %) larger than believed");
  EXPECT_EQ(found_sentence(wheelbase, {{"relative", -0.005, -0.0063, -0.0037}}),
            "the wheelbase is 0.50 % (0.37 to 0.63 %) smaller than believed");
}

TEST(Words, ParametersThatStayedNeutralAreLeftOut) {
  const EffectInfo& toe = find_effect("wheel_misalignment");
  EXPECT_EQ(found_sentence(toe, {{"right_toe_rad", -0.3 * kDegree, -0.36 * kDegree, -0.24 * kDegree}}),
            "the right wheel points 0.30° (0.24 to 0.36°) to the right");
  EXPECT_EQ(found_sentence(toe, {{"left_toe_rad", kDegree, kDegree, kDegree},
                                 {"right_toe_rad", -0.3 * kDegree, -0.36 * kDegree, -0.24 * kDegree}}),
            "the left wheel points 1° to the left and the right wheel points 0.30° (0.24 to 0.36°) to the right");
  EXPECT_TRUE(is_neutral(toe, {"left_toe_rad", 0, -0.01, 0.01}));
}

TEST(Words, FactsThatAreNotKnownAreLeftOut) {
  const EffectInfo& bump = find_effect("bump");
  const std::vector<FoundParameter> found{
      {"height_m", 0.006, 0.005, 0.007}, {"x_m", 2, 1.98, 2.02}, {"y_m", -0.17, -0.19, -0.15}};
  EXPECT_EQ(found_sentence(bump, found, {{"wheel", "right"}}),
            "a cable or step of 6.0 mm (5.0 to 7.0 mm) lies under the right wheel at (2.000, -0.170) m");
  EXPECT_EQ(found_sentence(bump, found), "a cable or step of 6.0 mm (5.0 to 7.0 mm) lies at (2.000, -0.170) m");
}

TEST(Words, DigitsAreThoseThatTheIntervalLeaves) {
  const EffectInfo& floor = find_effect("slippery_floor");
  EXPECT_EQ(shown(floor, {"friction", 0.06123, 0.06, 0.0625}), "friction 0.0612 (0.0600 to 0.0625)");
  EXPECT_EQ(shown(floor, {"friction", 0.06123, 0.01, 0.3}), "friction 0.06 (0.01 to 0.30)");
  EXPECT_EQ(shown(floor, {"friction", 0.06123, 0.06123, 0.06123}), "friction 0.0612");
  EXPECT_EQ(shown(find_effect("push"), {"leg", 2, 2, 2}), "leg 2");
  EXPECT_EQ(shown(find_effect("encoder_resolution"), {"ticks_per_revolution", 100, 100, 100}), "100 ticks");
}

}  // namespace
}  // namespace umbsim

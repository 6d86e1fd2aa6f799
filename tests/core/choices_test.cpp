#include "core/text/choices.h"

#include <gtest/gtest.h>

namespace umbsim {
namespace {

TEST(Choices, DistanceCountsMistypedCharacters) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "bump"), 4);
  EXPECT_EQ(edit_distance("bump", "bump"), 0);
  EXPECT_EQ(edit_distance("bmp", "bump"), 1) << "left out";
  EXPECT_EQ(edit_distance("bumpp", "bump"), 1) << "added";
  EXPECT_EQ(edit_distance("bomp", "bump"), 1) << "replaced";
  EXPECT_EQ(edit_distance("bupm", "bump"), 1) << "neighbours exchanged";
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("gap", "run"), edit_distance("run", "gap"));
}

TEST(Choices, WhatWasMeant) {
  EXPECT_EQ(nearest("gpa", {"run", "gap"}), "gap");
  EXPECT_EQ(nearest("diag", {"plan", "diagnose"}), "diagnose") << "a beginning";
  EXPECT_EQ(nearest("Wheel-Base", {"wheelbase", "wheel_base"}), "wheel_base") << "case and hyphens";
  EXPECT_EQ(nearest("e_max_syst_m", {"umbmark.cw.r_cg_m", "umbmark.e_max_syst_m"}), "umbmark.e_max_syst_m")
      << "the end of a key path";
  EXPECT_EQ(nearest("effects/bmp", {"effects/bump", "effects/wear"}), "effects/bump");
}

TEST(Choices, NothingIsGuessedFromAfar) {
  EXPECT_EQ(nearest("quark", {"bump", "push"}), std::nullopt);
  EXPECT_EQ(nearest("xy", {"run", "gap"}), std::nullopt);
  EXPECT_EQ(nearest("foo", {"gap"}), std::nullopt);
  EXPECT_EQ(nearest("anything", {}), std::nullopt);
  EXPECT_EQ(did_you_mean("quark", {"bump"}), "");
  EXPECT_EQ(did_you_mean("bmp", {"bump"}), "did you mean 'bump'? ");
}

TEST(Choices, TheNearestFewOfMany) {
  EXPECT_EQ(nearest_few("bamp", {"wear", "bump", "lamp"}, 2), (std::vector<std::string>{"bump", "lamp"}));
  EXPECT_EQ(nearest_few("bamp", {"wear"}, 2), (std::vector<std::string>{"wear"}));
}

}  // namespace
}  // namespace umbsim

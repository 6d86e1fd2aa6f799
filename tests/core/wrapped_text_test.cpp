#include "core/text/wrapped_text.h"

#include <gtest/gtest.h>

namespace umbsim {
namespace {

TEST(WrappedText, BreaksAtSpacesAndIndentsWhatFollows) {
  const std::string word(39, 'a');
  EXPECT_EQ(wrapped(word + " " + word), word + " " + word + "\n") << "79 columns";
  EXPECT_EQ(wrapped(word + " " + word + " b", 4), word + " " + word + "\n    b\n") << "81 columns";
  EXPECT_EQ(wrapped("  " + word + " " + word), "  " + word + "\n  " + word + "\n") << "its own indent is kept";
  EXPECT_EQ(wrapped("name    value  more"), "name    value  more\n") << "columns stay";
}

TEST(WrappedText, KeepsWhatHasNoSpaceWhole) {
  const std::string path(100, 'p');
  EXPECT_EQ(wrapped("in " + path + " or so"), "in\n  " + path + "\n  or so\n");
}

TEST(WrappedText, CountsCharactersNotBytes) {
  EXPECT_EQ(columns_of("µm °"), 4u);
  std::string degrees;
  for (int i = 0; i < 80; ++i) degrees += "°";
  EXPECT_EQ(wrapped("a " + degrees), "a\n  " + degrees + "\n");
  EXPECT_EQ(wrapped(degrees), degrees + "\n");
}

TEST(WrappedText, CutsToAColumn) {
  EXPECT_EQ(fitted("abc", 5), "abc  ");
  EXPECT_EQ(fitted("abcdef", 5), "ab...");
  EXPECT_EQ(fitted("°°°°°°", 5), "°°...");
}

}  // namespace
}  // namespace umbsim

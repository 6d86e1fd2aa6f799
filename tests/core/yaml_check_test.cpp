#include "core/text/yaml_check.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/text/yaml_reader.h"

namespace umbsim {
namespace {

/// The message of the InputError that reading `text` throws.
std::string message(const std::string& text) {
  try {
    YamlValue::parse(text, "x.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(YamlCheck, DuplicateKeysAtAnyDepth) {
  EXPECT_EQ(message("a: 1\nb: 2\na: 3\n"), "x.yaml:3:1: a: duplicate key (first on line 1)");
  EXPECT_EQ(message("course:\n  side_m: 1\n  side_m: 1\n"),
            "x.yaml:3:3: course.side_m: duplicate key (first on line 2)");
  EXPECT_EQ(message("runs:\n  - {id: a}\n  - {id: b, id: c}\n"),
            "x.yaml:3:13: runs[1].id: duplicate key (first on line 3)");
  EXPECT_EQ(message("a: {x: 1}\nb: {x: 1}\nc: [{x: 1}, {x: 1}]\n"), "no InputError") << "other maps may repeat a key";
}

TEST(YamlCheck, EmptyDocuments) {
  for (const std::string text : {"", "\n\n", "# only a comment\n", "---\n", "~\n"}) {
    EXPECT_NE(message(text).find("the file is empty"), std::string::npos) << text << message(text);
  }
}

TEST(YamlCheck, SyntaxErrorsHaveAPlace) {
  const std::string text = message("a: 1\nb: [1, 2\nc: 3\n");
  EXPECT_EQ(text.rfind("x.yaml:3:", 0), 0u) << text;
  EXPECT_NE(text.find("not valid YAML: "), std::string::npos) << text;
}

TEST(YamlCheck, KeysMustBeText) {
  EXPECT_NE(message("? [1, 2]\n: 3\n").find("a key must be text"), std::string::npos);
  EXPECT_NE(message("~: 3\n").find("a key is missing"), std::string::npos);
}

TEST(YamlCheck, AliasesAreRefused) {
  EXPECT_EQ(message("a: &x [1]\nb: *x\n"), "x.yaml:2:4: aliases (*name) are not read; write the value out");
  EXPECT_NE(message("&x [*x]\n").find("aliases"), std::string::npos) << "a list that contains itself";
}

TEST(YamlCheck, OneDocumentInAFile) {
  EXPECT_NE(message("a: 1\n---\nb: 2\n").find("a second document begins here"), std::string::npos);
}

TEST(YamlCheck, NestingIsLimited) {
  const auto nested = [](int depth) {
    return std::string(std::size_t(depth), '[') + std::string(std::size_t(depth), ']');
  };
  EXPECT_EQ(message(nested(kMaxYamlDepth)), "no InputError");
  EXPECT_EQ(message(nested(kMaxYamlDepth + 1)), "x.yaml:1:65: maps and lists are nested deeper than 64 levels");
  EXPECT_NE(message(std::string(100000, '[')), "no InputError") << "must not exhaust the stack";
  EXPECT_NE(message(std::string(100000, '{')), "no InputError") << "must not exhaust the stack";
}

TEST(YamlCheck, ControlCharactersAreRefused) {
  EXPECT_EQ(message("a: 1\nb: \x04 2\nc: 3\n"), "x.yaml:2:4: control character 0x04; this is not a text file");
  EXPECT_NE(message(std::string("a: 1\0", 5)).find("control character 0x00"), std::string::npos);
}

}  // namespace
}  // namespace umbsim

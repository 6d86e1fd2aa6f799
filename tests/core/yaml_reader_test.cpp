#include "core/text/yaml_reader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

namespace umbsim {
namespace {

const std::string kDocument =
    "name: demo\n"                    // 1
    "course:\n"                       // 2
    "  side_m: -4\n"                  // 3
    "  laps: 2.5\n"                   // 4
    "  turn: ark\n"                   // 5
    "  quoted: \"4\"\n"               // 6
    "  infinite: .inf\n"              // 7
    "  nothing:\n"                    // 8
    "  on: yes\n"                     // 9
    "runs:\n"                         // 10
    "  - {id: a, mass_kg: 3}\n"       // 11
    "  - {id: b, mass_kg: heavy}\n";  // 12

YamlValue value_at(const std::string& map, const std::string& key) {
  YamlMap top(YamlValue::parse(kDocument, "x.yaml"));
  YamlMap inner(top.at(map));
  return inner.at(key);
}

/// The message of the InputError that `read` throws.
std::string message(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(YamlReader, ReadsEveryKind) {
  YamlMap map(YamlValue::parse("{a: 1.5, b: +7, c: true, d: 'x: y', e: [1, 2], f: -1e-3}", "x.yaml"));
  EXPECT_EQ(map.number("a", Bounds::between(1.5, 1.5)), 1.5);
  EXPECT_EQ(map.integer("b", 0, 7, 7), 7);
  EXPECT_TRUE(map.boolean("c", false));
  EXPECT_EQ(map.string("d", ""), "x: y");
  EXPECT_EQ(map.at("e").list()[1].number(), 2);
  EXPECT_EQ(map.number("f", 0, {}), -1e-3);
  EXPECT_NO_THROW(map.finish());
}

TEST(YamlReader, FallsBackOnlyForMissingKeys) {
  YamlMap map(YamlValue::parse("a:\n", "x.yaml"));
  EXPECT_EQ(map.number("b", 2.5, Bounds::positive()), 2.5);
  EXPECT_EQ(map.choice("c", "cw", {"cw", "ccw"}), "cw");
  EXPECT_TRUE(map.has("a"));
  EXPECT_FALSE(map.has("b"));
  EXPECT_NE(message([&] { map.number("a", 2.5, {}); }).find("a: expected a number, got nothing"), std::string::npos);
}

TEST(YamlReader, NumberOutOfRangeNamesValueAndBound) {
  const YamlValue side = value_at("course", "side_m");
  EXPECT_EQ(message([&] { side.number(Bounds::positive()); }),
            "x.yaml:3:11: course.side_m: -4 is out of range (must be > 0)");
  EXPECT_EQ(message([&] { side.number(Bounds::at_least(-3.5)); }),
            "x.yaml:3:11: course.side_m: -4 is out of range (must be >= -3.5)");
  EXPECT_EQ(message([&] { side.number(Bounds::between(0, 10)); }),
            "x.yaml:3:11: course.side_m: -4 is out of range (must be >= 0 and <= 10)");
  EXPECT_EQ(message([&] { side.integer(1, 9); }),
            "x.yaml:3:11: course.side_m: -4 is out of range (must be >= 1 and <= 9)");
  EXPECT_EQ(side.number(Bounds::at_least(-4)), -4) << "a closed bound belongs to the range";
}

TEST(YamlReader, WrongTypesNameWhatWasFound) {
  const std::vector<std::tuple<std::string, std::function<void(const YamlValue&)>, std::string>> cases = {
      {"turn", [](auto& v) { v.number(); }, "x.yaml:5:9: course.turn: expected a number, got 'ark'"},
      {"quoted", [](auto& v) { v.number(); }, "x.yaml:6:11: course.quoted: expected a number, got the string \"4\""},
      {"infinite", [](auto& v) { v.number(); }, "x.yaml:7:13: course.infinite: expected a finite number, got '.inf'"},
      {"laps", [](auto& v) { v.integer(0, 9); }, "x.yaml:4:9: course.laps: expected an integer, got '2.5'"},
      {"on", [](auto& v) { v.boolean(); }, "x.yaml:9:7: course.on: expected true or false, got 'yes'"},
      {"side_m", [](auto& v) { v.list(); }, "x.yaml:3:11: course.side_m: expected a list, got '-4'"},
      {"side_m", [](auto& v) { YamlMap map(v); }, "x.yaml:3:11: course.side_m: expected a map (key: value), got '-4'"},
  };
  for (const auto& [key, read, expected] : cases) {
    const YamlValue value = value_at("course", key);
    EXPECT_EQ(message([&, &reader = read] { reader(value); }), expected);
  }
  const std::string null_message = message([&] { value_at("course", "nothing").string(); });
  EXPECT_NE(null_message.find("course.nothing: expected text, got nothing"), std::string::npos) << null_message;
}

TEST(YamlReader, NotANumberInAnySpelling) {
  for (const std::string text :
       {"nan", ".nan", ".NaN", "inf", "-.inf", "Infinity", "1e999", "0x10", "1,5", "1_0", "+-1", "1 m"}) {
    const YamlValue value = YamlMap(YamlValue::parse("v: " + text, "x.yaml")).at("v");
    EXPECT_THROW(value.number(), InputError) << text;
  }
}

TEST(YamlReader, IntegersTooLargeForTheType) {
  const YamlValue value = YamlValue::parse("[99999999999999999999]", "x.yaml").list()[0];
  EXPECT_EQ(message([&] { value.integer(0, 9); }), "x.yaml:1:2: [0]: expected an integer, got '99999999999999999999'");
}

TEST(YamlReader, UnknownChoiceListsTheChoices) {
  EXPECT_EQ(message([] {
              value_at("course", "turn").choice({"in_place", "arc"});
            }),
            "x.yaml:5:9: course.turn: unknown value 'ark'; did you mean 'arc'? one of: in_place, arc");
}

TEST(YamlReader, UnknownKeyListsTheKnownOnes) {
  YamlMap map(YamlValue::parse("wheelbase_m: 1\nwheelbse_m: 2\n", "x.yaml"));
  map.number("wheelbase_m", {});
  map.find("radius_m");
  EXPECT_EQ(message([&] { map.finish(); }),
            "x.yaml:2:1: wheelbse_m: unknown key; did you mean 'wheelbase_m'? one of: radius_m, wheelbase_m");
}

TEST(YamlReader, MissingKeyNamesItsPath) {
  YamlMap top(YamlValue::parse(kDocument, "x.yaml"));
  YamlMap second(top.at("runs").list()[1]);
  EXPECT_EQ(message([&] { second.at("direction"); }), "x.yaml:12:5: runs[1].direction: this key is missing");
  EXPECT_EQ(message([&] { top.number("seed", {}); }), "x.yaml:1:1: seed: this key is missing");
}

TEST(YamlReader, PathsCountListItems) {
  YamlMap top(YamlValue::parse(kDocument, "x.yaml"));
  YamlMap second(top.at("runs").list()[1]);
  EXPECT_EQ(message([&] { second.number("mass_kg", {}); }),
            "x.yaml:12:22: runs[1].mass_kg: expected a number, got 'heavy'");
}

TEST(YamlReader, EntriesKeepTheOrderOfTheFile) {
  YamlMap map(YamlValue::parse("{zeta: 1, alpha: 2}", "x.yaml"));
  const auto entries = map.entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].first, "zeta");
  EXPECT_EQ(entries[1].second.path(), "alpha");
  EXPECT_NO_THROW(map.finish());
}

TEST(YamlReader, AssignmentLeavesTheDocumentAlone) {
  const YamlValue document = YamlValue::parse("[1, 2]", "x.yaml");
  YamlValue item = document.list()[0];
  item = document.list()[1];
  EXPECT_EQ(item.number(), 2);
  EXPECT_EQ(document.list()[0].number(), 1);
}

TEST(YamlReader, NearestChoice) {
  EXPECT_EQ(list_choices("wheelbse", {"wheelbase", "bump"}), "did you mean 'wheelbase'? one of: wheelbase, bump");
  EXPECT_EQ(list_choices("quark", {"bump", "push"}), "one of: bump, push") << "nothing is near";
}

TEST(YamlReader, UnreadableFiles) {
  const std::string missing = testing::TempDir() + "there_is_no_such_file.yaml";
  EXPECT_EQ(message([&] { YamlValue::load(missing); }), missing + ": cannot be read: No such file or directory");
  const std::string folder = testing::TempDir();
  EXPECT_EQ(message([&] { YamlValue::load(folder); }), folder + ": cannot be read: it is a directory");
}

}  // namespace
}  // namespace umbsim

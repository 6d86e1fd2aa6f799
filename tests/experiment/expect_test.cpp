#include "experiment/scenario/expect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/text/yaml_reader.h"

namespace umbsim {
namespace {

std::vector<Expectation> read(const std::string& text) {
  return read_expectations(YamlValue::parse(text, "test.yaml"), ExpectationsOf::sweep);
}

/// Points 0, 1, ... with these values of umbmark.e_max_syst_m, at sides 0, 1, ... m.
FigureTable table(const std::vector<Cell>& values) {
  FigureTable t{{"course.side_m", "umbmark.e_max_syst_m"}, {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    t.rows.push_back({std::int64_t(i), "side " + std::to_string(i), "", {std::int64_t(i), values[i]}});
  }
  return t;
}

Check checked(const std::string& bounds, const std::vector<Cell>& values) {
  return check(read("umbmark.e_max_syst_m: " + bounds), table(values)).at(0);
}

TEST(Expect, BoundsAreClosed) {
  EXPECT_EQ(checked("{min: 1, max: 2}", {0.999, 1.0, 2.0, 2.001}).unmet, 2);
  EXPECT_EQ(checked("{abs_max: 1}", {-1.0, 1.0, -1.001}).unmet, 1);
}

TEST(Expect, NothingMeetsNothing) { EXPECT_EQ(checked("{max: 1}", {Cell{}, std::nan("")}).unmet, 2); }

TEST(Expect, PointsOutsideTheConditionDoNotCount) {
  const Check c = checked("{max: 1, where: course.side_m >= 2}", {9.0, 9.0, 0.5, 3.0});
  EXPECT_EQ(c.outcomes.size(), 2u);
  EXPECT_EQ(c.unmet, 1);
  EXPECT_EQ(c.outcomes[1].point, 3);
}

// An expectation that looks at no point at all is a mistake, not a success.
TEST(Expect, NoPointInTheConditionIsNotMet) {
  EXPECT_EQ(checked("{max: 1, where: course.side_m > 7}", {0.0}).unmet, 1);
}

// NumPy: quantile([1, 2, 3, 4, 10], 0.9) = 7.6 and quantile(abs, 0.5) = 3.
TEST(Expect, QuantilesAreThoseOfNumpy) {
  const std::vector<Cell> values{4.0, -1.0, 3.0, 10.0, -2.0};
  EXPECT_DOUBLE_EQ(number_of(checked("{max: 8, quantile: 0.9}", {4.0, 1.0, 3.0, 10.0, 2.0}).outcomes.at(0).value), 7.6);
  EXPECT_DOUBLE_EQ(number_of(checked("{abs_max: 8, quantile: 0.5}", values).outcomes.at(0).value), 3);
  EXPECT_DOUBLE_EQ(number_of(checked("{max: 8, quantile: 1}", values).outcomes.at(0).value), 10);
  EXPECT_DOUBLE_EQ(number_of(checked("{min: -8, quantile: 0}", values).outcomes.at(0).value), -2);
}

TEST(Expect, AFailedPointMeetsNoExpectationAndSpoilsAQuantile) {
  FigureTable t = table({1.0, Cell{}});
  t.rows[1].error = "non-finite";
  const auto checks =
      check(read("{umbmark.e_max_syst_m: [{max: 5}, {max: 5, quantile: 0.5}], failed_points: {max: 1}}"), t);
  EXPECT_EQ(checks[0].unmet, 1);
  EXPECT_EQ(checks[1].unmet, 1);
  EXPECT_EQ(checks[2].unmet, 0);
}

TEST(Expect, TheListIsCutAndSaysSo) {
  std::vector<Cell> values(30, Cell(2.0));
  const std::string text = checks_text({checked("{max: 1}", values)}, 20);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 1 + 20 + 1);
  EXPECT_NE(text.find("and 10 more"), std::string::npos) << text;
}

}  // namespace
}  // namespace umbsim

// Rows of recordings: the same bytes as fmt's shortest, of the value to the nearest 1e-9.
#include "core/text/decimal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/random.h"

namespace umbsim {
namespace {

std::string written(double value) {
  char text[kDecimalRoom];
  return {text, write_decimal(text, value)};
}

// As it was written before there was write_decimal().
std::string expected(double value) {
  if (std::abs(value) <= 9e6) value = std::round(value * 1e9) / 1e9 + 0.0;
  return fmt::format("{}", value);
}

TEST(Decimal, WritesWhatFmtWrites) {
  for (const double value : {0.0,
                             -0.0,
                             1.0,
                             -1.0,
                             0.1 + 0.2,
                             20.0,
                             1e-4,
                             9.9999e-5,
                             0.000123456789,
                             -1e-9,
                             4e-10,
                             5e-10,
                             -4e-10,
                             123456.789,
                             3999999.999999999,
                             4000000.000000001,
                             8999999.123456789,
                             9e6,
                             1e7,
                             1e15,
                             1e16,
                             -2.5e20,
                             1e300,
                             std::numeric_limits<double>::denorm_min()}) {
    EXPECT_EQ(written(value), expected(value));
  }
  EXPECT_EQ(written(0.30000000000000004), "0.3");
  RandomStream random(1, "decimals", 0);
  for (int i = 0; i < 300000; ++i) {
    const double size = std::pow(10.0, random.uniform(-11, 8)), value = random.uniform(-1, 1) * size;
    ASSERT_EQ(written(value), expected(value)) << fmt::format("{:a}", value);
    const double nice = std::round(value / size * 1000) / 1000 * size;
    ASSERT_EQ(written(nice), expected(nice)) << fmt::format("{:a}", nice);
  }
}

}  // namespace
}  // namespace umbsim

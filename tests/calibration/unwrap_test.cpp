// Counters of 16 and 32 bits come back as if they had never wrapped.
#include "calibration/intake/unwrap.h"

#include <gtest/gtest.h>

#include "tests/calibration/tracked_drive.h"

namespace umbsim::intake {
namespace {

Recording fine_squares(double ticks_per_revolution) {
  OdometryParameters o = testing::nominal_odometry();
  o.ticks_per_revolution = ticks_per_revolution;
  return testing::tracked_squares({}, o, 1);
}

template <typename Counter>
Recording as_counted_by(Recording recording, std::int64_t from) {
  for (RecordedRun& run : recording.runs) {
    for (EncoderSample& s : run.encoders) {
      s.left_ticks = std::int64_t(Counter(s.left_ticks + from));
      s.right_ticks = std::int64_t(Counter(s.right_ticks + from));
    }
  }
  return recording;
}

void expect_same_ways(const Recording& a, const Recording& b) {
  for (std::size_t r = 0; r < a.runs.size(); ++r) {
    const auto &x = a.runs[r].encoders, &y = b.runs[r].encoders;
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_EQ(x[i].left_ticks - x[0].left_ticks, y[i].left_ticks - y[0].left_ticks) << r << " " << i;
      ASSERT_EQ(x[i].right_ticks - x[0].right_ticks, y[i].right_ticks - y[0].right_ticks) << r << " " << i;
    }
  }
}

TEST(Unwrap, SixteenBitsWithAndWithoutSign) {
  // cw the left wheel rolls 8 m and once round the other, 9.07 m or 384 860 counts: past 32768 + 65536 n six times, and
  // from 123 on past 65536 n five times.
  const Recording good = fine_squares(20000);
  for (auto& [wrapped, times] :
       {std::pair{as_counted_by<std::int16_t>(good, 0), "left_ticks at 16 bits, 6 times"},
        std::pair{as_counted_by<std::uint16_t>(good, 123), "left_ticks at 16 bits, 5 times"}}) {
    Recording unwrapped = wrapped;
    const std::vector<std::string> said = unwrap_counters(unwrapped);
    expect_same_ways(unwrapped, good);
    ASSERT_EQ(said.size(), 2u);
    EXPECT_NE(said[0].find(times), std::string::npos) << said[0];
  }
}

TEST(Unwrap, ThirtyTwoBits) {
  const Recording good = fine_squares(20000);
  Recording wrapped = as_counted_by<std::int32_t>(good, 2147483647 - 1000);
  EXPECT_EQ(unwrap_counters(wrapped).size(), 2u);
  expect_same_ways(wrapped, good);
}

TEST(Unwrap, GoodCountsStayAsTheyAre) {
  const Recording good = fine_squares(20000);
  Recording same = good;
  EXPECT_TRUE(unwrap_counters(same).empty());
  expect_same_ways(same, good);
}

// A jump of another size is no wrap, and is left for the checks to refuse.
TEST(Unwrap, OtherJumpsAreNotRepaired) {
  Recording jumped = fine_squares(2000);
  for (std::size_t i = 100; i < jumped.runs[0].encoders.size(); ++i) jumped.runs[0].encoders[i].left_ticks += 40000;
  const Recording before = jumped;
  EXPECT_TRUE(unwrap_counters(jumped).empty());
  expect_same_ways(jumped, before);
}

}  // namespace
}  // namespace umbsim::intake

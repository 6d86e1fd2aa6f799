// The floor near one place against the C library's sines, and its bend against differences of its slope.
#include "sim/model/floor_near.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace umbsim {
namespace {

// Two roundings of an angle below pi/2 and two of the series, each by half of 2.2e-16, and one of the library.
constexpr double kLastPlaces = 5e-16;

Floor rippled(int waves) {
  Floor floor;
  floor.ripples = random_ripples(0.001, 0.3, 11, 2, waves);
  return floor;
}

TEST(SinesOfTwo, AreThoseOfTheLibrary) {
  RandomStream random(7, "sines");
  for (const double largest_rad : {1.0, 1e3, 0.99e5, 1e9}) {
    for (int k = 0; k < 1000; ++k) {
      const double first_rad = random.uniform(-largest_rad, largest_rad), second_rad = random.uniform(-1, 1);
      const Eigen::Array2d angle_rad(first_rad, second_rad);
      Eigen::Array2d sine, cosine;
      sines_of_two(angle_rad, sine, cosine);
      for (int i = 0; i < 2; ++i) {
        ASSERT_NEAR(sine[i], std::sin(angle_rad[i]), kLastPlaces) << angle_rad[i];
        ASSERT_NEAR(cosine[i], std::cos(angle_rad[i]), kLastPlaces) << angle_rad[i];
      }
    }
  }
}

// Within the series' reach and far beyond it, for even and odd numbers of ripples and for more than are kept.
TEST(FloorNear, IsTheFloor) {
  RandomStream random(8, "near");
  for (const int waves : {1, 7, 12, 40}) {
    const Floor floor = rippled(waves);
    const double most = 1e-15 * waves;
    for (int k = 0; k < 300; ++k) {
      const double x_m = random.uniform(-5, 5), y_m = random.uniform(-5, 5), way_m = k % 3 ? 0.003 : 0.5;
      FloorNear near(floor, x_m, y_m);
      const double to_x_m = x_m + random.uniform(-way_m, way_m), to_y_m = y_m + random.uniform(-way_m, way_m);
      const FloorBend is = near.at(to_x_m, to_y_m), should = floor_bend(floor, to_x_m, to_y_m);
      EXPECT_NEAR(is.at.height_m, should.at.height_m, most);
      EXPECT_NEAR(is.at.slope_x, should.at.slope_x, 30 * most);
      EXPECT_NEAR(is.at.slope_y, should.at.slope_y, 30 * most);
      EXPECT_NEAR(is.xx_per_m, should.xx_per_m, 1000 * most);
      EXPECT_NEAR(is.xy_per_m, should.xy_per_m, 1000 * most);
      EXPECT_NEAR(is.yy_per_m, should.yy_per_m, 1000 * most);
    }
  }
}

TEST(FloorBend, IsTheDerivativeOfTheSlope) {
  const Floor floor = rippled(12);
  RandomStream random(9, "bend");
  constexpr double kDelta_m = 1e-5;
  constexpr double kThirdOrder = 1e-6;  // of the slope: 12 * 0.0004 * 31^4 d^2 / 6, and round-off / d
  for (int k = 0; k < 100; ++k) {
    const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
    const FloorPoint east = floor_at(floor, x + kDelta_m, y), west = floor_at(floor, x - kDelta_m, y);
    const FloorPoint north = floor_at(floor, x, y + kDelta_m), south = floor_at(floor, x, y - kDelta_m);
    const FloorBend bend = floor_bend(floor, x, y);
    EXPECT_NEAR(bend.xx_per_m, (east.slope_x - west.slope_x) / (2 * kDelta_m), kThirdOrder);
    EXPECT_NEAR(bend.xy_per_m, (east.slope_y - west.slope_y) / (2 * kDelta_m), kThirdOrder);
    EXPECT_NEAR(bend.xy_per_m, (north.slope_x - south.slope_x) / (2 * kDelta_m), kThirdOrder);
    EXPECT_NEAR(bend.yy_per_m, (north.slope_y - south.slope_y) / (2 * kDelta_m), kThirdOrder);
  }
}

}  // namespace
}  // namespace umbsim

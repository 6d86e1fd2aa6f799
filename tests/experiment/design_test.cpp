#include "experiment/sweep/design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace umbsim {
namespace {

std::vector<double> column(const std::vector<double>& shares, std::size_t dimensions, std::size_t axis) {
  std::vector<double> values;
  for (std::size_t i = axis; i < shares.size(); i += dimensions) values.push_back(shares[i]);
  return values;
}

TEST(LatinHypercube, HasOnePointInEachPartOfEachAxis) {
  const std::int64_t n = 57;
  const std::vector<double> shares = latin_hypercube(n, 4, 3);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    std::set<int> parts;
    for (const double share : column(shares, 4, axis)) parts.insert(int(std::floor(share * double(n))));
    EXPECT_EQ(parts.size(), std::size_t(n));
    EXPECT_EQ(*parts.begin(), 0);
    EXPECT_EQ(*parts.rbegin(), n - 1);
  }
}

TEST(LatinHypercube, AxesAndSeedsDiffer) {
  const std::vector<double> shares = latin_hypercube(20, 2, 3);
  EXPECT_NE(column(shares, 2, 0), column(shares, 2, 1));
  EXPECT_EQ(shares, latin_hypercube(20, 2, 3));
  EXPECT_NE(shares, latin_hypercube(20, 2, 4));
}

// The first points of Sobol's sequence in two dimensions (Bratley & Fox 1988).
TEST(Sobol, BeginsAsPublished) {
  const std::vector<double> expected{0.5,   0.5,   0.75,  0.25,  0.25,  0.75,  0.375,
                                     0.375, 0.875, 0.875, 0.625, 0.125, 0.125, 0.625};
  EXPECT_EQ(sobol(7, 2), expected);
}

// Its property: of 2^k - 1 points after the origin, every elementary interval holds its share. With the origin, each of
// the 4 x 4 cells of any two of the first axes holds 16 of 256 points.
TEST(Sobol, FillsCellsEvenly) {
  const std::vector<double> shares = sobol(255, 3);
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    std::vector<int> cells(16);
    ++cells[0];
    for (std::size_t i = 0; i < 255; ++i) {
      ++cells[std::size_t(shares[i * 3 + std::size_t(a)] * 4) * 4 + std::size_t(shares[i * 3 + std::size_t(b)] * 4)];
    }
    EXPECT_TRUE(std::all_of(cells.begin(), cells.end(), [](int count) { return count == 16; }));
  }
}

}  // namespace
}  // namespace umbsim

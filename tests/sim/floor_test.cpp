// The floor's geometry against brute force over the rim angle, closed forms, and finite differences.
#include "sim/model/floor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <iostream>

#include "core/random.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr double kRoundOff_m = 1e-12;
// A golden-section search finds a minimum's place to the square root of round-off, its value to round-off.
constexpr double kSearch_m = 1e-12;

struct Rim {
  RollingShape shape;
  Vector3d u, w;
  explicit Rim(const RollingShape& s) : shape(s), u(s.axis.unitOrthogonal()), w(s.axis.cross(u)) {}
  Vector3d at(double angle) const {
    return shape.centre_m + shape.radius_m * (std::cos(angle) * u + std::sin(angle) * w);
  }
};

// The smallest value over the full circle: a dense scan, then golden section.
double smallest(const std::function<double(double)>& f) {
  constexpr int kScan = 5000;
  int best = 0;
  for (int i = 1; i < kScan; ++i) {
    if (f(2 * M_PI * i / kScan) < f(2 * M_PI * best / kScan)) best = i;
  }
  double a = 2 * M_PI * (best - 1) / kScan, b = 2 * M_PI * (best + 1) / kScan;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  while (b - a > 1e-10) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    if (f(c) < f(d))
      b = d;
    else
      a = c;
  }
  return f((a + b) / 2);
}

RollingShape tilted_wheel(RandomStream& random, double z_m) {
  const Vector3d axis = Vector3d(random.normal(0, 1), random.normal(0, 1), random.normal(0, 0.03)).normalized();
  return {Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), z_m), axis, 0.075};
}

TEST(Floor, FlatNearestPointIsTheLowestOfTheRim) {
  RandomStream random(1, "flat");
  for (int k = 0; k < 20; ++k) {
    const RollingShape wheel = tilted_wheel(random, 0.0755);
    const NearestPoint nearest = nearest_on_floor({}, wheel);
    const Rim rim(wheel);
    EXPECT_NEAR(nearest.distance_m, smallest([&](double a) { return rim.at(a).z(); }), kSearch_m);
    EXPECT_EQ(nearest.normal, Vector3d::UnitZ());
    EXPECT_EQ(nearest.point_m.z(), 0);
  }
  const NearestPoint ball = nearest_on_floor({}, {{1, 2, 0.05}, Vector3d::Zero(), 0.03});
  EXPECT_NEAR(ball.distance_m, 0.02, kRoundOff_m);
}

// The rim point with the smallest height over the floor below it is where the rim's tangent is parallel to the floor.
TEST(Floor, RippledNearestPointAgainstBruteForce) {
  Floor floor;
  floor.ripples = random_ripples(0.0005, 0.3, 3, 0);
  RandomStream random(2, "rippled");
  double worst = 0;
  for (int k = 0; k < 50; ++k) {
    const RollingShape wheel = tilted_wheel(random, 0.0755);
    const Rim rim(wheel);
    const auto gap = [&](double a) {
      const Vector3d p = rim.at(a);
      return p.z() - floor_at(floor, p.x(), p.y()).height_m;
    };
    const NearestPoint nearest = nearest_on_floor(floor, wheel);
    const double vertical_m = smallest(gap);
    worst = std::max(worst, std::abs(nearest.distance_m / nearest.normal.z() - vertical_m));
    EXPECT_NEAR(nearest.distance_m / nearest.normal.z(), vertical_m, kSearch_m);
    const FloorPoint at = floor_at(floor, nearest.point_m.x(), nearest.point_m.y());
    EXPECT_NEAR(nearest.point_m.z(), at.height_m, kRoundOff_m);
    EXPECT_LT(nearest.normal.cross(Vector3d(-at.slope_x, -at.slope_y, 1)).norm(), kRoundOff_m);
  }
  std::cout << "rippled floor: largest difference from brute force " << worst << " m\n";
}

// The distance is measured along the floor's normal at the point below; the truly nearest point differs by gap^2 times
// the curvature (0.0005 * (2 pi / 0.2)^2 < 1 per m) and by slope^2: far below a micrometre for gaps of a millimetre.
TEST(Floor, RippledBallDistanceIsTheTrueOneToSecondOrder) {
  constexpr double kSecondOrder_m = 1e-6;
  Floor floor;
  floor.ripples = random_ripples(0.0005, 0.3, 3, 1);
  RandomStream random(4, "ball");
  for (int k = 0; k < 20; ++k) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    const Vector3d centre(x, y, floor_at(floor, x, y).height_m + 0.030 + random.uniform(-0.0002, 0.001));
    double nearest_m = 1;
    for (int i = -200; i <= 200; ++i) {
      for (int j = -200; j <= 200; ++j) {
        const double px = x + i * 2e-5, py = y + j * 2e-5;
        nearest_m = std::min(nearest_m, (Vector3d(px, py, floor_at(floor, px, py).height_m) - centre).norm());
      }
    }
    EXPECT_NEAR(nearest_on_floor(floor, {centre, Vector3d::Zero(), 0.030}).distance_m, nearest_m - 0.030,
                kSecondOrder_m);
  }
}

TEST(Floor, CableNearestPointAgainstBruteForce) {
  RandomStream random(5, "cable");
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    Cable cable;
    cable.x_m = 0.1;
    cable.direction_rad = random.uniform(1, 2);
    cable.length_m = 10;
    const double yaw = random.uniform(-0.3, 0.3), lean = random.normal(0, 0.02);
    const Vector3d axis = Vector3d(-std::sin(yaw), std::cos(yaw), lean).normalized();
    const RollingShape wheel{
        {random.uniform(0, 0.2), random.uniform(-0.1, 0.1), random.uniform(0.083, 0.09)}, axis, 0.075};
    const Vector3d along(std::cos(cable.direction_rad), std::sin(cable.direction_rad), 0);
    const Rim rim(wheel);
    const auto distance = [&](double a) { return (rim.at(a) - Vector3d(0.1, 0, 0.005)).cross(along).norm() - 0.005; };
    NearestPoint nearest;
    ASSERT_TRUE(nearest_on_cable({}, cable, wheel, nearest));
    EXPECT_NEAR(nearest.distance_m, smallest(distance), kSearch_m) << "case " << k;
    worst = std::max(worst, std::abs(nearest.distance_m - smallest(distance)));
    EXPECT_NEAR(nearest.normal.norm(), 1, kRoundOff_m);
    EXPECT_NEAR(nearest.normal.dot(along), 0, kRoundOff_m);
    EXPECT_NEAR((nearest.point_m - Vector3d(0.1, 0, 0.005)).cross(along).norm(), 0.005, kRoundOff_m);
  }
  std::cout << "cable: largest difference from brute force " << worst << " m\n";
}

// A wheel on the floor touches the cable at x = -2 sqrt(R r), where both centres are R + r apart; the contact then
// stands at cos psi = (R - r) / (R + r) from the vertical.
TEST(Floor, WheelFirstTouchesTheCableAtTheClosedFormAngle) {
  for (const auto& [R, h] : {std::pair{0.075, 0.010}, {0.042, 0.010}, {0.0325, 0.006}}) {
    const double r = h / 2;
    Cable cable;
    cable.height_m = h;
    const RollingShape wheel{{-2 * std::sqrt(R * r), 0, R}, Vector3d::UnitY(), R};
    NearestPoint nearest;
    ASSERT_TRUE(nearest_on_cable({}, cable, wheel, nearest));
    EXPECT_NEAR(nearest.distance_m, 0, kRoundOff_m);
    EXPECT_NEAR(nearest_on_floor({}, wheel).distance_m, 0, kRoundOff_m);
    EXPECT_NEAR(nearest.normal.z(), (R - r) / (R + r), kRoundOff_m);
    EXPECT_LT(nearest.normal.x(), 0) << "pushes the wheel back";
  }
}

TEST(Floor, CableEndsAreCutSquare) {
  Cable cable;  // along y, 80 mm
  NearestPoint nearest;
  for (const double y : {-0.0399, 0.0399}) {
    EXPECT_TRUE(nearest_on_cable({}, cable, {{-0.03, y, 0.075}, Vector3d::UnitY(), 0.075}, nearest));
  }
  for (const double y : {-0.0401, 0.0401}) {
    EXPECT_FALSE(nearest_on_cable({}, cable, {{-0.03, y, 0.075}, Vector3d::UnitY(), 0.075}, nearest));
  }
}

TEST(Floor, OverlapCountsNegative) {
  Cable cable;
  NearestPoint nearest;
  ASSERT_TRUE(nearest_on_cable({}, cable, {{0, 0, 0.083}, Vector3d::UnitY(), 0.075}, nearest));
  EXPECT_NEAR(nearest.distance_m, -0.002, kRoundOff_m);
  EXPECT_NEAR(nearest.normal.z(), 1, kRoundOff_m);
}

TEST(Floor, SlopesAreTheDerivativesOfTheHeight) {
  Floor floor;
  floor.ripples = random_ripples(0.001, 0.3, 11, 2);
  RandomStream random(6, "slopes");
  constexpr double kDelta_m = 1e-5;
  constexpr double kThirdOrder = 1e-7;  // h''' d^2 / 6 with h''' < 12 * 0.0004 * 31^3, and round-off / d
  for (int k = 0; k < 100; ++k) {
    const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
    const auto height = [&](double dx, double dy) { return floor_at(floor, x + dx, y + dy).height_m; };
    const FloorPoint at = floor_at(floor, x, y);
    EXPECT_NEAR(at.slope_x, (height(kDelta_m, 0) - height(-kDelta_m, 0)) / (2 * kDelta_m), kThirdOrder);
    EXPECT_NEAR(at.slope_y, (height(0, kDelta_m) - height(0, -kDelta_m)) / (2 * kDelta_m), kThirdOrder);
  }
}

TEST(RandomRipples, HaveTheStatedRootMeanSquare) {
  constexpr double kSampling = 0.02;  // of 200 x 200 places over 400 wavelengths: cross terms average out
  for (const std::uint64_t index : {0, 1, 2}) {
    Floor floor;
    floor.ripples = random_ripples(0.0005, 0.3, 5, index);
    ASSERT_EQ(floor.ripples.size(), 12u);
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      for (int j = 0; j < 200; ++j) sum += std::pow(floor_at(floor, i * 0.617, j * 0.593).height_m, 2);
    }
    const double rms_m = std::sqrt(sum / 40000);
    std::cout << "ripples " << index << ": rms " << rms_m << " m (0.0005)\n";
    EXPECT_NEAR(rms_m, 0.0005, 0.0005 * kSampling);
    for (const Ripple& ripple : floor.ripples) {
      const double wavelength_m = 2 * M_PI / std::hypot(ripple.kx_radpm, ripple.ky_radpm);
      EXPECT_GT(wavelength_m, 0.2 - kRoundOff_m);
      EXPECT_LT(wavelength_m, 0.4 + kRoundOff_m);
    }
  }
}

TEST(RandomRipples, DependOnSeedAndIndexOnly) {
  const auto height = [](std::uint64_t seed, std::uint64_t index) {
    Floor floor;
    floor.ripples = random_ripples(0.001, 0.3, seed, index);
    return floor_at(floor, 0.1, 0.2).height_m;
  };
  EXPECT_EQ(height(1, 0), height(1, 0));
  EXPECT_NE(height(1, 0), height(1, 1));
  EXPECT_NE(height(1, 0), height(2, 0));
  EXPECT_TRUE(random_ripples(0, 0.3, 1, 0).empty());
}

}  // namespace
}  // namespace umbsim

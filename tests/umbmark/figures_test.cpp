// UMBmark's figures against the published numbers, on exact kinematics and on a real robot's recordings.
#include "umbmark/figures.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <iostream>

#include "core/error.h"
#include "tests/umbmark/exact_kinematics.h"

namespace umbsim {
namespace {

using testing::nominal_odometry;
using testing::PlanePose;
using testing::square_run;
using testing::squares;
using testing::TrueRobot;

constexpr double kTicks_m = 1e-8;             // rounding of 1e9 ticks, over 16 m and their headings
constexpr double kHalfLastDigit = 0.5000001;  // of a published number; the little more is for its own rounding

TEST(Umbmark, PublishedExampleOfTheLabmate) {
  const Umbmark u = umbmark(squares(TrueRobot::with(1.00084, 336.17 / 340), nominal_odometry()), nominal_odometry());
  std::cout << "cw " << 1000 * u.cw.centroid_x_m << " " << 1000 * u.cw.centroid_y_m << " mm, "
            << degrees(u.cw.heading_rad) << " deg; ccw " << 1000 * u.ccw.centroid_x_m << " "
            << 1000 * u.ccw.centroid_y_m << " mm, " << degrees(u.ccw.heading_rad) << " deg; E_max "
            << 1000 * u.e_max_syst_m << " mm\n";
  EXPECT_NEAR(1000 * u.cw.centroid_x_m, 63.420, kHalfLastDigit * 1e-3);
  EXPECT_NEAR(1000 * u.cw.centroid_y_m, 62.558, kHalfLastDigit * 1e-3);
  EXPECT_NEAR(degrees(u.cw.heading_rad), -1.8118, kHalfLastDigit * 1e-4);
  EXPECT_NEAR(1000 * u.ccw.centroid_x_m, 229.995, kHalfLastDigit * 1e-3);
  EXPECT_NEAR(1000 * u.ccw.centroid_y_m, -209.397, kHalfLastDigit * 1e-3);
  EXPECT_NEAR(degrees(u.ccw.heading_rad), 6.3912, kHalfLastDigit * 1e-4);
  EXPECT_NEAR(1000 * u.e_max_syst_m, 311.04, kHalfLastDigit * 1e-2);
}

TEST(Umbmark, FormulaBiasIsThePublishedOneAndTheHeadingFormHasNone) {
  constexpr double kHeadingForm = 1e-9;  // ticks
  struct Line {
    double e_d, e_b, endpoint_e_d, endpoint_e_b;
  };
  for (const Line& line : {Line{1.00084, 336.17 / 340, 1.00089, 0.98846}, Line{1.005, 1.02, 1.00444, 1.01548},
                           Line{1.01, 1.05, 1.00698, 1.02754}}) {
    const Umbmark u = umbmark(squares(TrueRobot::with(line.e_d, line.e_b), nominal_odometry()), nominal_odometry());
    std::cout << "true " << line.e_d << " " << line.e_b << ", endpoint form " << u.endpoint.e_d << " " << u.endpoint.e_b
              << ", heading form off by " << u.heading.e_d - line.e_d << " " << u.heading.e_b - line.e_b << "\n";
    EXPECT_NEAR(u.endpoint.e_d, line.endpoint_e_d, kHalfLastDigit * 1e-5);
    EXPECT_NEAR(u.endpoint.e_b, line.endpoint_e_b, kHalfLastDigit * 1e-5);
    EXPECT_NEAR(u.heading.e_d, line.e_d, kHeadingForm);
    EXPECT_NEAR(u.heading.e_b, line.e_b, kHeadingForm);
  }
}

// Each lap has its share of the return error: headings to the last digit, positions as long as angles are small.
TEST(Umbmark, ManyLapsSayWhatOneSays) {
  for (const int laps : {2, 3, 10}) {
    for (const double size : {0.01, 0.1, 1.0}) {
      const double e_d = 1 + size * 0.00084, e_b = 1 - size * 0.01126;
      const Umbmark u = umbmark(squares(TrueRobot::with(e_d, e_b), nominal_odometry(), 4, laps), nominal_odometry());
      std::cout << laps << " laps, E_d " << e_d << ", E_b " << e_b << ": endpoint form off by " << u.endpoint.e_d - e_d
                << " " << u.endpoint.e_b - e_b << ", heading form " << u.heading.e_d - e_d << " " << u.heading.e_b - e_b
                << "\n";
      EXPECT_EQ(u.cw.laps, laps);
      EXPECT_NEAR(u.heading.e_d, e_d, 1e-9);
      EXPECT_NEAR(u.heading.e_b, e_b, 1e-9);
      // What the laps turn it by, 4 alpha each, mixes x and y.
      const double turned_rad = 4 * laps * M_PI / 2 * (1 - e_b);
      EXPECT_NEAR(u.endpoint.e_b, e_b, (1 - e_b) * turned_rad);
      EXPECT_NEAR(u.endpoint.e_d, e_d, (1 - e_b) * turned_rad);
    }
  }
}

// The formulas of NUMBERS.md, written out once more with R as it stands there.
TEST(Umbmark, EstimatesAreThoseOfBorensteinAndFeng) {
  const Umbmark u = umbmark(squares(TrueRobot::with(1.004, 1.01), nominal_odometry()), nominal_odometry());
  const double alpha = (u.cw.centroid_x_m + u.ccw.centroid_x_m) / (-4 * 4);
  const double beta = (u.cw.centroid_x_m - u.ccw.centroid_x_m) / (-4 * 4);
  const double R = (4.0 / 2) / std::sin(beta / 2);
  constexpr double kRoundOff = 1e-12;
  EXPECT_NEAR(u.endpoint.alpha_rad, alpha, kRoundOff);
  EXPECT_NEAR(u.endpoint.beta_rad, beta, kRoundOff);
  EXPECT_NEAR(u.endpoint.e_d, (R + 0.17) / (R - 0.17), kRoundOff);
  EXPECT_NEAR(u.endpoint.e_b, 90 / (90 - degrees(alpha)), kRoundOff);
  EXPECT_NEAR(u.endpoint.left_factor, 2 / (u.endpoint.e_d + 1), kRoundOff);
  EXPECT_NEAR(u.endpoint.right_factor, 2 / (1 / u.endpoint.e_d + 1), kRoundOff);
  EXPECT_NEAR(u.endpoint_y.alpha_rad, (u.cw.centroid_y_m - u.ccw.centroid_y_m) / (-4 * 4), kRoundOff);
  EXPECT_NEAR(u.endpoint_y.beta_rad, (u.cw.centroid_y_m + u.ccw.centroid_y_m) / (-4 * 4), kRoundOff);
}

// The end-point form is a small-angle approximation: errors ten times smaller, differences a hundred times smaller.
TEST(Umbmark, EndpointFormsAgreeWithTheHeadingsToFirstOrder) {
  constexpr double kSecondOrder = 70;  // of 100; the third order is some per cent of the second
  const auto differences = [](double size) {
    const Umbmark u =
        umbmark(squares(TrueRobot::with(1 + 0.0004 * size, 1 + 0.001 * size), nominal_odometry()), nominal_odometry());
    return std::array{
        std::abs(u.endpoint.alpha_rad - u.heading.alpha_rad), std::abs(u.endpoint.beta_rad - u.heading.beta_rad),
        std::abs(u.endpoint_y.alpha_rad - u.heading.alpha_rad), std::abs(u.endpoint_y.beta_rad - u.heading.beta_rad)};
  };
  const auto small = differences(1), large = differences(10);
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(large[i] / small[i], kSecondOrder) << i;
    EXPECT_LT(small[i], 1e-4);
  }
}

TEST(Umbmark, TypeAIsTheWheelbaseTypeBTheDiameters) {
  const Umbmark a = umbmark(squares(TrueRobot::with(1, 1.01), nominal_odometry()), nominal_odometry());
  EXPECT_NEAR(a.type_a_share, 1, kTicks_m);
  EXPECT_NEAR(a.cw.heading_rad, -a.ccw.heading_rad, kTicks_m);
  const Umbmark b = umbmark(squares(TrueRobot::with(1.01, 1), nominal_odometry()), nominal_odometry());
  EXPECT_NEAR(b.type_b_share, 1, kTicks_m);
  EXPECT_NEAR(b.cw.heading_rad, b.ccw.heading_rad, kTicks_m);
  EXPECT_EQ(umbmark(squares({}, nominal_odometry()), nominal_odometry()).heading.e_d, 1);
}

// The factors of all three forms turn unequal wheels into equal ones, about their mean.
TEST(Umbmark, FactorsMakeTheWheelsEqual) {
  constexpr double kRoundOff = 1e-12;
  const Umbmark u = umbmark(squares(TrueRobot::with(1.02, 0.97), nominal_odometry()), nominal_odometry());
  for (const ErrorEstimate& e : {u.endpoint, u.endpoint_y, u.heading}) {
    EXPECT_GT(e.e_d, 1.005);
    EXPECT_NEAR(e.right_factor / e.left_factor, e.e_d, kRoundOff);
    EXPECT_NEAR(e.right_factor + e.left_factor, 2, kRoundOff);
  }
}

TEST(Umbmark, SharesOfTheTypesAreThoseOfTheirSizes) {
  for (const auto& [e_d, e_b] : {std::pair{1.004, 1.01}, {0.996, 1.01}, {1.004, 0.99}, {0.996, 0.99}}) {
    const Umbmark u = umbmark(squares(TrueRobot::with(e_d, e_b), nominal_odometry()), nominal_odometry());
    const double a = std::abs(u.heading.alpha_rad), b = std::abs(u.heading.beta_rad);
    EXPECT_DOUBLE_EQ(u.type_a_share, a / (a + b));
    EXPECT_DOUBLE_EQ(u.type_b_share, b / (a + b));
  }
  const Umbmark exact = umbmark(squares(TrueRobot::with(1, 1), nominal_odometry()), nominal_odometry());
  EXPECT_EQ(exact.type_a_share, 0) << "of round-off there are no shares";
  EXPECT_EQ(exact.type_b_share, 0);
}

// Lecture 7.4: a wheelbase that makes turns of 87 degrees and legs that bend by the missing 3.
TEST(Umbmark, OneWayTheTwoErrorsHideEachOther) {
  const double E_b = 90.0 / 87, bend = radians(3);
  const double k = bend * E_b * 0.340 / (2 * 4);  // a leg bends by 2 L k / b with k = (1 - E_d) / (1 + E_d)
  const Umbmark u = umbmark(squares(TrueRobot::with((1 - k) / (1 + k), E_b), nominal_odometry()), nominal_odometry());
  std::cout << "one-way trap: cw " << 1000 * u.cw.r_cg_m << " mm, ccw " << 1000 * u.ccw.r_cg_m << " mm\n";
  EXPECT_LT(u.cw.r_cg_m, 0.001);
  EXPECT_GT(u.ccw.r_cg_m, 0.5);
}

// Seen in a mirror cw is ccw and left is right: alpha stays, beta changes its sign, E_d becomes its inverse.
TEST(Umbmark, MirroredRobotSwapsTheClusters) {
  constexpr double kRoundOff = 1e-7;
  const auto measure = [](double e_d) {
    return umbmark(squares(TrueRobot::with(e_d, 1.02), nominal_odometry()), nominal_odometry());
  };
  const Umbmark u = measure(1.005), mirror = measure(1 / 1.005);
  EXPECT_NEAR(u.cw.centroid_x_m, mirror.ccw.centroid_x_m, kRoundOff);
  EXPECT_NEAR(u.cw.centroid_y_m, -mirror.ccw.centroid_y_m, kRoundOff);
  EXPECT_NEAR(u.cw.heading_rad, -mirror.ccw.heading_rad, kRoundOff);
  EXPECT_NEAR(u.endpoint.alpha_rad, mirror.endpoint.alpha_rad, kRoundOff);
  EXPECT_NEAR(u.endpoint.beta_rad, -mirror.endpoint.beta_rad, kRoundOff);
  EXPECT_NEAR(u.endpoint.e_d * mirror.endpoint.e_d, 1, kRoundOff);
  EXPECT_NEAR(u.heading.e_d * mirror.heading.e_d, 1, kRoundOff);
  EXPECT_NEAR(u.heading.e_b, mirror.heading.e_b, kRoundOff);
}

TEST(ReturnError, DoesNotDependOnWhereTheSquareLies) {
  const TrueRobot robot = TrueRobot::with(1.003, 0.99);
  const ReturnError here = return_error(square_run(robot, nominal_odometry(), true), nominal_odometry());
  const ReturnError there =
      return_error(square_run(robot, nominal_odometry(), true, 4, 0, PlanePose{{3, -7}, 2.2}), nominal_odometry());
  EXPECT_NEAR(here.x_m, there.x_m, kTicks_m);
  EXPECT_NEAR(here.y_m, there.y_m, kTicks_m);
  EXPECT_NEAR(here.theta_rad, there.theta_rad, kTicks_m);
}

TEST(Cluster, CentroidSpreadAndStandardError) {
  const Cluster c = cluster({{"a", 1, 10, 0.1}, {"b", 2, 14, 0.3}, {"c", 6, 12, 0.2}});
  constexpr double kRoundOff = 1e-12;
  EXPECT_NEAR(c.centroid_x_m, 3, kRoundOff);
  EXPECT_NEAR(c.centroid_y_m, 12, kRoundOff);
  EXPECT_NEAR(c.heading_rad, 0.2, kRoundOff);
  EXPECT_NEAR(c.r_cg_m, std::sqrt(153.0), kRoundOff);
  EXPECT_NEAR(c.sd_x_m, std::sqrt(7.0), kRoundOff);  // (4 + 1 + 9) / 2
  EXPECT_NEAR(c.sd_y_m, 2, kRoundOff);
  EXPECT_NEAR(c.sd_heading_rad, 0.1, kRoundOff);
  EXPECT_NEAR(c.sd_m, std::sqrt((7.0 + 4) / 2), kRoundOff);
  EXPECT_NEAR(c.standard_error_m, c.sd_m / std::sqrt(3.0), kRoundOff);
  EXPECT_EQ(cluster({{"a", 1, 2, 3}}).sd_m, 0);
}

void expect_refused(const Recording& recording, const std::string& message) {
  try {
    umbmark(recording, nominal_odometry());
    ADD_FAILURE() << "accepted; expected: " << message;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(message), std::string::npos) << e.what();
  }
}

TEST(Cluster, OfTwoRunsAndOfOne) {
  const Cluster two = cluster({{"a", 0.01, 0.02, 0.1}, {"b", 0.03, -0.02, 0.3}});
  EXPECT_DOUBLE_EQ(two.sd_x_m, 0.02 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(two.sd_y_m, 0.04 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(two.sd_heading_rad, 0.2 / std::sqrt(2.0));
  const Cluster one = cluster({{"a", 0.03, 0.04, 0.1}});
  EXPECT_DOUBLE_EQ(one.r_cg_m, 0.05);
  EXPECT_EQ(one.sd_m, 0);
  EXPECT_EQ(one.standard_error_m, 0);
}

TEST(Umbmark, WhatCannotBeMeasuredIsRefused) {
  Recording recording = squares({}, nominal_odometry());
  recording.runs.pop_back();
  expect_refused(recording, "both directions, there is no ccw run");
  recording.path.shape = "circle";
  expect_refused(recording, "path.shape: UMBmark needs squares, this recording has 'circle'");
  recording = squares({}, nominal_odometry());
  recording.runs[1].truth.resize(1);
  expect_refused(recording, "run ccw: no absolute pose at start and end");
  EXPECT_THROW(umbmark(Cluster{}, Cluster{}, 4, 0.34), std::invalid_argument);
}

struct Published {
  const char* recording;
  double cw_x, cw_y, cw_heading, ccw_x, ccw_y, ccw_heading, e_max, e_d, e_b;
};

TEST(Umbmark, RealRobotToTheLastDigitGiven) {
  for (const Published& p :
       {Published{"optiodom-square-0.75m", -10.9, -6.2, 1.71, -23.2, 19.7, -2.97, 30.5, 0.99890, 1.00729},
        Published{"optiodom-square-1.7m", -15.3, -16.9, 3.05, -67.1, 79.9, -5.81, 104.4, 0.99910, 1.00778}}) {
    const auto folder = std::filesystem::path(UMBSIM_SHARED_DIR) / "recordings" / p.recording;
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the recordings are not there: " << folder;
    const Recording recording = read_recording(folder);
    const RecordedRobot& r = recording.robot;
    const Umbmark u = umbmark(recording, {r.wheel_radius_m, r.wheel_radius_m, r.wheelbase_m, r.ticks_per_revolution});
    EXPECT_NEAR(1000 * u.cw.centroid_x_m, p.cw_x, kHalfLastDigit * 0.1);
    EXPECT_NEAR(1000 * u.cw.centroid_y_m, p.cw_y, kHalfLastDigit * 0.1);
    EXPECT_NEAR(degrees(u.cw.heading_rad), p.cw_heading, kHalfLastDigit * 0.01);
    EXPECT_NEAR(1000 * u.ccw.centroid_x_m, p.ccw_x, kHalfLastDigit * 0.1);
    EXPECT_NEAR(1000 * u.ccw.centroid_y_m, p.ccw_y, kHalfLastDigit * 0.1);
    EXPECT_NEAR(degrees(u.ccw.heading_rad), p.ccw_heading, kHalfLastDigit * 0.01);
    EXPECT_NEAR(1000 * u.e_max_syst_m, p.e_max, kHalfLastDigit * 0.1);
    EXPECT_NEAR(u.endpoint.e_d, p.e_d, kHalfLastDigit * 1e-5);
    EXPECT_NEAR(u.endpoint.e_b, p.e_b, kHalfLastDigit * 1e-5);
    std::cout << p.recording << ": E_max " << 1000 * u.e_max_syst_m << " mm, E_d " << u.endpoint.e_d << ", E_b "
              << u.endpoint.e_b << "\n";
  }
}

}  // namespace
}  // namespace umbsim

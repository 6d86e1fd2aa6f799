// Encoders: resolution, sampling, missed counts and latency, by closed form and by relation.
#include <iostream>

#include "tests/effects/drives.h"
#include "tests/umbmark/exact_kinematics.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::kRadius_m;
using testing::kWheelbase_m;
using testing::nominal_odometry;
using testing::run_of;
using testing::segments;
using testing::square_run;
using testing::text;

constexpr double kCountRounding_m = 2e-6,
                 kCountRounding_rad = 2e-6;  // contact mobility, rounding of 1e6 ticks per revolution
constexpr double kSigmas = 4;                // of a seeded experiment: once in 16 000

double tick_m(double ticks) { return 2 * M_PI * kRadius_m / ticks; }

// Each wheel's count is at most half a tick off, so the heading is at most tick / b off, anywhere on the way.
TEST(EncoderResolution, HeadingIsWithinATick) {
  double last = 0;
  for (const double ticks : {50.0, 200.0, 800.0, 3200.0}) {
    const ExperimentResult r = drive(fmt::format("encoder_resolution: {{ticks_per_revolution: {}}}", ticks));
    double sum = 0, worst = 0;
    int n = 0;
    for (const RecordedRun& run : r.recording.runs) {
      // The recording counts in the ticks that the scenario believes in, several at once.
      OdometryParameters recorded = r.odometry;
      recorded.ticks_per_revolution = r.recording.robot.ticks_per_revolution;
      EXPECT_LE(std::abs(std::remainder(double(run.encoders.back().left_ticks), recorded.ticks_per_revolution / ticks)),
                0.5);
      const std::vector<Pose2> odometry = testing::calculated(run, recorded);
      for (const TruthSample& t : run.truth) {
        const double e = t.X_WB.theta_rad - odometry[std::size_t(std::lround(t.time_s * 50))].theta_rad;
        sum += e * e, worst = std::max(worst, std::abs(e)), ++n;
      }
    }
    const double bound = tick_m(ticks) / kWheelbase_m, rms = std::sqrt(sum / n);
    std::cout << fmt::format("{} ticks: heading within {:.5f} of the bound {:.5f} rad, rms {:.6f}; return {}\n", ticks,
                             worst / bound, bound, rms, text(r.cw.errors[0]));
    EXPECT_EQ(r.odometry.ticks_per_revolution, ticks) << "the odometry knows";
    EXPECT_LE(worst, bound + kCountRounding_rad);
    EXPECT_LE(std::abs(r.cw.heading_rad), bound + kCountRounding_rad);
    if (last > 0) {
      EXPECT_LT(rms, last / 2) << "four times the ticks";
    }
    last = rms;
  }
}

TEST(EncoderSampling, LatchesAtItsInterval) {
  EncoderSpec spec;
  spec.ticks_per_revolution = 1000;
  spec.sampling_interval_s = 0.1;
  Encoder encoder(spec, {}, RandomStream(1, "test"));
  for (int k = 0; k <= 100; ++k) {
    const double latch_s = k / 5 * 0.1;  // 50 Hz: every fifth reading
    EXPECT_EQ(encoder.read(k * 0.02, k * 0.02 * 3), ticks(spec, latch_s * 3)) << k;
  }
}

// A shaft at constant speed: how far the counts are behind says how old they are.
TEST(EncoderSampling, CountsAreAsOldAsTheyAreSaidToBeInTheMean) {
  constexpr double kPeriod_s = 0.02, kSpeed_radps = 3;
  constexpr int kReadings = 20000;
  for (const double interval_s : {0.015, 0.02, 0.0222, 0.03, 0.04, 0.05, 0.1, 0.33}) {
    EncoderSpec spec;
    spec.ticks_per_revolution = 1e9;
    spec.sampling_interval_s = interval_s;
    Encoder encoder(spec, {}, RandomStream(1, "test"));
    double behind_rad = 0;
    for (int k = 0; k < kReadings; ++k) {
      const double angle_rad = kSpeed_radps * k * kPeriod_s;
      const auto counts = double(encoder.read(k * kPeriod_s, angle_rad));
      behind_rad += angle_rad - counts * 2 * M_PI / spec.ticks_per_revolution;
    }
    const double age_s = behind_rad / kReadings / kSpeed_radps;
    std::cout << fmt::format("interval {} s: {:.3f} ms old, {:.3f} foretold\n", interval_s, 1e3 * age_s,
                             1e3 * mean_latch_age_s(interval_s, kPeriod_s));
    const double cut_short_s = interval_s * interval_s / (2 * kReadings * kPeriod_s);  // the last latch
    EXPECT_NEAR(age_s, mean_latch_age_s(interval_s, kPeriod_s), cut_short_s + 1e-9) << interval_s;
  }
}

// Straight legs and turns in place are arcs of constant curvature, which the odometry's chord form integrates exactly
// whatever the interval. (Longer ones than this and the driver, who acts on stale poses, begins to swing and skids.)
TEST(EncoderSampling, CostsNothingWhereCurvatureIsConstant) {
  for (const double interval_s : {0.02, 0.06, 0.1}) {
    const ExperimentResult r = drive(fmt::format("encoder_sampling: {{interval_s: {}}}", interval_s));
    std::cout << fmt::format("interval {} s: return {}\n", interval_s, text(r.ccw.errors[0]));
    EXPECT_LT(r.ccw.r_cg_m, kCountRounding_m);
    EXPECT_LT(std::abs(r.ccw.heading_rad), kCountRounding_rad);
  }
}

// A clothoid: one wheel at constant speed, the other faster and faster. Returns how far the odometry of latched counts
// ends from the exact curve, which is integrated here in a hundred thousand small pieces.
double clothoid_error(double interval_s) {
  constexpr double kEnd_s = 4, kPeriod_s = 0.001;
  const auto left = [](double t) { return 4 * t; };
  const auto right = [](double t) { return 4 * t + 0.5 * t * t; };
  EncoderSpec spec;
  spec.ticks_per_revolution = 1e9;
  spec.sampling_interval_s = interval_s;
  Encoder l(spec, {}, RandomStream(1, "l")), r(spec, {}, RandomStream(1, "r"));
  DeadReckoning odometry({kRadius_m, kRadius_m, kWheelbase_m, spec.ticks_per_revolution}, {});
  for (int k = 0; k <= std::lround(kEnd_s / kPeriod_s); ++k) {
    const double t = k * kPeriod_s;
    odometry.update(l.read(t, left(t)), r.read(t, right(t)));
  }
  double x = 0, y = 0;
  constexpr int kPieces = 100000;
  for (int i = 0; i < kPieces; ++i) {
    const double t = (i + 0.5) * kEnd_s / kPieces, heading = kRadius_m * (right(t) - left(t)) / kWheelbase_m;
    const double speed = kRadius_m * (4 + 0.5 * t);
    x += speed * std::cos(heading) * kEnd_s / kPieces, y += speed * std::sin(heading) * kEnd_s / kPieces;
  }
  return std::hypot(odometry.pose().x_m - x, odometry.pose().y_m - y);
}

TEST(EncoderSampling, ErrsWithTheSquareOfTheIntervalWhereCurvatureChanges) {
  double last = 0;
  for (const double interval_s : {0.4, 0.2, 0.1}) {
    const double error_m = clothoid_error(interval_s);
    std::cout << fmt::format("clothoid, interval {} s: {:.6f} mm\n", interval_s, 1e3 * error_m);
    if (last > 0) {
      EXPECT_NEAR(last / error_m, 4, 0.1);
    }
    last = error_m;
  }
}

// A wheel that misses counts with probability p seems to be 1 - p times as large, that is the others are 1 / (1 - p)
// times what the odometry believes: in the mean, the exact kinematics of such a robot.
TEST(EncoderMissedCounts, AreARadiusErrorInTheMean) {
  constexpr double kTicks = 20000, kWay_m = 16 + 4 * M_PI / 2 * kWheelbase_m / 2;
  constexpr int kRuns = 5;
  for (const auto& [left, right] : {std::pair{0.0, 0.002}, {0.005, 0.0}, {0.003, 0.003}}) {
    const ExperimentResult r =
        drive(fmt::format("encoder_missed_counts: {{left_probability: {}, right_probability: {}}}", left, right),
              {fmt::format("encoders.ticks_per_revolution={}", kTicks), fmt::format("runs.per_direction={}", kRuns)});
    // Each missed tick turns the robot by tick / b; their number scatters as N p (1 - p).
    const double sd_rad =
        tick_m(kTicks) / kWheelbase_m * std::sqrt(kWay_m / tick_m(kTicks) * (left * (1 - left) + right * (1 - right)));
    for (const bool cw : {true, false}) {
      const ReturnError oracle = return_error(
          square_run({kRadius_m / (1 - left), kRadius_m / (1 - right), kWheelbase_m}, nominal_odometry(), cw),
          nominal_odometry());
      const Cluster& c = cw ? r.cw : r.ccw;
      const double se_rad = sd_rad / std::sqrt(kRuns) + 1e-5;
      std::cout << fmt::format(
          "missed {}, {} {}: ({:.3f}, {:.3f}) mm, {:.4f} deg (sd {:.4f}, expected {:.4f}); exact {}\n", left, right,
          cw ? "cw" : "ccw", 1e3 * c.centroid_x_m, 1e3 * c.centroid_y_m, degrees(c.heading_rad),
          degrees(c.sd_heading_rad), degrees(sd_rad), text(oracle));
      EXPECT_NEAR(c.heading_rad, oracle.theta_rad, kSigmas * se_rad);
      // A heading error that grows along 16 m moves the end by at most half of it times the diagonal and back.
      EXPECT_NEAR(c.centroid_x_m, oracle.x_m, kSigmas * se_rad * 4);
      EXPECT_NEAR(c.centroid_y_m, oracle.y_m, kSigmas * se_rad * 4);
      EXPECT_GT(c.sd_heading_rad, sd_rad / 3);
      EXPECT_LT(c.sd_heading_rad, sd_rad * 2.5);
    }
  }
}

// At the probability k w the leg is short by k times the mean of w, weighted with the way: w (1 - ramp v / (3 L)).
TEST(EncoderMissedCounts, GrowWithSpeed) {
  constexpr double k = 0.001, kTicks = 100000, kSquare_m = 4;
  for (const double v : {0.1, 0.2, 0.4}) {
    const ExperimentResult r = drive(fmt::format("encoder_missed_counts: {{probability_per_radps: {}}}", k),
                                     {fmt::format("encoders.ticks_per_revolution={}", kTicks), "runs.directions=[ccw]",
                                      fmt::format("course.linear_speed_mps={}", v)});
    const Segment leg = segments(r, Direction::ccw)[0];
    const double short_m = testing::truth_at(run_of(r, "ccw-1"), testing::rest_after(leg, 0.1)).x_m - kSquare_m;
    const double p = k * v / kRadius_m * (1 - leg.ramp_s * v / (3 * kSquare_m));
    const double sd_m = std::sqrt(p / kSquare_m / tick_m(kTicks) / 2) * kSquare_m * tick_m(kTicks);
    std::cout << fmt::format("{} m/s: leg too long by {:.4f} mm, expected {:.4f} +- {:.4f}\n", v, 1e3 * short_m,
                             1e3 * kSquare_m * p / (1 - p), 1e3 * sd_m);
    EXPECT_NEAR(short_m, kSquare_m * p / (1 - p), kSigmas * sd_m + 0.01 * kSquare_m * p);
  }
}

TEST(EncoderLatency, ReadingsAreThatOld) {
  EncoderSpec spec;
  spec.latency_s = 0.06;
  Encoder encoder(spec, {}, RandomStream(1, "test"));
  for (int k = 0; k <= 100; ++k) {
    const double then_s = std::max(0, k - 3) * 0.02;
    EXPECT_EQ(encoder.read(k * 0.02, k * 0.02 * 3), ticks(spec, then_s * 3)) << k;
  }
}

// The turn of a driver who reads headings `delay` periods late, alone with his own law: the reference's motion and six
// times the heading's error. Returns how far the robot is at most beyond the turn's angle.
double overshoot(const Plan& plan, const Segment& turn, int delay) {
  constexpr double T = 0.02, kGain = 6;
  std::vector<double> heading{0};
  const int first = int(std::floor(turn.start_s / T)), last = int((turn.start_s + turn.duration_s) / T) + 25;
  for (int k = first; k < last; ++k) {
    const double now = plan.at(k * T).X_SB.theta_rad, next = plan.at((k + 1) * T).X_SB.theta_rad;
    const double seen = heading[std::size_t(std::max(0, k - first - delay))];
    heading.push_back(heading.back() + (next - now) + T * kGain * (now - seen));
  }
  return *std::max_element(heading.begin(), heading.end()) - turn.angle_rad;
}

TEST(EncoderLatency, TurnsOvershootAndNothingIsLeftAtTheReturn) {
  for (const double acceleration : {1.5, 15.0}) {
    for (const int delay : {1, 2, 5}) {
      const double delay_s = delay * 0.02;
      const ExperimentResult r =
          drive(fmt::format("encoder_latency: {{seconds: {}}}", delay_s),
                {"truth.rate_hz=50", fmt::format("course.angular_acceleration_radps2={}", acceleration)});
      const Plan plan(r.scenario.course, Direction::ccw);
      const Segment& turn = plan.segments()[1];
      double most = 0;
      for (const TruthSample& t : run_of(r, "ccw-1").truth) {
        if (t.time_s > turn.start_s && t.time_s < turn.start_s + turn.duration_s + 0.5) {
          most = std::max(most, t.X_WB.theta_rad - turn.angle_rad);
        }
      }
      const double expected = overshoot(plan, turn, delay), full = 0.7 * delay_s;
      std::cout << fmt::format(
          "delay {} s, {} rad/s2: overshoot {:.4f} mrad, driver alone {:.4f}, speed x delay {:.1f}; "
          "return {}\n",
          delay_s, acceleration, 1e3 * most, 1e3 * expected, 1e3 * full, text(r.ccw.errors[0]));
      EXPECT_NEAR(most, expected, 1e-4);
      if (acceleration > 10) {
        EXPECT_NEAR(most, full, 0.1 * full) << "a sudden stop";
      }
      EXPECT_LT(r.ccw.r_cg_m, kCountRounding_m);
      EXPECT_LT(std::abs(r.ccw.heading_rad), kCountRounding_rad);
    }
  }
}

}  // namespace
}  // namespace umbsim

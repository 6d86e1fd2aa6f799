// The chapters of docs/fidelity.md on a coarse grid, with limits a little above the measured figures.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "bench/fidelity/contact/cone.h"
#include "bench/fidelity/contact/loads.h"
#include "bench/fidelity/energy.h"
#include "bench/fidelity/plane_dynamics.h"
#include "bench/fidelity/rolling.h"
#include "bench/fidelity/steps.h"
#include "core/pose2.h"

namespace umbsim::fidelity {
namespace {

std::vector<RobotModel> robots() { return {labmate(), optiodom()}; }

// Rigid contacts creep by 1e-9 m/s per newton.
constexpr double kCreep = 1e-6;

TEST(Cone, BrakedRobotSlidesStraightDownhill) {
  // The springs settle after the robot is set down on the slope, while it already slides: it leans for some ms.
  constexpr double kSettling_rad = 5e-4, kSettling = 1e-5;
  for (const RobotModel& robot : robots()) {
    for (const double heading_rad : slide_headings(Grid::coarse)) {
      const DownhillSlide hard = slide_downhill(robot, heading_rad, rigid());
      EXPECT_NEAR(hard.direction_error_rad, 0, kCreep) << robot.name << ", heading " << heading_rad;
      EXPECT_NEAR(hard.turned_rad, 0, kCreep);
      EXPECT_NEAR(hard.acceleration_ratio, 1, kCreep);
      const DownhillSlide soft = slide_downhill(robot, heading_rad, {});
      EXPECT_NEAR(soft.direction_error_rad, 0, kSettling_rad);
      EXPECT_NEAR(soft.turned_rad, 0, kSettling_rad);
      EXPECT_NEAR(soft.acceleration_ratio, 1, kSettling);
    }
  }
}

TEST(Cone, TheFrictionlessBallTakesItsShare) {
  for (const RobotModel& robot : robots()) {
    for (const int sense : {1, -1}) EXPECT_NEAR(ball_share_ratio(robot, sense, rigid()), 1, kCreep);
  }
}

// Bars: model error of first order at 1 ms; what is left at step zero comes from wheels that change between rolling and
// sliding within a step.
TEST(Cone, TurnsAsAnIndependentIntegratorSays) {
  constexpr double kFine = 0.003;       // of the path, a t h / 2 and more where it turns much
  constexpr double kLimit_m = 2e-4;
  constexpr double kLimit_rad = 5e-4;
  for (const RobotModel& robot : robots()) {
    for (const bool left_free : {false, true}) {
      for (const double heading_rad : slide_headings(Grid::coarse)) {
        const TurningSlide s = slide_and_turn(robot, left_free, heading_rad);
        SCOPED_TRACE(testing::Message() << robot.name << (left_free ? ", left free" : ", braked") << ", heading "
                                        << degrees(heading_rad) << ", turns " << degrees(s.turned_rad));
        EXPECT_GT(s.least_load_n, 0) << "the integrator takes all contacts as closed";
        EXPECT_LT(s.fine_step.off_m, kFine * s.path_m);
        EXPECT_LT(s.extrapolated.off_m, kLimit_m);
        EXPECT_LT(std::abs(s.extrapolated.off_rad), kLimit_rad);
        EXPECT_LT(s.fine_step.off_m, s.default_step.off_m / 10);
      }
    }
  }
}

// The integrator itself, where there is a closed form: all supports with the same friction.
TEST(PlaneDynamics, SlidesByTheClosedForm) {
  constexpr double kSmoothed = 1e-4;  // Coulomb's law below 10 um/s of slip
  SlopeCase c{body_of(labmate()), 0.35, 0.25, {true, true}, 1.1};
  c.body.ball_friction = 0.25;
  const SlopeState end = integrate(c, 0.5);
  const double fallen_m = 0.5 * kG_mps2 * (std::sin(0.35) - 0.25 * std::cos(0.35)) * 0.25;
  EXPECT_NEAR(end.X_WB.x_m, fallen_m, kSmoothed * fallen_m);
  EXPECT_NEAR(end.X_WB.y_m, 0, kSmoothed * fallen_m);
  EXPECT_NEAR(end.X_WB.theta_rad, 1.1, kSmoothed);
}

TEST(Steps, ConvergeInFirstOrder) {
  constexpr double kOrder = 0.75;  // of a first-order method, over a range that ends near the reference step
  constexpr double kSquare_m = 1e-8;
  const Convergence square = converge(Drive::square, Grid::coarse);
  for (const StepRun& run : square.runs) EXPECT_LT(run.off_m, kSquare_m) << run.step_s << " s";
  const std::pair<Drive, double> limits[] = {{Drive::cable, 3e-4}, {Drive::uneven_floor, 1e-5},
                                             {Drive::swivelling_caster, 1e-7}, {Drive::braking_slide, 3e-4}};
  for (const auto& [drive, longest_off_m] : limits) {
    const Convergence c = converge(drive, Grid::coarse);
    EXPECT_GT(c.order, kOrder) << int(drive);
    EXPECT_LT(c.runs.front().off_m, longest_off_m) << int(drive);
  }
}

TEST(Energy, CoastingKeepsIt) {
  constexpr double kFlat = 1e-9, kSmall = 1e-3;  // of 1 ms
  for (const RobotModel& robot : robots()) {
    EXPECT_NEAR(coast(robot, Ground::flat_straight, rigid()).kept, 1, kFlat) << robot.name;
    EXPECT_NEAR(coast(robot, Ground::flat_curve, rigid(0.001)).kept, 1, kSmall) << robot.name;
    const double coarse = 1 - coast(robot, Ground::ridges, rigid(0.004)).kept;
    const double fine = 1 - coast(robot, Ground::ridges, rigid(0.001)).kept;
    EXPECT_NEAR(fine, 0, kSmall);
    EXPECT_NEAR(coarse / fine, 4, 0.8) << "first order";
  }
}

TEST(Energy, BrakingAndClimbingBalance) {
  constexpr double kBrake = 0.003, kClimb = 1e-6;  // of 1 ms: half a step's change of speed; creep
  for (const RobotModel& robot : robots()) {
    EXPECT_NEAR(braking_ratio(robot, rigid(0.001)), 1, kBrake) << robot.name;
    EXPECT_NEAR(climbing_ratio(robot, 0.087, {}), 1, kClimb) << robot.name;
  }
}

TEST(Loads, AreThoseOfStatics) {
  constexpr double kHard = 1e-7, kSoft = 5e-4;  // creep; the springs' tilt
  for (const RobotModel& robot : robots()) {
    for (const LoadGrid which :
         {LoadGrid::centre_of_mass, LoadGrid::slope, LoadGrid::payload, LoadGrid::acceleration}) {
      EXPECT_LT(check_loads(robot, which, Grid::coarse, rigid()).worst, kHard) << robot.name << " " << int(which);
      EXPECT_LT(check_loads(robot, which, Grid::coarse, {}).worst, kSoft) << robot.name << " " << int(which);
    }
  }
}

TEST(Rolling, IsRadiusTimesAngle) {
  constexpr double kOff_m = 1e-6, kOff_rad = 1e-7;  // contact creep
  for (const RobotModel& robot : robots()) {
    for (const auto& [left, right] :
         {std::pair{2.0, 2.0}, std::pair{1.9, 2.1}, std::pair{0.5, 2.0}, std::pair{-1.5, 1.5}}) {
      const RollingCheck c = roll(robot, left, right, {});
      EXPECT_LT(c.off_m, kOff_m) << robot.name << " " << left << " " << right;
      EXPECT_NEAR(c.off_rad, 0, kOff_rad);
    }
  }
}

TEST(Rolling, ToeAndSkewAreTheClosedForms) {
  constexpr double kOff_m = 1e-5;  // creep under the friction limit of 150 N for ten seconds
  for (const Skew kind : {Skew::skewed, Skew::toe_in}) {
    for (const double toe_rad : {0.01, 0.1}) {
      const ToeCheck c = roll_with_toe(kind, toe_rad);
      EXPECT_NEAR(c.along_m, c.expected_along_m, kOff_m);
      EXPECT_NEAR(c.across_m, c.expected_across_m, kOff_m);
      EXPECT_NEAR(c.turned_rad, 0, 1e-9);
    }
  }
}

TEST(Rolling, EccentricWheelRipplesAndReturns) {
  constexpr double kSmall = 0.002;  // of the ripple: second order in the step of 20 ms and in e
  for (const double e_m : {0.0005, 0.002}) {
    const EccentricCheck c = roll_eccentric(e_m, 0.02);
    EXPECT_NEAR(c.ripple_rad, c.expected_ripple_rad, kSmall * c.expected_ripple_rad);
    EXPECT_LT(c.off_rad, kSmall * c.expected_ripple_rad);
    EXPECT_LT(std::abs(c.drift_rad), c.expected_ripple_rad * c.expected_ripple_rad) << "at most second order";
  }
}

// The document is the program's: the same chapters in the same words.
TEST(Document, HasTheProgramsChapters) {
  std::ifstream file(std::string(UMBSIM_SOURCE_DIR) + "/docs/fidelity.md");
  std::ostringstream text;
  text << file.rdbuf();
  for (const std::string& chapter : {rolling_chapter(Grid::coarse), loads_chapter(Grid::coarse)}) {
    const std::string explanation = chapter.substr(0, chapter.find("\n|"));
    EXPECT_NE(text.str().find(explanation), std::string::npos) << "bench/fidelity/run makes it anew: " << explanation;
  }
}

}  // namespace
}  // namespace umbsim::fidelity

// The step of a robot that rolls (sim/rolling.cpp) is the general step to round-off: every effect's scenario and every
// robot is driven with and without it.
#include <iostream>

#include "tests/effects/drives.h"

namespace umbsim {
namespace {

using testing::shipped;

constexpr double kSame = 1e-9;  // m, rad

// Largest difference of the absolute poses. Encoders that count differently once would drive another way.
double difference(Scenario s, const std::string& what) {
  const ExperimentResult rolled = run_experiment(s, 1);
  s.physics.general_steps = true;
  const ExperimentResult general = run_experiment(s, 1);
  double most = 0;
  for (std::size_t i = 0; i < rolled.recording.runs.size(); ++i) {
    const std::vector<TruthSample>&a = rolled.recording.runs[i].truth, &b = general.recording.runs[i].truth;
    EXPECT_EQ(a.size(), b.size()) << what;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const Pose2 &p = a[k].X_WB, &q = b[k].X_WB;
      for (const double off : {p.x_m - q.x_m, p.y_m - q.y_m, p.theta_rad - q.theta_rad}) {
        most = std::max(most, std::abs(off));
      }
    }
  }
  std::cout << fmt::format("{:<28} {:.1e}; {} of {} steps slide or lift, {} without\n", what, most,
                           rolled.cost.newton_steps, rolled.cost.steps, general.cost.newton_steps);
  return most;
}

TEST(RollingStep, IsTheGeneralStepUnderEveryEffect) {
  for (const EffectInfo& info : catalogue()) {
    EXPECT_LT(difference(shipped("effects/" + info.name), info.name), kSame) << info.name;
  }
}

// Casters that swivel, one and two of them; wheels and casters on springs.
TEST(RollingStep, IsTheGeneralStepForOtherRobots) {
  const std::string urdfs = std::string(UMBSIM_SOURCE_DIR) + "/tests/sim/urdf/";
  const std::vector<std::vector<std::string>> robots{
      {"robot.urdf=" UMBSIM_SOURCE_DIR "/robots/optiodom.urdf"},
      {"robot.urdf=" + urdfs + "pioneer_like.urdf"},
      {"robot.urdf=" + urdfs + "pioneer_like.urdf", "effects={floor_slope: {slope_rad: 0.02}, tyre_creep: {}}"},
      {"robot.suspension={wheel_travel_m: 0.02, caster_travel_m: 0.02}"},
      {"robot.urdf=" + urdfs + "pioneer_like.urdf", "robot.suspension={wheel_travel_m: 0.02, caster_travel_m: 0.02}"},
  };
  for (std::vector<std::string> settings : robots) {
    settings.push_back("course.side_m=1");
    std::string what;
    for (const std::string& setting : settings) what += setting.substr(setting.rfind('/') + 1) + " ";
    EXPECT_LT(difference(shipped("nominal", settings), what), kSame) << what;
  }
}

// Motors that give way, with what loads them, with play and at their limits.
TEST(RollingStep, IsTheGeneralStepOnMotorsThatGiveWay) {
  const std::vector<std::string> effects{
      "motor_response: {droop_radps_per_nm: 0.2}",
      "motor_response: {droop_radps_per_nm: 0.2}, caster_drag: {coefficient: 0.02, left_m: 0.05}",
      "motor_response: {droop_radps_per_nm: 0.2}, floor_slope: {slope_rad: 0.02, downhill_rad: 1}, tyre_creep: {}",
      "motor_response: {droop_radps_per_nm: 0.2}, backlash: {left_rad: 0.02, right_rad: 0.01}",
      "motor_response: {droop_radps_per_nm: 0.2, torque_limit_nm: 0.2}",
      "motor_response: {droop_radps_per_nm: 0.2}, wheel_eccentricity: {left_m: 0.002}",
      "motor_response: {droop_radps_per_nm: 0.2}, wheel_eccentricity: {left_m: 0.002}, backlash: {left_rad: 0.02}",
      "wheel_eccentricity: {left_m: 0.002, right_m: 0.001}, backlash: {left_rad: 0.02, right_rad: 0.01}",
      "wheel_eccentricity: {right_m: 0.002}, slippery_floor: {friction: 0.04}, motor_response: {droop_radps_per_nm: 2}",
      "motor_response: {droop_radps_per_nm: 0.2}, caster_swivel: {trail_m: 0.03, friction_nm: 0.2}",
  };
  for (const std::string& e : effects)
    EXPECT_LT(difference(shipped("nominal", {"course.side_m=1", "effects={" + e + "}"}), e), kSame) << e;
}

}  // namespace
}  // namespace umbsim

#include "bench/calibration/robots.h"

#include <algorithm>
#include <cmath>

#include "experiment/drive/drive_run.h"
#include "experiment/scenario/robots.h"
#include "experiment/sweep/design.h"

namespace umbsim::bench {
namespace {

Effect effect(const char* name, double relative) {
  Effect e = neutral_effect(find_effect(name));
  for (std::size_t i = 0; i < e.info->parameters.size(); ++i) {
    if (e.info->parameters[i].name == "relative") e.values.numbers[i] = relative;
  }
  return e;
}

double between(double low, double high, double share) { return low + (high - low) * share; }

}  // namespace

std::vector<ProofRobot> proof_robots(int count, std::uint64_t seed) {
  constexpr std::size_t kAxes = 7;
  const std::vector<double> cube = latin_hypercube(count, kAxes, seed);
  std::vector<ProofRobot> robots;
  for (int i = 0; i < count; ++i) {
    const double* at = &cube[std::size_t(i) * kAxes];
    robots.push_back({between(-0.01, 0.01, at[0]), between(-0.05, 0.05, at[1]), between(-0.01, 0.01, at[2]),
                      between(0.0001, 0.0008, at[3]), between(1, 4, at[4]), between(0.0001, 0.003, at[5]),
                      between(0.0001, 0.003, at[6]), seed * 100000 + std::uint64_t(i)});
  }
  return robots;
}

Scenario proof_scenario(const ProofRobot& robot) {
  Scenario s;
  s.name = "proof";
  s.seed = robot.seed;
  s.encoders.ticks_per_revolution = 20000;
  s.encoders.rate_hz = 20;
  s.course.side_m = robot.side_m;
  s.noise.wheel_noise_m_per_sqrt_m = robot.wheel_noise;
  s.truth.position_sd_m = robot.position_sd_m;
  s.truth.heading_sd_rad = robot.heading_sd_rad;
  s.calibration.method = Calibrate::none;
  s.effects = {effect("wheel_radius_difference", robot.ratio), effect("wheelbase", robot.wheelbase),
               effect("wheel_radius_scale", robot.scale)};
  return s;
}

Scenario on_circles(Scenario scenario) {
  scenario.course.shape = "circle";
  scenario.course.radius_m = scenario.course.side_m / 2;
  return scenario;
}

calibration::LogFactors true_factors(const Scenario& scenario) {
  Scenario quiet = scenario;
  quiet.noise = {};
  const RobotModel nominal = load_scenario_robot(scenario);
  const Rig rig = rig_for(quiet, nominal, {"true", Direction::cw, false, 0});
  return {std::log(rig.robot.wheels[0].radius_m / nominal.wheels[0].radius_m),
          std::log(rig.robot.wheels[1].radius_m / nominal.wheels[1].radius_m),
          std::log(rig.robot.wheelbase_m() / nominal.wheelbase_m())};
}

}  // namespace umbsim::bench

// Every effect seen in a mirror, and from another start heading.
#include <iostream>
#include <map>

#include "tests/effects/drives.h"

namespace umbsim {
namespace {

using testing::expect_near;
using testing::shipped;
using testing::text;

// Round-off that grows along 16 m; where wheels slide or plays open and close, the solver's tolerance (1e-6).
constexpr double kMirror = 1e-6, kTurned = 1e-6;
constexpr double kRotated_rad = 0.7;

double& value(Effect& effect, const std::string& parameter) {
  for (std::size_t i = 0; i < effect.info->parameters.size(); ++i) {
    if (effect.info->parameters[i].name == parameter) return effect.values.numbers[i];
  }
  throw std::runtime_error(effect.info->name + " has no " + parameter);
}

// Parameters of the left and right wheel, exchanged in the mirror.
const std::map<std::string, std::vector<std::pair<const char*, const char*>>> kExchanged{
    {"wheel_misalignment", {{"left_toe_rad", "right_toe_rad"}}},
    {"wheel_eccentricity", {{"left_m", "right_m"}, {"left_phase_rad", "right_phase_rad"}}},
    {"wear", {{"left_relative_per_run", "right_relative_per_run"}}},
    {"backlash", {{"left_rad", "right_rad"}}},
};
// Angles and places to the left, negated in the mirror.
const std::map<std::string, std::vector<const char*>> kNegated{
    {"wheel_misalignment", {"left_toe_rad", "right_toe_rad"}},
    {"load_shift", {"left_m"}},
    {"caster_swivel", {"initial_angle_rad"}},
    {"caster_drag", {"left_m"}},
    {"slippery_patch", {"y_m"}},
    {"bump", {"y_m", "direction_rad"}},
    {"floor_slope", {"downhill_rad"}},
    {"carpet_drift", {"direction_rad"}},
    {"push", {"direction_rad"}},
    {"wheel_lift", {"y_m"}},
};
// Ratios of right over left, 1 + value, inverted in the mirror.
const std::map<std::string, const char*> kInverted{{"wheel_radius_difference", "relative"},
                                                   {"motor_response", "gain_asymmetry"}};
// Floor-frame directions and places, turned with the start heading.
const std::map<std::string, const char*> kFloorDirections{
    {"bump", "direction_rad"}, {"floor_slope", "downhill_rad"}, {"carpet_drift", "direction_rad"}};
const std::vector<std::string> kFloorPlaces{"slippery_patch", "bump", "wheel_lift"};
// Each wheel and each place on an uneven floor has its own random numbers: no mirror image, no turned one.
bool random_by_wheel(const std::string& effect) { return effect == "encoder_missed_counts"; }
bool random_by_place(const std::string& effect) { return effect == "uneven_floor"; }

void mirror(Effect& e) {
  const std::string& name = e.info->name;
  if (kExchanged.count(name)) {
    for (const auto& [left, right] : kExchanged.at(name)) std::swap(value(e, left), value(e, right));
  }
  if (kNegated.count(name)) {
    for (const char* parameter : kNegated.at(name)) value(e, parameter) *= -1;
  }
  if (kInverted.count(name)) {
    double& ratio = value(e, kInverted.at(name));
    ratio = 1 / (1 + ratio) - 1;
  }
  if (!e.values.run.empty()) e.values.run = e.values.run.substr(0, 3) == "ccw" ? "cw-1" : "ccw-1";
}

void turn(Effect& e) {
  const std::string& name = e.info->name;
  if (kFloorDirections.count(name)) value(e, kFloorDirections.at(name)) += kRotated_rad;
  if (std::find(kFloorPlaces.begin(), kFloorPlaces.end(), name) == kFloorPlaces.end()) return;
  const Pose2 place = Pose2{0, 0, kRotated_rad} * Pose2{value(e, "x_m"), value(e, "y_m"), 0};
  value(e, "x_m") = place.x_m, value(e, "y_m") = place.y_m;
}

// The effect's own scenario, with values of both wheels where it has them.
Scenario scenario(const EffectInfo& info) {
  Scenario s = shipped("effects/" + info.name);
  for (Effect& e : s.effects) {
    if (e.info->name == "wheel_misalignment") value(e, "left_toe_rad") = -0.002;
    if (e.info->name == "wheel_eccentricity") value(e, "left_m") = 0.0005, value(e, "right_phase_rad") = 0.4;
    if (e.info->name == "caster_drag") value(e, "left_m") = 0.04;
    if (e.info->name == "caster_swivel") value(e, "initial_angle_rad") = 0.5;
    if (e.info->name == "backlash") value(e, "left_rad") = 0.01;
  }
  s.runs.per_direction = 1;
  return s;
}

TEST(EveryEffect, MirroredRobotOnTheOtherSquareErrsInTheMirror) {
  for (const EffectInfo& info : catalogue()) {
    if (random_by_wheel(info.name) || random_by_place(info.name)) continue;
    Scenario s = scenario(info);
    // Wear counts the runs: both directions drive their square as the second one.
    if (info.name == "wear") s.runs.directions = {Direction::cw, Direction::ccw};
    const ExperimentResult there = run_experiment(s, 1);
    for (Effect& e : s.effects) mirror(e);
    if (info.name == "wear") s.runs.directions = {Direction::ccw, Direction::cw};
    const ExperimentResult here = run_experiment(s, 1);
    for (const bool cw : {true, false}) {
      const ReturnError& a = (cw ? there.cw : there.ccw).errors[0];
      const ReturnError b = testing::mirrored((cw ? here.ccw : here.cw).errors[0]);
      std::cout << fmt::format("{:<24} {:<4}{}; mirrored: off by {:.1e} m, {:.1e} rad\n", info.name, cw ? "cw" : "ccw",
                               text(a), std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), std::abs(a.theta_rad - b.theta_rad));
      expect_near(a, b, kMirror, kMirror, info.name);
    }
  }
}

TEST(EveryEffect, IsTheSameFromAnotherStartHeadingWithItsFloor) {
  for (const EffectInfo& info : catalogue()) {
    if (random_by_place(info.name)) continue;
    Scenario s = scenario(info);
    const ExperimentResult there = run_experiment(s, 1);
    s.runs.start_heading_rad = kRotated_rad;
    for (Effect& e : s.effects) turn(e);
    const ExperimentResult here = run_experiment(s, 1);
    for (const bool cw : {true, false}) {
      const ReturnError &a = (cw ? there.cw : there.ccw).errors[0], &b = (cw ? here.cw : here.ccw).errors[0];
      std::cout << fmt::format("{:<24} {:<4}{}; turned: off by {:.1e} m, {:.1e} rad\n", info.name, cw ? "cw" : "ccw",
                               text(a), std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), std::abs(a.theta_rad - b.theta_rad));
      expect_near(a, b, kTurned, kTurned, info.name);
    }
  }
}

// A floor-frame effect that does not turn with the robot is another one.
TEST(FloorEffects, ChangeWithTheStartHeading) {
  for (const char* name : {"slippery_patch", "bump", "floor_slope", "carpet_drift", "wheel_lift", "uneven_floor"}) {
    Scenario s = scenario(find_effect(name));
    const ReturnError a = run_experiment(s, 1).ccw.errors[0];
    s.runs.start_heading_rad = kRotated_rad;
    const ReturnError b = run_experiment(s, 1).ccw.errors[0];
    std::cout << name << ": " << text(a) << "; turned robot " << text(b) << "\n";
    EXPECT_GT(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), 1e-3) << name;
  }
}

}  // namespace
}  // namespace umbsim

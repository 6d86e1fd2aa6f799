// Scenario files: what is read, what is refused and how, and that the resolved text means the same.
#include "experiment/scenario/scenario.h"

#include <gtest/gtest.h>

#include <iostream>

#include "experiment/run.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::shipped;
using testing::shipped_file;
using testing::TemporaryFolder;

const std::string kFormat = "format: umbsim-scenario/1\n";

Scenario read(const std::string& text, const std::vector<std::string>& settings = {}) {
  const TemporaryFolder folder;
  return read_scenario(folder.write("case.yaml", text), settings);
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts,
                    const std::vector<std::string>& settings = {}) {
  try {
    read(text, settings);
    ADD_FAILURE() << "accepted:\n" << text;
  } catch (const InputError& e) {
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << "'" << part << "' is not in: " << e.what();
    }
  }
}

TEST(Scenario, DefaultsAreTheLabmatesSquare) {
  const Scenario s = read(kFormat);
  EXPECT_EQ(s.name, "case");
  EXPECT_EQ(s.robot.urdf, "labmate.urdf");
  EXPECT_EQ(s.course.side_m, 4);
  EXPECT_EQ(s.runs.directions.size(), 2u);
  EXPECT_EQ(s.runs.per_direction, 5);
  EXPECT_FALSE(s.bumps.any());
  EXPECT_TRUE(s.effects.empty());
  EXPECT_EQ(s.calibration.method, Calibrate::heading);
}

TEST(Scenario, UnknownKeysNameTheNearest) {
  expect_refused(kFormat + "course:\n  side: 4\n", {"case.yaml:3:", "course.side", "did you mean 'side_m'"});
  expect_refused(kFormat + "corse: {}\n", {"case.yaml:2:", "corse", "did you mean 'course'"});
  expect_refused(kFormat + "effects:\n  wheelbas: {relative: 0.1}\n",
                 {"case.yaml:3:", "effects.wheelbas", "did you mean 'wheelbase'"});
}

TEST(Scenario, DuplicateKeysAreErrors) {
  expect_refused(kFormat + "seed: 1\nseed: 2\n", {"case.yaml:3:", "seed", "duplicate key (first on line 2)"});
  expect_refused(kFormat + "course:\n  side_m: 4\n  side_m: 3\n", {"case.yaml:4:", "course.side_m", "duplicate"});
}

TEST(Scenario, OutOfRangeNamesKeyValueAndBound) {
  struct Case {
    const char *text, *key, *value, *bound;
  };
  for (const Case& c : {
           Case{"course: {side_m: 0}", "course.side_m", "0", "> 0"},
           Case{"course: {side_m: 2000}", "course.side_m", "2000", "1000"},
           Case{"course: {laps: 0}", "course.laps", "0", "1"},
           Case{"course: {linear_speed_mps: -1}", "course.linear_speed_mps", "-1", "> 0"},
           Case{"course: {dwell_s: -0.1}", "course.dwell_s", "-0.1", "0"},
           Case{"runs: {per_direction: 0}", "runs.per_direction", "0", "1"},
           Case{"encoders: {ticks_per_revolution: 0.5}", "encoders.ticks_per_revolution", "0.5", "1"},
           Case{"encoders: {rate_hz: 1e6}", "encoders.rate_hz", "1e6", "10000"},
           Case{"floor: {friction: 0}", "floor.friction", "0", "> 0"},
           Case{"noise: {floor_rms_m: -0.001}", "noise.floor_rms_m", "-0.001", "0"},
           Case{"truth: {position_sd_m: -1}", "truth.position_sd_m", "-1", "0"},
           Case{"physics: {step_s: 0}", "physics.step_s", "0", "> 0"},
           Case{"physics: {gravity_mps2: -9.81}", "physics.gravity_mps2", "-9.81", "> 0"},
           Case{"odometry: {wheelbase_m: 0}", "odometry.wheelbase_m", "0", "> 0"},
           Case{"calibration: {max_passes: 0}", "calibration.max_passes", "0", "1"},
           Case{"bumps: {count: -1}", "bumps.count", "-1", "0"},
           Case{"bumps: {leg: 5}", "bumps.leg", "5", "4"},
           Case{"robot: {caster_friction: 3}", "robot.caster_friction", "3", "2"},
           Case{"effects: {wheelbase: {relative: 2}}", "effects.wheelbase.relative", "2", "0.5"},
           Case{"seed: -1", "seed", "-1", "0"},
       }) {
    expect_refused(kFormat + c.text + "\n", {"case.yaml:2:", c.key, c.value, c.bound});
  }
}

TEST(Scenario, WrongKindsAndChoicesAreErrors) {
  expect_refused(kFormat + "course: {side_m: four}\n", {"case.yaml:2:", "course.side_m", "four"});
  expect_refused(kFormat + "course: {side_m: .inf}\n", {"course.side_m"});
  expect_refused(kFormat + "course: {side_m: .nan}\n", {"course.side_m"});
  expect_refused(kFormat + "course: {turn: arcs}\n", {"course.turn", "arcs", "in_place", "arc"});
  expect_refused(kFormat + "course: {laps: 1.5}\n", {"course.laps", "1.5"});
  expect_refused(kFormat + "course: [1, 2]\n", {"case.yaml:2:", "course"});
  expect_refused(kFormat + "runs: {directions: [cw, cw]}\n", {"case.yaml:2:", "runs.directions", "twice"});
  expect_refused(kFormat + "runs: {directions: []}\n", {"runs.directions", "cw, ccw or both"});
  expect_refused(kFormat + "course: {turn: arc, side_m: 1, turn_radius_m: 0.5}\n",
                 {"course.turn_radius_m: 0.5", "side_m = 1", "side_m / 2"});
  expect_refused("format: umbsim-scenario/2\n", {"case.yaml:1:", "format", "umbsim-scenario/2", "umbsim-scenario/1"});
  expect_refused(kFormat + "name: ../up\n", {"case.yaml:2:", "name"});
}

TEST(Scenario, MissingPartsAreErrors) {
  expect_refused(kFormat + "bumps:\n  cables:\n    - {x_m: 1}\n", {"case.yaml:4:", "bumps.cables", "y_m"});
  expect_refused("", {"case.yaml", "empty"});
  EXPECT_THROW(read_scenario("/nonexistent/file.yaml"), InputError);
  Scenario s = read(kFormat + "robot: {urdf: no_such_robot.urdf}\n");
  EXPECT_THROW(load_scenario_robot(s), InputError);
}

TEST(Scenario, ResolvedTextMeansTheSame) {
  for (const char* name : {"umbmark", "labmate_exact", "nominal", "extended_umbmark", "unidirectional_trap"}) {
    const Scenario s = shipped(name);
    const std::string resolved = resolved_yaml(s);
    EXPECT_EQ(resolved_yaml(read(resolved)), resolved) << name;
    EXPECT_NE(resolved.find("name: " + std::string(name)), std::string::npos);
  }
}

// Every key away from its default, in numbers that no shorter decimal stands for.
TEST(Scenario, ResolvedTextKeepsEveryKeyToTheLastBit) {
  const std::string text = kFormat + R"(name: "a: #b"
description: "quotes \" and: colons"
seed: 9223372036854775807
robot: {urdf: optiodom.urdf, left_joint: l, right_joint: r, caster_friction: 0.1, torque_limit_nm: 3.3}
encoders: {ticks_per_revolution: 2796.8, rate_hz: 33.3}
floor: {friction: 0.7000000000000001}
course: {side_m: 0.1, turn: arc, turn_radius_m: 0.03, linear_speed_mps: 0.30000000000000004, angular_speed_radps: 0.7,
  linear_acceleration_mps2: 0.1234567890123456, angular_acceleration_radps2: 1e-3, dwell_s: 0, laps: 2}
runs: {directions: [ccw], per_direction: 3, start_heading_rad: -0.1}
bumps: {wheel: outer, leg: 7, count: 3, height_m: 0.009, cables: [{x_m: 1e-7, y_m: -2, height_m: 0.01, length_m: 0.3}]}
noise: {floor_rms_m: 0.0003, floor_wavelength_m: 0.31, radius_scatter: 0.00001}
truth: {kind: endpoints, rate_hz: 11, position_sd_m: 0.002, heading_sd_rad: 0.007}
odometry: {left_radius_m: 0.0751, wheelbase_m: 0.3333333333333333}
calibration: {method: endpoint, max_passes: 4}
physics: {step_s: 0.004, fine_step_s: 0.0007, gravity_mps2: 1.62, static_sink_m: 0.0002, damping_ratio: 0.5}
effects: {wheelbase: {relative: -0.011264705882352899}, wheel_radius_scale: {relative: 1e-17}}
)";
  const Scenario s = read(text);
  const std::string resolved = resolved_yaml(s);
  const Scenario again = read(resolved);
  EXPECT_EQ(resolved_yaml(again), resolved);
  EXPECT_EQ(again.name, "a: #b");
  EXPECT_EQ(again.description, s.description);
  EXPECT_EQ(again.seed, s.seed);
  EXPECT_EQ(again.floor_friction, 0.7000000000000001);
  EXPECT_EQ(again.course.linear_speed_mps, 0.30000000000000004);
  EXPECT_EQ(again.course.laps, 2);
  EXPECT_EQ(again.odometry.wheelbase_m.value(), 0.3333333333333333);
  EXPECT_FALSE(again.odometry.right_radius_m);
  EXPECT_EQ(again.bumps.fixed.at(0).x_m, 1e-7);
  EXPECT_EQ(again.bumps.fixed.at(0).direction_rad, M_PI / 2);
  EXPECT_EQ(again.bumps.laid.wheel, BumpWheel::outer);
  EXPECT_EQ(again.physics.softness.damping_ratio, 0.5);
  ASSERT_EQ(again.effects.size(), 2u);
  EXPECT_EQ(again.effects[1].values.numbers, s.effects[1].values.numbers);
}

TEST(Scenario, SettingsReplaceAndAdd) {
  const Scenario s = read(kFormat + "course: {side_m: 4}\n",
                          {"course.side_m=2", "course.laps=3", "effects.wheelbase.relative=0.01", "name=other"});
  EXPECT_EQ(s.course.side_m, 2);
  EXPECT_EQ(s.course.laps, 3);
  EXPECT_EQ(s.name, "other");
  ASSERT_EQ(s.effects.size(), 1u);
  EXPECT_EQ(s.effects[0].values.numbers[0], 0.01);
  EXPECT_EQ(read(kFormat, {"runs.directions=[ccw]"}).runs.directions.size(), 1u);
}

TEST(Scenario, BadSettingsAreErrors) {
  expect_refused(kFormat, {"--set side", "key.path=value"}, {"side"});
  expect_refused(kFormat, {"--set =3"}, {"=3"});
  expect_refused(kFormat, {"--set course..side_m=3", "empty part"}, {"course..side_m=3"});
  expect_refused(kFormat + "seed: 3\n", {"'seed' is not a map"}, {"seed.x=3"});
  expect_refused(kFormat, {"course.side", "did you mean 'side_m'"}, {"course.side=3"});
  expect_refused(kFormat, {"course.side_m", "-1"}, {"course.side_m=-1"});
  expect_refused(kFormat, {"--set course.side_m=[1"}, {"course.side_m=[1"});
}

TEST(Scenario, InjectedErrorsAreThoseOfTheFile) {
  const Scenario s = shipped("labmate_exact");
  const RobotModel nominal = load_scenario_robot(s);
  const InjectedErrors injected =
      injected_errors(rig_for(s, nominal, {"cw-1", Direction::cw, false, 0}), initial_odometry(s, nominal));
  EXPECT_NEAR(injected.e_d, 1.00084, 1e-15);
  EXPECT_NEAR(injected.e_b, 336.17 / 340, 1e-15);
}

TEST(Scenario, ShapesOfTheCourseAreReadAndWritten) {
  for (const std::string course :
       {"{shape: circle, radius_m: 0.75}", "{shape: figure_eight, radius_m: 2, laps: 3}",
        "{shape: path, waypoints_m: [[2, 0], [2, 1.5], [0, 0]], turn: arc, turn_radius_m: 0.3}"}) {
    const Scenario s = read(kFormat + "course: " + course + "\n");
    EXPECT_EQ(s.calibration.method, Calibrate::none) << "UMBmark is of squares";
    const std::string resolved = resolved_yaml(s);
    EXPECT_EQ(resolved_yaml(read(resolved)), resolved);
    EXPECT_NE(resolved.find("shape: " + s.course.shape), std::string::npos);
  }
  const Scenario path = read(kFormat + "course: {shape: path, waypoints_m: [[2, -1]]}\n");
  ASSERT_EQ(path.course.waypoints.size(), 1u);
  EXPECT_EQ(path.course.waypoints[0].y_m, -1);
}

TEST(Scenario, CoursesThatCannotBeDrivenAreRefused) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_refused(kFormat + text + "\n", parts);
  };
  refused("course: {shape: circle, radius_m: 0}", {"case.yaml:2:", "course.radius_m", "> 0"});
  refused("course: {shape: circle, radius_m: -1}", {"course.radius_m", "-1"});
  refused("course: {radius_m: 1}", {"course.radius_m", "only of shape circle or figure_eight"});
  refused("course: {shape: circle, waypoints_m: [[1, 0]]}", {"course.waypoints_m", "only of shape path"});
  refused("course: {shape: path}", {"waypoints_m", "needs waypoints"});
  refused("course: {shape: path, waypoints_m: [[1, 0], [1, 0.001]]}", {"course.waypoints_m", "waypoint 2", "0.001", "0.01"});
  refused("course: {shape: path, waypoints_m: [[1]]}", {"course.waypoints_m[0]", "two numbers"});
  refused("course: {shape: path, waypoints_m: [[1, 0], [1, 0.2], [0, 0]], turn: arc, turn_radius_m: 0.3}",
          {"course.turn_radius_m", "does not fit"});
  refused("course: {shape: oval}", {"course.shape", "oval", "figure_eight"});
  refused("course: {shape: circle}\nbumps: {count: 3}", {"bumps", "squares only"});
  refused("course: {shape: circle}\ncalibration: {method: heading}", {"calibration.method", "none"});
  refused("course: {shape: figure_eight}\nfixes: [{leg: 3}]", {"fixes", "leg"});
}

}  // namespace
}  // namespace umbsim

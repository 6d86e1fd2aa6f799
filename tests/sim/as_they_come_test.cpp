// URDFs with what public ones are like: each drives as it comes, is completed and says how, or is refused for a reason
// that matters. The files in urdf/as_they_come are this project's own.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/urdf_text.h"

namespace umbsim {
namespace {

struct Robot {
  const char* file;
  double radius_m, track_m, mass_kg;
  std::size_t casters;
  std::vector<std::string> says;  ///< in remarks
};

const std::vector<Robot>& robots() {
  static const std::vector<Robot> all = {
      {"floating_world_root", 0.06, 0.32, 8 + 2 * 0.3 + 0.1, 1, {"held at position zero: world_joint"}},
      {"wheels_about_z", 0.09, 0.44, 12 + 1.6, 1, {}},
      {"balls_for_wheels",
       0.033,
       0.16,
       1.2 + 2 * 0.05 + 0.02 + 0.05,
       1,
       {"roller_joint", "friction in Gazebo, whose wheel does not swivel: taken as a ball"}},
      {"twin_wheel_caster", 0.08, 0.4, 25 + 0.6 + 0.3 + 0.6, 1, {"rear_swivel", "2 wheels on one axle, taken as one"}},
      {"mesh_caster",
       0.1,
       0.5,
       40 + 0.6 + 0.6,
       1,
       {"caster_back_2_joint", "radius 0.04 m, which is the height of its"}},
      {"cad_faces_y", 0.04, 0.2, 2.1 + 0.24, 1, {"Revolute 1", "the robot faces +y", "its visual cylinder"}},
      {"windows_file", 0.05, 0.24, 3.4, 1, {}},
      {"latin1", 0.05, 0.24, 3.6, 1, {}},
      {"wheels_without_mass", 0.05, 0.24, 5.25, 1, {"wheel_left_link", "without mass; taken as a uniform disc"}},
      {"inertias_of_one", 0.05, 0.24, 6.6, 1, {"left_wheel", "more than the whole robot's mass at its rim"}},
      {"revolute_wheels", 0.04, 0.2, 2.6, 1, {"base_to_wheel1", "revolute joint with limits"}},
      {"manipulator", 0.1, 0.5, 60 + 4 + 0.4 + 8 + 2 + 0.02 + 0.3, 2, {"<capsule>", "finger", "lidar_spin", "coaxial"}},
      {"limited_swivels", 0.05, 0.4, 15 + 0.6 + 0.4, 2, {"front_caster_wheel_joint", "a caster by its name"}},
      {"grams", 0.033, 0.16, 1280, 1, {"are the masses in grams?"}},
      {"clone/urdf/mesh_wheels", 0.045, 0.3, 4.6, 1, {"what bounds its mesh"}},
  };
  return all;
}

std::string path_of(const std::string& name) {
  return std::string(UMBSIM_SOURCE_DIR) + "/tests/sim/urdf/as_they_come/" + name + ".urdf";
}

TEST(AsTheyCome, AreDrivenOrCompletedAndSaid) {
  constexpr double kRounded = 1e-6;  // of the files' numbers
  for (const Robot& expected : robots()) {
    SCOPED_TRACE(expected.file);
    std::vector<Remark> remarks;
    RobotModel robot;
    try {
      robot = load_robot(path_of(expected.file), {}, {}, &remarks);
    } catch (const InputError& e) {
      ADD_FAILURE() << e.what();
      continue;
    }
    EXPECT_NEAR(robot.wheels[0].radius_m, expected.radius_m, kRounded);
    EXPECT_NEAR(robot.wheels[1].radius_m, expected.radius_m, kRounded);
    EXPECT_NEAR(robot.wheelbase_m(), expected.track_m, kRounded);
    EXPECT_NEAR(robot.total_mass_kg(), expected.mass_kg, kRounded);
    EXPECT_EQ(robot.casters.size(), expected.casters);
    std::string said;
    for (const Remark& r : remarks) said += r.text + "\n";
    for (const std::string& word : expected.says) {
      EXPECT_NE(said.find(word), said.npos) << "no '" << word << "' in: " << said;
    }
    if (expected.says.empty()) {
      EXPECT_EQ(said.find("taken as"), said.npos) << said;
    }
  }
}

TEST(AsTheyCome, RefusedForWhatMatters) {
  const std::vector<std::pair<const char*, std::vector<const char*>>> refused = {
      {"millimetres", {"left_wheel_joint", "wheel radius 50 m", "[0.001, 2]", "millimetres"}},
      {"car", {"front_left_joint", "steered, by joint 'left_steer'", "a car is no differential drive"}},
      {"four_wheels_mimic", {"four driven wheels", "skid steering"}},
      {"omni", {"not collinear"}},
      {"balancing", {"link 'body'", "falls over: no third support"}},
  };
  for (const auto& [file, words] : refused) {
    SCOPED_TRACE(file);
    const std::string message = testing::refusal_of_file(path_of(file));
    EXPECT_NE(message.find(std::string(file) + ".urdf"), message.npos) << message;
    for (const char* word : words) EXPECT_NE(message.find(word), message.npos) << "no '" << word << "' in: " << message;
  }
}

// By hand: two wheels of 0.3 kg at 14 mm on either side of the middle, which swivels 25 mm behind its axis.
TEST(AsTheyCome, TwinWheelsTurnAsOne) {
  const RobotModel robot = load_robot(path_of("twin_wheel_caster"));
  const Caster& c = robot.casters.at(0);
  EXPECT_TRUE(c.swivels);
  EXPECT_NEAR((c.centre_m - Eigen::Vector3d(-0.275, 0, -0.045)).norm(), 0, 1e-12);
  EXPECT_NEAR(c.radius_m, 0.035, 1e-12);
  EXPECT_NEAR(c.wheel_mass_kg, 0.6, 1e-12);
  EXPECT_NEAR(c.wheel_spin_inertia_kgm2, 2 * 2e-4, 1e-12);
  EXPECT_NEAR(c.wheel_transverse_inertia_kgm2, 2 * (1e-4 + 0.3 * 0.014 * 0.014), 1e-12);
}

TEST(AsTheyCome, TwinsMustBeBesideEachOther) {
  EXPECT_NE(testing::refusal(testing::with(
                                 [] {
                                   std::ifstream in(path_of("twin_wheel_caster"));
                                   return std::string(std::istreambuf_iterator<char>(in), {});
                                 }(),
                                 "-0.025 -0.014 -0.065", "-0.045 -0.014 -0.065"))
                .find("not beside the first on one axle"),
            std::string::npos);
}

}  // namespace
}  // namespace umbsim

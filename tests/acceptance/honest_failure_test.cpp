// Robots that tip over, control loops that are too slow, effects that change nothing, output that cannot be written:
// what the program says of them.
#include <cmath>
#include <regex>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

/// A robot whose heavy part stands high above its axle: wheels of 0.1 m, 0.4 m apart, a ball 0.3 m ahead.
const char* const kTall = R"(<robot name="tall">
<link name="hull">
  <inertial><origin xyz="0.02 0 0.35"/><mass value="10"/>
    <inertia ixx="0.3" ixy="0" ixz="0" iyy="0.3" iyz="0" izz="0.2"/></inertial>
</link>
<link name="wheel_l">
  <inertial><mass value="1"/><inertia ixx="0.003" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.003"/></inertial>
  <collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
</link>
<joint name="jl" type="continuous"><parent link="hull"/><child link="wheel_l"/>
  <origin xyz="0 0.2 0"/><axis xyz="0 1 0"/></joint>
<link name="wheel_r">
  <inertial><mass value="1"/><inertia ixx="0.003" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.003"/></inertial>
  <collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
</link>
<joint name="jr" type="continuous"><parent link="hull"/><child link="wheel_r"/>
  <origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/></joint>
<link name="ball"><collision><geometry><sphere radius="0.03"/></geometry></collision></link>
<joint name="jb" type="fixed"><parent link="hull"/><child link="ball"/><origin xyz="0.3 0 -0.07"/></joint>
</robot>
)";

// By hand: 12 kg whose centre is 10 0.02 / 12 m ahead of the axle and 0.1 + 10 0.35 / 12 m above the floor, wheels
// whose spin takes 2 0.005 / 0.1 kg m: m g x = (m h + J / R) a.
constexpr double kTallStands_mps2 = 9.81 * 0.2 / (12 * 0.1 + 3.5 + 0.1);

/// The number after `before` in a text; fails the test if there is none.
double number_after(const std::string& text, const std::string& before) {
  const auto at = text.find(before);
  EXPECT_NE(at, std::string::npos) << "'" << before << "' is missing in: " << text;
  return at == std::string::npos ? NAN : std::stod(text.substr(at + before.size()));
}

class TippingRobot : public testing::Test {
 protected:
  void SetUp() override { desk_.put("tall.urdf", kTall); }
  Outcome drive(double acceleration, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"run",
                                   shipped("nominal"),
                                   "--out",
                                   "out",
                                   "--force",
                                   "--set",
                                   "robot.urdf=" + (desk_.home / "tall.urdf").string(),
                                   "--set",
                                   "course.linear_acceleration_mps2=" + std::to_string(acceleration)};
    words.insert(words.end(), more.begin(), more.end());
    return desk_.umbsim(words);
  }
  Desk desk_;
};

TEST_F(TippingRobot, FailsWithWhatItStandsAndLeavesNothing) {
  const Outcome tipped = drive(0.6);
  EXPECT_EQ(tipped.code, kRunFailed);
  EXPECT_EQ(tipped.out, "");
  expect_says(tipped.err, {"tall.urdf", "run cw-1", "tips over backwards", "on leg 1 (speeding up)", "0.6 m/s^2",
                           "caster ball off the floor", "lower course.linear_acceleration_mps2 to "});
  EXPECT_EQ(listing(desk_.home), (std::set<std::string>{"tall.urdf"}));
  const double stands = number_after(tipped.err, "it stands ");
  EXPECT_NEAR(stands, kTallStands_mps2, 0.005 * kTallStands_mps2);
}

constexpr double kNear = 0.03;

TEST_F(TippingRobot, StandsTheAccelerationThatIsAdvisedAndNoMoreThanItIsSaidToStand) {
  const std::string message = drive(0.6).err;
  const Outcome advised = drive(number_after(message, "lower course.linear_acceleration_mps2 to "));
  EXPECT_EQ(advised.code, 0) << advised.err;
  EXPECT_EQ(drive((1 + kNear) * number_after(message, "it stands ")).code, kRunFailed);
}

// By hand: on the spot, from rest, the moments about the axle are those of the weight ahead of it, and of what lies to
// the left and above: m g x = alpha m y z, summed over hull and payload. The fall begins as the turn does.
TEST_F(TippingRobot, InATurnOnTheSpotItIsTheTurnThatIsNamed) {
  constexpr double kStands_radps2 = 9.81 * (10 * 0.02 + 10 * 0.03) / (10 * 0.12 * (0.1 + 0.35));
  const auto turn = [&](double acceleration) {
    return drive(0.1, {"--set", "course.angular_speed_radps=8", "--set",
                       "course.angular_acceleration_radps2=" + std::to_string(acceleration), "--set",
                       "effects.load_shift.payload_kg=10", "--set", "effects.load_shift.ahead_m=0.03", "--set",
                       "effects.load_shift.left_m=0.12", "--set", "effects.load_shift.height_m=0.35"});
  };
  const Outcome tipped = turn(1.1 * kStands_radps2);
  EXPECT_EQ(tipped.code, kRunFailed);
  expect_says(tipped.err, {"tips over backwards", "in the turn after leg 1 (speeding up)", "9.9916", "rad/s^2",
                           "lower course.angular_acceleration_radps2 to "});
  EXPECT_NEAR(number_after(tipped.err, "it stands "), kStands_radps2, 0.005 * kStands_radps2);
  EXPECT_EQ(turn(number_after(tipped.err, "lower course.angular_acceleration_radps2 to ")).code, 0);
}

// Rigid supports, and a driver that follows its course to a millisecond: the balance of moments to 1 %.
TEST_F(TippingRobot, RigidItTipsOverWhereTheMomentsSay) {
  const std::vector<std::string> rigid{"--set", "physics={static_sink_m: 0, step_s: 0.001}",
                                       "--set", "encoders.rate_hz=1000",
                                       "--set", "course.side_m=1"};
  const Outcome below = drive(0.99 * kTallStands_mps2, rigid);
  EXPECT_EQ(below.code, 0) << below.err;
  EXPECT_EQ(drive(1.01 * kTallStands_mps2, rigid).code, kRunFailed);
}

// What an effect makes of the course's acceleration is taken back for the key.
TEST_F(TippingRobot, UnderOverAccelerationTheKeysOwnValueIsNamed) {
  const Outcome tipped = drive(0.15, {"--set", "effects.over_acceleration.factor=4"});
  EXPECT_EQ(tipped.code, kRunFailed);
  const double most = number_after(tipped.err, "lower course.linear_acceleration_mps2 to ");
  EXPECT_NEAR(4 * most, number_after(drive(0.6).err, "lower course.linear_acceleration_mps2 to "), 0.004);
}

TEST_F(TippingRobot, TheSameRunIsNamedWhateverTheNumberOfThreads) {
  const std::string one = drive(0.6, {"-j", "1"}).err;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(drive(0.6, {"-j", "8"}).err, one);
}

TEST_F(TippingRobot, IsAFailedPointOfASweep) {
  desk_.put("sweep.yaml", "format: umbsim-sweep/1\nscenario: " + shipped("nominal") +
                              "\nset: {robot.urdf: " + (desk_.home / "tall.urdf").string() +
                              "}\naxes: {course.linear_acceleration_mps2: [0.2, 0.6]}\n");
  const Outcome swept = desk_.umbsim({"sweep", "sweep.yaml", "--out", "s"});
  EXPECT_EQ(swept.code, kRunFailed);
  expect_says(swept.out, {"1 of 2 points driven, 1 failed", "tips over backwards"});
}

// The robot of the issue: its battery and lidar stand high, its casters near the axle.
TEST(TurtleBot4, TipsOverAsItSaysAndNotBelow) {
  const fs::path urdf = fs::path(UMBSIM_SHARED_DIR) / "robots/turtlebot4.urdf";
  if (!fs::exists(urdf)) GTEST_SKIP() << urdf << " is not there";
  const Desk desk;
  const auto drive = [&](double acceleration) {
    return desk.umbsim({"run", shipped("nominal"), "--out", "out", "--force", "--set", "robot.urdf=" + urdf.string(),
                        "--set", "course.linear_acceleration_mps2=" + std::to_string(acceleration)});
  };
  const Outcome tipped = drive(0.25);
  EXPECT_EQ(tipped.code, kRunFailed);
  expect_says(tipped.err, {"tips over backwards", "front_caster_link off the floor"});
  const Outcome advised = drive(number_after(tipped.err, "lower course.linear_acceleration_mps2 to "));
  EXPECT_EQ(advised.code, 0) << advised.err;
  EXPECT_EQ(drive((1 + kNear) * number_after(tipped.err, "it stands ")).code, kRunFailed);
}

// Below and above each limit that the message names.
struct SlowLoop {
  std::string key;
  double slow;  // far beyond the limit
  bool at_least;
};

class ControlLoop : public testing::TestWithParam<SlowLoop> {};

TEST_P(ControlLoop, IsRefusedWithTheLimitAtWhichItWorks) {
  const Desk desk;
  const SlowLoop& loop = GetParam();
  const auto drive = [&](double value) {
    // Gently: counts that are held let the driver jump after its course.
    return desk.umbsim({"run", shipped("nominal"), "--out", "out", "--force", "--set",
                        loop.key + "=" + std::to_string(value), "--set", "course.linear_speed_mps=0.1", "--set",
                        "course.angular_speed_radps=0.3"});
  };
  const Outcome refused = drive(loop.slow);
  EXPECT_EQ(refused.code, kBadInput);
  expect_says(refused.err, {"nominal.yaml", loop.key, "control loop", "Hz", "too slow"});
  EXPECT_EQ(listing(desk.home), std::set<std::string>{});
  const double limit = number_after(refused.err, loop.at_least ? "(must be >= " : "(must be <= ");
  const Outcome works = drive(limit);
  EXPECT_EQ(works.code, 0) << works.err;
  EXPECT_EQ(drive(limit * (loop.at_least ? 0.97 : 1.1)).code, kBadInput);
}

INSTANTIATE_TEST_SUITE_P(All, ControlLoop,
                         testing::Values(SlowLoop{"encoders.rate_hz", 2, true},
                                         SlowLoop{"effects.encoder_sampling.interval_s", 0.4, false},
                                         SlowLoop{"effects.encoder_latency.seconds", 0.4, false},
                                         SlowLoop{"effects.motor_response.lag_s", 1.5, false},
                                         SlowLoop{"effects.motor_response.droop_radps_per_nm", 20, false}),
                         [](const auto& loop) {
                           return std::regex_replace(loop.param.key, std::regex("[^a-z]"), "_");
                         });

TEST(SilentEffects, AreNamedWithWhatWouldMakeThemAct) {
  const Desk desk;
  const Outcome silent =
      desk.umbsim({"run", desk.put("short.yaml", kShortScenario).string(), "--out", "out", "--set", "effects.bump={}",
                   "--set", "effects.push={run: cw-9, impulse_newton_seconds: 5}"});
  EXPECT_EQ(silent.code, 0);
  expect_says(silent.err, {"warning: effects.bump changes nothing as it is given: set effects.bump.height_m",
                           "warning: effects.push changes nothing: no run is called 'cw-9'"});
  EXPECT_EQ(silent.err.find("wheelbase"), std::string::npos) << silent.err;
  EXPECT_EQ(json_of(desk.home / "out/summary.json").at("warnings").size(), 2u);
}

TEST(SilentEffects, EffectsThatActAreNotNamed) {
  const Desk desk;
  const Outcome outcome = desk.umbsim({"run", desk.put("short.yaml", kShortScenario).string(), "--out", "out", "--set",
                                       "effects.bump={height_m: 0.005}"});
  EXPECT_EQ(outcome.err, "");
  EXPECT_FALSE(json_of(desk.home / "out/summary.json").contains("warnings"));
}

TEST(FullDisk, StandardOutputThatCannotBeWrittenIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Desk desk;
  for (const std::string arguments : {"effects", "effects bump", "--help", "--version", "sweep --help"}) {
    const Outcome outcome = desk.shell(shell_quoted(UMBSIM_PROGRAM) + " " + arguments + " > /dev/full");
    EXPECT_EQ(outcome.code, kRunFailed) << arguments;
    expect_says(outcome.err, {"standard output cannot be written"});
  }
}

}  // namespace
}  // namespace umbsim::acceptance

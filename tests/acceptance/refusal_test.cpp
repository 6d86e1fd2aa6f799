// Bad input: one clear message that names file, line, key, value and bound; exit code 2; nothing written.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

/// Runs the program on `desk` and expects it to refuse, saying `parts`, in one line, and to write nothing.
void expect_refusal(const Desk& desk, const std::vector<std::string>& words, const std::vector<std::string>& parts) {
  const std::set<std::string> before = listing(desk.home);
  const Outcome outcome = desk.umbsim(words);
  EXPECT_EQ(outcome.code, kBadInput) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("umbsim: ", 0), 0u) << outcome.err;
  expect_says(outcome.err, parts);
  EXPECT_EQ(listing(desk.home), before) << "something was left behind";
}

/// A scenario file's text and what the program must say of it.
struct BadScenario {
  const char* what;
  const char* text;
  std::vector<std::string> says;
};

const BadScenario kBadScenarios[] = {
    {"UnknownKey",
     "format: umbsim-scenario/1\ncourse: {side_m: 2}\ncours: {side_m: 2}\n",
     {"bad.yaml:3:1: ", "cours", "unknown key", "did you mean 'course'?"}},
    {"UnknownInnerKey",
     "format: umbsim-scenario/1\ncourse:\n  side_m: 2\n  side: 3\n",
     {"bad.yaml:4:3: ", "course.side", "did you mean 'side_m'?"}},
    {"DuplicateKey",
     "format: umbsim-scenario/1\ncourse: {side_m: 2}\ncourse: {side_m: 3}\n",
     {"bad.yaml:3:1: ", "course", "duplicate key"}},
    {"DuplicateInnerKey",
     "format: umbsim-scenario/1\ncourse:\n  side_m: 2\n  laps: 1\n  side_m: 2\n",
     {"bad.yaml:5:3: ", "side_m", "duplicate key"}},
    {"BelowRange",
     "format: umbsim-scenario/1\ncourse: {side_m: -2}\n",
     {"bad.yaml:2:18: ", "course.side_m", "-2", "must be > 0 and <= 1000"}},
    {"AboveRange",
     "format: umbsim-scenario/1\nencoders:\n  rate_hz: 1e9\n",
     {"bad.yaml:3:12: ", "encoders.rate_hz", "1e9", "must be >= 1 and <= 10000"}},
    {"NotFinite",
     "format: umbsim-scenario/1\nfloor: {friction: .nan}\n",
     {"bad.yaml:2:19: ", "floor.friction", "finite", ".nan"}},
    {"NotANumber", "format: umbsim-scenario/1\ncourse: {side_m: 4 m}\n", {"bad.yaml:2:18: ", "course.side_m", "'4 m'"}},
    {"NotAnInteger",
     "format: umbsim-scenario/1\nruns: {per_direction: 2.5}\n",
     {"bad.yaml:2:23: ", "runs.per_direction", "integer", "'2.5'"}},
    {"UnknownChoice",
     "format: umbsim-scenario/1\ncourse: {turn: pirouette}\n",
     {"bad.yaml:2:16: ", "course.turn", "'pirouette'", "in_place, arc"}},
    {"UnknownEffect",
     "format: umbsim-scenario/1\neffects:\n  wheelbas: {relative: 0.1}\n",
     {"bad.yaml:3:3: ", "effects.wheelbas", "did you mean 'wheelbase'?"}},
    {"EffectOutOfRange",
     "format: umbsim-scenario/1\neffects:\n  wheelbase: {relative: 7}\n",
     {"bad.yaml:3:25: ", "effects.wheelbase.relative", "7", "must be >= -0.5 and <= 0.5"}},
    {"DirectionTwice",
     "format: umbsim-scenario/1\nruns: {directions: [cw, cw]}\n",
     {"bad.yaml:2:25: ", "runs.directions[1]", "twice"}},
    {"BumpsOnNoLeg",
     "format: umbsim-scenario/1\nbumps: {leg: 5}\n",
     {"bad.yaml:2:14: ", "bumps.leg", "must be >= 1 and <= 4"}},
    {"ArcTooWide",
     "format: umbsim-scenario/1\ncourse: {turn: arc, side_m: 1, turn_radius_m: 0.5}\n",
     {"bad.yaml:2:47: ", "course.turn_radius_m: 0.5", "< side_m / 2"}},
    {"OtherFormat", "format: umbsim-scenario/9\n", {"bad.yaml:1:9: ", "format", "umbsim-scenario/1"}},
    {"NotYaml", "format: [umbsim-scenario/1\n", {"bad.yaml:"}},
    {"Empty", "", {"bad.yaml"}},
    {"NameWithSlash", "format: umbsim-scenario/1\nname: ../x\n", {"bad.yaml:2:7: ", "name", "folder name"}},
    {"MissingRobot", "format: umbsim-scenario/1\nrobot: {urdf: nobody.urdf}\n", {"nobody.urdf", "cannot be read"}},
    {"RobotIsNoUrdf", "format: umbsim-scenario/1\nrobot: {urdf: bad.yaml}\n", {"bad.yaml", "not a URDF"}},
};

class BadScenarioFile : public testing::TestWithParam<BadScenario> {};

TEST_P(BadScenarioFile, IsRefused) {
  const Desk desk;
  desk.put("bad.yaml", GetParam().text);
  expect_refusal(desk, {"run", "bad.yaml"}, GetParam().says);
}

INSTANTIATE_TEST_SUITE_P(Every, BadScenarioFile, testing::ValuesIn(kBadScenarios),
                         [](const auto& param_info) { return std::string(param_info.param.what); });

TEST(Refusal, MissingScenario) { expect_refusal(Desk(), {"run", "none.yaml"}, {"none.yaml", "No such file"}); }

TEST(Refusal, FolderInsteadOfScenario) { expect_refusal(Desk(), {"run", "."}, {"directory"}); }

TEST(Refusal, RobotWithAMasslessHull) {
  const Desk desk;
  std::string urdf = text_of(fs::path(UMBSIM_SOURCE_DIR) / "robots/labmate.urdf");
  const std::string mass = "<mass value=\"40\"/>";
  urdf.replace(urdf.find(mass), mass.size(), "<mass value=\"0\"/>");
  desk.put("broken.urdf", urdf);
  desk.put("bad.yaml", "format: umbsim-scenario/1\nrobot: {urdf: broken.urdf}\n");
  expect_refusal(desk, {"run", "bad.yaml"}, {"broken.urdf", "base_link", "mass"});
}

// The centre of mass behind the axle, the only caster ahead of it: the robot tips over.
TEST(Refusal, RobotThatDoesNotStand) {
  const Desk desk;
  std::string urdf = text_of(fs::path(UMBSIM_SOURCE_DIR) / "robots/labmate.urdf");
  const std::string ahead = "<origin xyz=\"0.06 0 0.05\"/>";
  ASSERT_NE(urdf.find(ahead), std::string::npos);
  urdf.replace(urdf.find(ahead), ahead.size(), "<origin xyz=\"-0.06 0 0.05\"/>");
  desk.put("tippy.urdf", urdf);
  desk.put("bad.yaml", "format: umbsim-scenario/1\nrobot: {urdf: tippy.urdf}\n");
  expect_refusal(desk, {"run", "bad.yaml"}, {"tippy.urdf", "does not stand", "caster"});
}

/// A setting and what the program must say of it.
struct BadSetting {
  const char* what;
  const char* setting;
  std::vector<std::string> says;
};

const BadSetting kBadSettings[] = {
    {"UnknownKey", "course.sidem=2", {"course.sidem", "unknown key", "did you mean 'side_m'?"}},
    {"OutOfRange", "course.side_m=-1", {"course.side_m", "-1", "must be > 0 and <= 1000"}},
    {"NoValue", "course.side_m", {"--set course.side_m", "key.path=value"}},
    {"EmptyValue", "course.side_m=", {"--set course.side_m=", "value is missing"}},
    {"EmptyPart", "course..side_m=2", {"--set course..side_m=2", "empty part"}},
    {"IntoAScalar", "seed.x=2", {"--set seed.x=2", "'seed' is not a map"}},
    {"DuplicateKey", "course={side_m: 1, side_m: 2}", {"--set course=", "side_m", "duplicate key"}},
    {"NotYaml", "course=[1", {"--set course=[1", "not valid YAML"}},
    {"WheelTooFast", "odometry.left_radius_m=1e-160", {"labmate.urdf", "rad/s", "must be >= -1e+06 and <= 1e+06"}},
    {"WrongType", "course=3", {"course", "expected a map", "'3'"}},
};

class BadSet : public testing::TestWithParam<BadSetting> {};

TEST_P(BadSet, IsRefused) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  expect_refusal(desk, {"run", "short.yaml", "--set", GetParam().setting}, GetParam().says);
}

INSTANTIATE_TEST_SUITE_P(Every, BadSet, testing::ValuesIn(kBadSettings),
                         [](const auto& param_info) { return std::string(param_info.param.what); });

// A line of the scenario file would be the wrong place to look for a mistake on the command line.
TEST(Refusal, ABadSettingNamesNoLineOfTheFile) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  const Outcome outcome = desk.umbsim({"run", "short.yaml", "--set", "course.side_m=-1"});
  EXPECT_EQ(outcome.err,
            "umbsim: --set course.side_m=-1: course.side_m: -1 is out of range (must be > 0 and <= 1000)\n");
}

TEST(Refusal, OfSeveralSettingsTheBadOneIsNamed) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  desk.put("bad.yaml", std::string(kShortScenario) + "floor: {friction: -1}\n");
  desk.put("sweep.yaml", "format: umbsim-sweep/1\nscenario: short.yaml\naxes: {seed: [1]}\n");
  const std::vector<std::string> good{"--set", "course.laps=2", "--set", "runs.per_direction=1"};
  const auto refusal = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), good.begin(), good.end());
    words.insert(words.end(), more.begin(), more.end());
    return desk.umbsim(words).err;
  };
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"run", "short.yaml"}, {"explain", "short.yaml"}, {"sweep", "sweep.yaml"}}) {
    expect_says(refusal(command, {"--set", "course.sidem=2", "--set", "seed=3"}),
                {"umbsim: --set course.sidem=2: course.sidem: unknown key; did you mean 'side_m'?"});
    expect_says(refusal(command, {"--set", "effects.wheelbas.relative=0"}),
                {"umbsim: --set effects.wheelbas.relative=0: effects.wheelbas: ", "did you mean 'wheelbase'?"});
  }
  // A value of the file that a setting does not fit to: both are named. One that is bad anyway: the file alone.
  expect_says(
      refusal({"run", "short.yaml"}, {"--set", "course.turn=arc", "--set", "course.turn_radius_m=1"}),
      {"umbsim: --set course.turn_radius_m=1: course.turn_radius_m: 1 does not fit into a square of side_m = 0.5"});
  EXPECT_EQ(refusal({"run", "bad.yaml"}, {}).rfind("umbsim: bad.yaml:12:19: floor.friction: -1", 0), 0u)
      << refusal({"run", "bad.yaml"}, {});
}

TEST(Set, ReplacesAndAddsValues) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  const Outcome run = desk.umbsim({"run", "short.yaml", "--out", "a", "--set", "course.side_m=0.4", "--set",
                                   "runs={directions: [cw, ccw], per_direction: 1}", "--set",
                                   "effects.wheel_radius_difference.relative=0.002"});
  ASSERT_EQ(run.code, 0) << run.err;
  expect_says(text_of(desk.home / "a/scenario.resolved.yaml"),
              {"side_m: 0.4", "per_direction: 1", "wheel_radius_difference:\n    relative: 0.002"});
  EXPECT_NEAR(json_of(desk.home / "a/summary.json").at("injected").at("e_d").get<double>(), 1.002, 1e-12);
}

// A recording with something wrong in it, made from a good one.
class BadRecording : public testing::Test {
 protected:
  void SetUp() override {
    desk_.put("short.yaml", kShortScenario);
    ASSERT_EQ(desk_.umbsim({"run", "short.yaml", "--out", "rec"}).code, 0);
  }
  void change(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = text_of(desk_.home / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    desk_.put(file, text.replace(at, from.size(), to));
  }
  Desk desk_;
};

TEST_F(BadRecording, TruncatedInTheMiddleOfARow) {
  const std::string csv = "rec/runs/cw-1/encoders.csv";
  const std::string text = text_of(desk_.home / csv);
  const std::size_t row = text.rfind('\n', text.size() / 2);
  desk_.put(csv, text.substr(0, text.find(',', row) + 1));
  expect_refusal(desk_, {"calibrate", "rec"}, {csv + ":"});
}

TEST_F(BadRecording, HeaderOnly) {
  desk_.put("rec/runs/ccw-2/truth.csv", "time_s,x_m,y_m,theta_rad\n");
  expect_refusal(desk_, {"calibrate", "rec"}, {"rec/runs/ccw-2/truth.csv", "0 rows", ">= 2"});
}

TEST_F(BadRecording, MissingFile) {
  fs::remove(desk_.home / "rec/runs/cw-2/truth.csv");
  expect_refusal(desk_, {"calibrate", "rec"}, {"rec/runs/cw-2/truth.csv", "No such file"});
}

TEST_F(BadRecording, UnknownKey) {
  change("rec/recording.yaml", "wheelbase_m:", "wheel_base_m:");
  expect_refusal(desk_, {"calibrate", "rec"}, {"rec/recording.yaml:", "wheelbase_m"});
}

TEST_F(BadRecording, OtherFormat) {
  change("rec/recording.yaml", "umbsim-recording/1", "umbsim-recording/2");
  expect_refusal(desk_, {"calibrate", "rec"}, {"rec/recording.yaml:1:9: ", "format", "umbsim-recording/1"});
}

TEST_F(BadRecording, NotASquare) {
  change("rec/recording.yaml", "shape: square\n  side_m: 0.5\n", "shape: circle\n");
  expect_refusal(desk_, {"calibrate", "rec", "--method", "endpoint"}, {"rec: endpoint needs closed squares"});
}

TEST_F(BadRecording, OneDirectionOnly) {
  std::string header = text_of(desk_.home / "rec/recording.yaml");
  header = std::regex_replace(header, std::regex(" *- \\{id: ccw-[^\n]*\n"), "");
  ASSERT_EQ(header.find("ccw"), std::string::npos) << header;
  desk_.put("rec/recording.yaml", header);
  expect_refusal(desk_, {"calibrate", "rec", "--method", "heading"}, {"heading needs squares of both directions"});
}

TEST(Refusal, AFolderThatIsNoRecording) {
  expect_refusal(Desk(), {"calibrate", "/"}, {"recording.yaml"});
  expect_refusal(Desk(), {"calibrate", "nowhere"}, {"nowhere", "not a recording"});
}

}  // namespace
}  // namespace umbsim::acceptance

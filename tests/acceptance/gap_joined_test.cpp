// Several recordings of one robot, diagnosed and predicted together.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

constexpr double kWheelbase = 0.02;  // relative, of the robot that was recorded

class GapJoined : public testing::Test {
 protected:
  void SetUp() override {
    desk.put("s.yaml", kShortScenario);
    const std::string wrong = "effects.wheelbase.relative=" + std::to_string(kWheelbase);
    ASSERT_EQ(desk.umbsim({"run", "s.yaml", "--set", wrong, "--out", "small"}).code, 0);
    ASSERT_EQ(desk.umbsim({"run", "s.yaml", "--set", wrong, "--set", "course.side_m=2", "--out", "large"}).code, 0);
  }
  json diagnosed(const std::vector<std::string>& recordings, const std::string& out) {
    std::vector<std::string> words{"gap", "diagnose", "--no-cache", "--out", out};
    words.insert(words.end(), recordings.begin(), recordings.end());
    const Outcome o = desk.umbsim(words);
    EXPECT_EQ(o.code, 0) << o.err;
    return json::parse(text_of(desk.home / out / "diagnosis.json"));
  }
  const Desk desk;
};

TEST_F(GapJoined, OneCauseForBothAndEachRecordingIsHeldOut) {
  const json d = diagnosed({"small", "large"}, "d");
  ASSERT_TRUE(d.at("causes").at(0).at("effects").contains("wheelbase")) << d.at("causes");
  const json& relative = d.at("causes").at(0).at("effects").at("wheelbase").at("relative");
  EXPECT_LE(relative.at("ci95").at(0).get<double>(), kWheelbase);
  EXPECT_GE(relative.at("ci95").at(1).get<double>(), kWheelbase);
  EXPECT_GT(d.at("closure").at("held_out_fraction").get<double>(), 0.9) << "each foretells the other";
  for (const json& s : d.at("where").at("segments")) {
    const std::string run = s.at("run");
    EXPECT_TRUE(run.rfind("small/", 0) == 0 || run.rfind("large/", 0) == 0) << run;
  }
}

TEST_F(GapJoined, TheTwinForetellsBoth) {
  diagnosed({"small", "large"}, "d");
  const Outcome o = desk.umbsim({"gap", "predict", "small", "large", "--scenario", "d/twin.yaml", "--out", "p"});
  ASSERT_EQ(o.code, 0) << o.err;
  const json p = json::parse(text_of(desk.home / "p" / "prediction.json"));
  for (const char* name : {"small", "large"}) {
    const json& of = p.at("recordings").at(name).at("predictions");
    EXPECT_LT(of.at("after").at("mean").at("final_mm").get<double>(),
              0.2 * of.at("before").at("mean").at("final_mm").get<double>())
        << name;
  }
}

TEST_F(GapJoined, AnotherRobotIsRefused) {
  ASSERT_EQ(desk.umbsim({"run", "s.yaml", "--set", "robot.urdf=optiodom.urdf", "--out", "other"}).code, 0);
  const Outcome o = desk.umbsim({"gap", "diagnose", "small", "other", "--out", "d"});
  EXPECT_EQ(o.code, kBadInput);
  EXPECT_NE(o.err.find("wheel_radius_m"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("other"), std::string::npos) << o.err;
  EXPECT_FALSE(fs::exists(desk.home / "d"));
}

}  // namespace
}  // namespace umbsim::acceptance

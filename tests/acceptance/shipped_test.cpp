// Shipped scenarios, sweeps and trials by their names, and the list of them.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

constexpr std::size_t kColumns = 80;

void expect_refused(const Desk& desk, const std::vector<std::string>& words, const std::vector<std::string>& parts) {
  const Outcome outcome = desk.umbsim(words);
  EXPECT_EQ(outcome.code, kBadInput) << outcome.out;
  EXPECT_EQ(outcome.out, "");
  expect_says(outcome.err, parts);
  EXPECT_EQ(listing(desk.home), std::set<std::string>{}) << "something was left behind";
}

TEST(Shipped, ScenariosRunByName) {
  const Desk desk;
  for (const std::string name : {"nominal", "effects/wheelbase", "wheelbase"}) {
    const Outcome outcome = desk.umbsim({"run", name, "--set", "course.side_m=0.5", "--set", "runs.per_direction=1"});
    ASSERT_EQ(outcome.code, 0) << name << outcome.err;
  }
  EXPECT_EQ(listing(desk.home / "results"),
            (std::set<std::string>{"index.html", "latest", "nominal", "wheelbase", "wheelbase-2"}));
  expect_says(text_of(desk.home / "results/nominal/provenance.json"), {shipped("nominal")});
  EXPECT_EQ(desk.umbsim({"explain", "wheelbase", "--set", "course.side_m=0.5"}).code, 0);
}

TEST(Shipped, WithoutANameTheDefaultTestIsRun) {
  const Desk desk;
  fs::create_directory(desk.home / "umbmark");  // as in the project itself
  const Outcome outcome = desk.umbsim({"run", "--set", "course.side_m=0.5", "--set", "runs.per_direction=1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_says(text_of(desk.home / "results/umbmark/provenance.json"), {shipped("umbmark")});
}

TEST(Shipped, AFileOnDiskWins) {
  const Desk desk;
  desk.put("nominal", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "nominal"}).code, 0);
  EXPECT_EQ(json_of(desk.home / "results/nominal/summary.json").at("seed"), 7);
}

TEST(Shipped, SweepsAndTrialsByName) {
  const Desk desk;
  EXPECT_EQ(desk.umbsim({"sweep", "friction", "--shard", "1/1000", "--set", "course.side_m=0.5"}).code, 0);
  EXPECT_TRUE(fs::exists(desk.home / "results/friction/shard-1-of-1000.sqlite"));
  const Outcome trial = desk.umbsim({"gap", "trial", "generate", "ci", "--shard", "1/1000"});
  EXPECT_EQ(trial.code, 0) << trial.err;
  EXPECT_TRUE(fs::exists(desk.home / "results/trial-ci"));
}

TEST(Shipped, UnknownNamesSayWhatWasMeant) {
  const Desk desk;
  expect_refused(desk, {"run", "umbmrk"},
                 {"umbmrk: cannot be read: No such file", "did you mean 'umbmark'?", "`umbsim list`"});
  expect_refused(desk, {"run", "scenarios/umbmrk.yaml"}, {"did you mean 'umbmark'?"});
  expect_refused(desk, {"run", "efects/bump"}, {"did you mean 'effects/bump'?"});
  expect_refused(desk, {"explain", "wheelbas"}, {"did you mean 'wheelbase'?"});
  expect_refused(desk, {"gap", "plan", "nominl"}, {"did you mean 'nominal'?"});
  expect_refused(desk, {"sweep", "fricton"}, {"did you mean 'friction'?", "no shipped sweep"});
  expect_refused(desk, {"gap", "trial", "generate", "publishd"}, {"did you mean 'published'?"});
  expect_refused(desk, {"run", "friction"}, {"'friction' is a sweep", "umbsim sweep friction"});
  expect_refused(desk, {"sweep", "uncertainty"}, {"'uncertainty' is a scenario", "umbsim run uncertainty"});
  expect_refused(desk, {"run", "nothing_like_it"}, {"No such file", "`umbsim list` shows them"});
}

TEST(Shipped, TheListShowsEveryFile) {
  const Outcome list = Desk().umbsim({"list"});
  ASSERT_EQ(list.code, 0) << list.err;
  std::istringstream lines(list.out);
  std::map<std::string, std::string> said;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), kColumns) << line;
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (line.rfind("  ", 0) == 0) said[name] = line.substr(std::min(line.size(), line.find(name) + name.size()));
  }
  std::size_t files = 0;
  for (const char* folder : {"scenarios", "robots"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(UMBSIM_SOURCE_DIR) / folder)) {
      if (!entry.is_regular_file()) continue;
      const bool robot = entry.path().extension() == ".urdf";
      const std::string name = robot ? entry.path().filename() : entry.path().stem();
      ASSERT_TRUE(said.count(name)) << name;
      EXPECT_NE(said[name].find_first_not_of(' '), std::string::npos) << name << " says nothing of itself";
      ++files;
    }
  }
  EXPECT_GT(files, 40u);
  expect_says(list.out, {"umbsim run umbmark", "umbsim sweep friction", "umbsim gap trial ci", "TRC LabMate"});
}

}  // namespace
}  // namespace umbsim::acceptance

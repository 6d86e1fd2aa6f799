#include "gap/trial/diagnose/diagnose_cases.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <set>

#include "core/error.h"
#include "gap/trial/write/seal.h"
#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kDiagnosis =
    R"({"format":"umbsim-diagnosis/1","gap":{"detected":false},"causes":[{"effects":{"none":{}},"probability":1}],"set":["none"]})";

/// Recordings, and a program that stands in for `umbsim`.
struct Desk {
  Desk() {
    for (const char* name : {"aaa", "bbb", "ccc"}) {
      folder.write("t/recordings/" + std::string(name) + "/recording.yaml", std::string("of ") + name);
    }
    folder.write("t/cases.json", R"({"format":"umbsim-trial-cases/1","trial":"t","cases":[
      {"name":"aaa","exclude":[]},{"name":"bbb","exclude":["bump","push"]},{"name":"ccc","exclude":[]}]})");
  }
  fs::path program(const std::string& body) {
    const fs::path file = folder.write("program.sh", "#!/bin/sh\n" + body + "\n");
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }
  DiagnoseResult diagnose(const std::string& body, Shard shard = {}, bool retry = false) {
    return diagnose_cases(TrialFolder(folder.path / "t"), {program(body), {}, shard, 2, retry});
  }
  std::string writes(const std::string& more = "") const {
    return more + "\nmkdir diagnosis && echo '" + kDiagnosis + "' > diagnosis/diagnosis.json";
  }
  fs::path result(const std::string& name) const { return folder.path / "t" / "diagnoses" / name; }
  Folder folder;
};

TEST(DiagnoseCases, EveryCaseIsDiagnosedInAProcessOfItsOwn) {
  Desk desk;
  const DiagnoseResult result = desk.diagnose(desk.writes("echo $$ >> " + (desk.folder.path / "pids").string()));
  EXPECT_EQ(result.cases, 3u);
  EXPECT_EQ(result.finished, 3u);
  EXPECT_EQ(result.failed, 0u);
  std::set<std::string> pids;
  std::istringstream lines(text_of(desk.folder.path / "pids"));
  for (std::string pid; std::getline(lines, pid);) pids.insert(pid);
  EXPECT_EQ(pids.size(), 3u);
  for (const char* name : {"aaa", "bbb", "ccc"}) {
    EXPECT_EQ(text_of(desk.result(name) / "diagnosis.json"), std::string(kDiagnosis) + "\n");
    EXPECT_EQ(read_json(desk.result(name) / "process.json").at("exit_code"), 0);
  }
}

TEST(DiagnoseCases, TheProcessSeesItsOneRecordingAndNeitherNameNorSurroundings) {
  setenv("UMBSIM_SECRET", "the answer", 1);
  Desk desk;
  desk.diagnose(desk.writes("{ pwd; env; echo \"$@\"; find . -type f | sort; cat recording/recording.yaml; } > "
                            "/tmp/umbsim_seen_$$ && mv /tmp/umbsim_seen_$$ " +
                            (desk.folder.path / "seen-").string() + "$(cat recording/recording.yaml | cut -c4-)"));
  unsetenv("UMBSIM_SECRET");
  const std::string seen = text_of(desk.folder.path / "seen-bbb");
  EXPECT_THAT(seen, HasSubstr("gap diagnose recording --out diagnosis --exclude bump --exclude push"));
  EXPECT_THAT(seen, HasSubstr("of bbb"));
  EXPECT_THAT(seen, HasSubstr("XDG_CACHE_HOME="));
  EXPECT_THAT(seen, Not(HasSubstr("SECRET")));
  EXPECT_THAT(seen, Not(HasSubstr("of aaa")));
  EXPECT_THAT(seen, Not(HasSubstr("answers")));
  // The name of the case stands in the file that this test put there, and nowhere else.
  std::size_t names = 0;
  for (std::size_t at = seen.find("bbb"); at != std::string::npos; at = seen.find("bbb", at + 1)) ++names;
  EXPECT_EQ(names, 1u);
}

TEST(DiagnoseCases, TheSealAtTheTimeIsKept) {
  Desk desk;
  const std::string hash = seal_answers(TrialFolder(desk.folder.path / "t"), "{}");
  desk.diagnose(desk.writes());
  EXPECT_EQ(read_json(desk.result("aaa") / "process.json").at("answers_sha256"), hash);
}

TEST(DiagnoseCases, GoesOnWhereItStoppedAndFailuresAreTriedAgainOnlyOnDemand) {
  Desk desk;
  DiagnoseResult result = desk.diagnose("echo broken >&2; exit 3");
  EXPECT_EQ(result.finished, 3u);
  EXPECT_EQ(result.failed, 3u);
  const Json process = read_json(desk.result("aaa") / "process.json");
  EXPECT_EQ(process.at("exit_code"), 3);
  EXPECT_THAT(process.at("messages").get<std::string>(), HasSubstr("broken"));
  result = desk.diagnose(desk.writes());
  EXPECT_EQ(result.failed, 3u) << "finished cases stay as they are";
  result = desk.diagnose(desk.writes(), {}, true);
  EXPECT_EQ(result.failed, 0u);
  const auto before = text_of(desk.result("aaa") / "process.json");
  desk.diagnose("exit 3", {}, true);
  EXPECT_EQ(text_of(desk.result("aaa") / "process.json"), before);
}

TEST(DiagnoseCases, AProgramThatSucceedsWithoutADiagnosisHasFailed) {
  Desk desk;
  EXPECT_EQ(desk.diagnose("exit 0").failed, 3u);
}

TEST(DiagnoseCases, ShardsTogetherAreTheWhole) {
  Desk desk;
  EXPECT_EQ(desk.diagnose(desk.writes(), {0, 2}).finished, 2u);
  EXPECT_EQ(desk.diagnose(desk.writes(), {1, 2}).finished, 3u);
}

TEST(DiagnoseCases, AForeignFolderNeedsRecordingsOnly) {
  Desk desk;
  fs::remove(desk.folder.path / "t" / "cases.json");
  EXPECT_EQ(desk.diagnose(desk.writes()).finished, 3u);
}

TEST(DiagnoseCases, WhatIsNotThereIsNamed) {
  Desk desk;
  EXPECT_THROW(diagnose_cases(TrialFolder(desk.folder.path / "nowhere"), {desk.program("exit 0"), {}, {}, 1, false}),
               InputError);
  EXPECT_THROW(diagnose_cases(TrialFolder(desk.folder.path / "t"), {desk.folder.path / "no-program", {}, {}, 1, false}),
               RunError);
}

}  // namespace
}  // namespace umbsim::trial_testing

// Rows that are written while they are driven, kept in memory or thrown away: the same rows, and the same figures.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "experiment/output/figures.h"
#include "experiment/output/result_json.h"
#include "experiment/run.h"
#include "recording/run_writer.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

// Every file below a folder by its relative name, with its content.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    files[fs::relative(entry.path(), folder).string()] = std::string((std::istreambuf_iterator<char>(in)), {});
  }
  return files;
}

// Two calibration passes, cables, uncertainty with a fix, noise.
Scenario rich() {
  return testing::shipped(
      "uncertainty", {"course.side_m=0.5", "runs.per_direction=2", "course.laps=2", "bumps={count: 1, height_m: 0.005}",
                      "fixes=[{leg: 2}]", "effects.wheelbase.relative=-0.01", "noise.radius_scatter=0.0001",
                                           "calibration={method: heading, max_passes: 2}"});
}

Json without_time(Json json) {
  json["cost"].erase("wall_s");
  return json;
}

TEST(Rows, InAFolderAreThoseInMemory) {
  const Scenario s = rich();
  const testing::TemporaryFolder folder;
  const fs::path streamed = folder.path() / "streamed", at_once = folder.path() / "at_once";
  const ExperimentResult kept = run_experiment(s, 2, false);
  const ExperimentResult written = run_experiment(s, 2, false, {Rows::To::folder, streamed});
  ASSERT_FALSE(kept.passes.empty());
  write_recording_header(written.recording, streamed);
  write_recording_header(written.passes.back().recording, streamed / "calibrated");
  fs::create_directories(at_once / "calibrated");
  write_recording(kept.recording, at_once);
  write_recording(kept.passes.back().recording, at_once / "calibrated");
  EXPECT_EQ(files_of(streamed), files_of(at_once));
  EXPECT_TRUE(written.recording.runs[0].encoders.empty());
  EXPECT_TRUE(written.tracks[0].samples.empty());
  EXPECT_EQ(without_time(summary_json(written)), without_time(summary_json(kept)));
  EXPECT_EQ(report_json(written), report_json(kept));
}

TEST(Rows, ThrownAwayLeaveTheSameFigures) {
  const Scenario s = rich();
  const ExperimentResult kept = run_experiment(s, 1, false);
  const ExperimentResult gone = run_experiment(s, 1, false, {Rows::To::nowhere, {}});
  EXPECT_TRUE(gone.recording.runs[0].encoders.empty());
  EXPECT_TRUE(gone.passes.back().recording.runs[0].truth.empty());
  EXPECT_EQ(without_time(summary_json(gone)), without_time(summary_json(kept)));
}

// The digest's return error is that of the rows, bit for bit.
TEST(Rows, ADigestsErrorIsThatOfItsRows) {
  const ExperimentResult r = run_experiment(rich(), 1, false);
  for (std::size_t i = 0; i < r.digests.size(); ++i) {
    const ReturnError of_rows = return_error(r.recording.runs[i], r.odometry);
    EXPECT_EQ(r.digests[i].error.run, of_rows.run);
    EXPECT_EQ(r.digests[i].error.x_m, of_rows.x_m);
    EXPECT_EQ(r.digests[i].error.y_m, of_rows.y_m);
    EXPECT_EQ(r.digests[i].error.theta_rad, of_rows.theta_rad);
  }
}

// Whatever ends a run in the middle ends the experiment.
TEST(Rows, LapsAreToldAndMayEndIt) {
  const Scenario s = testing::shipped("nominal", {"course.side_m=0.5", "course.laps=3"});
  std::atomic<int> laps{0};
  run_experiment(s, 2, false, {Rows::To::nowhere, {}}, [&] { ++laps; });
  EXPECT_EQ(laps, 6);
  laps = 0;
  EXPECT_THROW(run_experiment(s, 1, false, {Rows::To::nowhere, {}},
                              [&] {
                                if (++laps == 2) throw RunError("enough");
                              }),
               RunError);
  EXPECT_EQ(laps, 2);
}

}  // namespace
}  // namespace umbsim

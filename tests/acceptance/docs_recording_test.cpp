// docs/recording-format.md says what read_recording does.
#include "recording/recording.h"
#include "tests/acceptance/markdown.h"
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

const std::string kRecordingPage = std::string(UMBSIM_SOURCE_DIR) + "/docs/recording-format.md";

TEST(RecordingDocument, ItsExampleIsARecording) {
  const std::vector<std::string> yaml = fenced_blocks(kRecordingPage, "yaml"),
                                 csv = fenced_blocks(kRecordingPage, "csv");
  ASSERT_EQ(yaml.size(), 1u);
  ASSERT_EQ(csv.size(), 2u) << "encoders.csv and truth.csv";
  const Desk desk;
  desk.put("example/recording.yaml", yaml[0]);
  for (const char* run : {"cw-1", "ccw-1", "cw-bumped-1"}) {
    desk.put("example/runs/" + std::string(run) + "/encoders.csv", csv[0]);
    desk.put("example/runs/" + std::string(run) + "/truth.csv", csv[1]);
  }
  const Recording recording = read_recording(desk.home / "example");
  ASSERT_EQ(recording.runs.size(), 3u);
  EXPECT_EQ(recording.runs[2].inner_wheel_bumps, 2);
  EXPECT_EQ(recording.runs[2].bumps.size(), 2u);
}

}  // namespace
}  // namespace umbsim::acceptance

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "recording/recording.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

/// Every folder with a recording.yaml below the shared recordings.
std::vector<fs::path> shared_recordings() {
  std::vector<fs::path> found;
  const fs::path root = fs::path(UMBSIM_SHARED_DIR) / "recordings";
  if (!fs::is_directory(root)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().filename() == "recording.yaml") found.push_back(entry.path().parent_path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Path length by the encoders: the mean of the wheels, forwards and backwards alike.
double rolled_m(const Recording& recording, const RecordedRun& run) {
  const double metres_per_tick = 2 * M_PI * recording.robot.wheel_radius_m / recording.robot.ticks_per_revolution;
  double length = 0;
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample &a = run.encoders[i - 1], &b = run.encoders[i];
    length += std::abs(double((b.left_ticks - a.left_ticks) + (b.right_ticks - a.right_ticks))) / 2 * metres_per_tick;
  }
  return length;
}

TEST(SharedRecordings, AreReadAndMakeSense) {
  const std::vector<fs::path> folders = shared_recordings();
  if (folders.empty()) GTEST_SKIP() << "no shared recordings below " << UMBSIM_SHARED_DIR;
  for (const fs::path& folder : folders) {
    SCOPED_TRACE(folder.string());
    const Recording recording = read_recording(folder);
    EXPECT_FALSE(recording.runs.empty());
    for (const RecordedRun& run : recording.runs) {
      SCOPED_TRACE(run.id);
      const double interval_s =
          (run.encoders.back().time_s - run.encoders.front().time_s) / double(run.encoders.size() - 1);
      constexpr double kClockSpread = 0.05;  // relative; a real controller's clock
      EXPECT_NEAR(interval_s * recording.encoder_rate_hz, 1, kClockSpread);
      if (recording.path.shape != "square") continue;
      constexpr double kPathSpread = 0.12;  // corners may be rounded, and legs overshoot a little
      EXPECT_NEAR(rolled_m(recording, run) / (4 * recording.path.side_m), 1, kPathSpread);
      const double turned = run.truth.back().X_WB.theta_rad - run.truth.front().X_WB.theta_rad;
      EXPECT_GT(run.direction == "cw" ? -turned : turned, M_PI) << "cw turns right";
    }
  }
}

}  // namespace
}  // namespace umbsim

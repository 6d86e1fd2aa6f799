#include "experiment/output/run_size.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "experiment/drive/drive_run.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

// Of a row, as it is written: times and ticks are short at first.
constexpr double kEncoderRow_bytes = 40;
constexpr double kTruthRow_bytes = 45;
constexpr double kMuch_bytes = 1e9;
constexpr double kSurelyNeeded = 0.5;  // of what is expected

double megabytes(double bytes) { return bytes / 1e6; }

}  // namespace

RunSize expected_size(const Scenario& s) {
  RunSize size;
  size.laps = s.course.laps;
  size.runs = s.runs.per_direction * int(s.runs.directions.size()) * (s.bumps.any() ? 2 : 1);
  const bool again = s.calibration.method != Calibrate::none && s.runs.directions.size() == 2;
  const int driven = size.runs + (again ? s.runs.per_direction * 2 : 0);
  size.simulated_s = driven * (Plan(s.course, Direction::cw).duration_s() + kRest_s);
  const double truth_hz = s.truth.kind == "endpoints" ? 0 : std::min(s.truth.rate_hz, s.encoders.rate_hz);
  size.bytes = size.simulated_s * (s.encoders.rate_hz * kEncoderRow_bytes + truth_hz * kTruthRow_bytes);
  return size;
}

void check_room(const RunSize& size, const fs::path& folder) {
  if (size.bytes < kMuch_bytes) return;
  fs::path parent = fs::absolute(folder).parent_path();
  std::error_code error;
  while (!fs::exists(parent, error) && parent.has_relative_path()) parent = parent.parent_path();
  const fs::space_info space = fs::space(parent, error);
  const std::string what =
      fmt::format("{} runs of {} laps, {:.0f} h of driving with their calibration, about {:.0f} MB on the disk",
                  size.runs, size.laps, size.simulated_s / 3600, megabytes(size.bytes));
  if (!error && double(space.available) < kSurelyNeeded * size.bytes) {
    throw RunError(
        fmt::format("{}: {}, and {:.0f} MB are free", folder.string(), what, megabytes(double(space.available))));
  }
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "umbsim: {}\n", what);
}

}  // namespace umbsim

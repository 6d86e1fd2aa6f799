#include "gap/trial/write/even_tables.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/text/text_file.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

// The sign, up to 9999 units, nine decimals.
constexpr auto kCountsRow = FMT_COMPILE("{:015.9f},{:012d},{:012d}");
constexpr auto kCommandsRow = FMT_COMPILE(",{:015.9f},{:015.9f}");
constexpr auto kTruthRow = FMT_COMPILE("{:015.9f},{:015.9f},{:015.9f},{:015.9f}\n");

std::string encoders_text(const RecordedRun& run) {
  fmt::memory_buffer text;
  text.append(std::string_view("time_s,left_ticks,right_ticks"));
  if (run.has_commands) text.append(std::string_view(",left_command_radps,right_command_radps"));
  text.push_back('\n');
  for (const EncoderSample& e : run.encoders) {
    fmt::format_to(fmt::appender(text), kCountsRow, e.time_s, e.left_ticks, e.right_ticks);
    if (run.has_commands)
      fmt::format_to(fmt::appender(text), kCommandsRow, e.left_command_radps, e.right_command_radps);
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

std::string truth_text(const RecordedRun& run) {
  fmt::memory_buffer text;
  text.append(std::string_view("time_s,x_m,y_m,theta_rad\n"));
  for (const TruthSample& t : run.truth) {
    fmt::format_to(fmt::appender(text), kTruthRow, t.time_s, t.X_WB.x_m, t.X_WB.y_m, t.X_WB.theta_rad);
  }
  return fmt::to_string(text);
}

}  // namespace

void write_even_tables(const Recording& recording, const fs::path& directory) {
  for (const RecordedRun& run : recording.runs) {
    const fs::path folder = directory / "runs" / run.id;
    write_text_file(folder / "encoders.csv", encoders_text(run));
    write_text_file(folder / "truth.csv", truth_text(run));
  }
}

}  // namespace umbsim

#include "recording/run_writer.h"

#include <fmt/compile.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "recording/names.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBuffered = 1 << 16;

/// `value` to the nearest 1e-9 (of metre, radian, second), below any sensor; so 0.1 + 0.2 is written as 0.3.
double rounded(double value) {
  constexpr double kDecimals = 1e9;
  constexpr double kLargest = 9e6;  // above, 1e-9 is finer than a double
  if (std::abs(value) > kLargest) return value;
  return std::round(value * kDecimals) / kDecimals + 0.0;  // + 0.0 turns -0 into 0
}

void check_finite(bool finite, const std::string& id, const char* file, double time_s) {
  if (!finite) throw RunError(fmt::format("run '{}': {} has a non-finite value at {} s", id, file, time_s));
}

fs::path folder_of(const fs::path& recording, const std::string& id) {
  const std::string problem = run_id_problem(id);
  if (!problem.empty()) throw RunError(fmt::format("run id '{}' {}", id, problem));
  const fs::path folder = recording / "runs" / id;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw RunError(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  return folder;
}

void append(fmt::memory_buffer& text, std::string_view piece) { text.append(piece); }

}  // namespace

GrowingFile::GrowingFile(const fs::path& file) : name_(file.string()), file_(std::fopen(name_.c_str(), "wb")) {
  if (!file_) throw RunError(fmt::format("{}: cannot be written: {}", name_, std::strerror(errno)));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // rows are gathered here
}

void GrowingFile::fail(int error) const {
  throw RunError(fmt::format("{}: cannot be written completely: {}", name_, std::strerror(error)));
}

void GrowingFile::end_row() {
  text_.push_back('\n');
  if (text_.size() >= kBuffered) flush();
}

void GrowingFile::flush() {
  if (std::fwrite(text_.data(), 1, text_.size(), file_.get()) != text_.size()) fail(errno);
  text_.clear();
}

void GrowingFile::finish() {
  flush();
  // A full disk may show only on closing.
  if (std::fclose(file_.release()) != 0) fail(errno);
}

RunWriter::RunWriter(const fs::path& recording, const std::string& id, bool has_commands)
    : id_(id),
      has_commands_(has_commands),
      encoders_(folder_of(recording, id) / "encoders.csv"),
      truth_(recording / "runs" / id / "truth.csv") {
  append(encoders_.text(), "time_s,left_ticks,right_ticks");
  if (has_commands) append(encoders_.text(), ",left_command_radps,right_command_radps");
  encoders_.end_row();
  append(truth_.text(), "time_s,x_m,y_m,theta_rad");
  truth_.end_row();
}

void RunWriter::add(const EncoderSample& row) {
  const double left = row.left_command_radps, right = row.right_command_radps;
  check_finite(std::isfinite(row.time_s) && std::isfinite(left) && std::isfinite(right), id_, "encoders.csv",
               row.time_s);
  const fmt::appender out(encoders_.text());
  fmt::format_to(out, FMT_COMPILE("{},{},{}"), rounded(row.time_s), row.left_ticks, row.right_ticks);
  if (has_commands_) fmt::format_to(out, FMT_COMPILE(",{},{}"), rounded(left), rounded(right));
  encoders_.end_row();
}

void RunWriter::add(const TruthSample& row) {
  const Pose2& X_WB = row.X_WB;
  check_finite(
      std::isfinite(row.time_s) && std::isfinite(X_WB.x_m) && std::isfinite(X_WB.y_m) && std::isfinite(X_WB.theta_rad),
      id_, "truth.csv", row.time_s);
  fmt::format_to(fmt::appender(truth_.text()), FMT_COMPILE("{},{},{},{}"), rounded(row.time_s), rounded(X_WB.x_m),
                 rounded(X_WB.y_m), rounded(X_WB.theta_rad));
  truth_.end_row();
}

void RunWriter::finish() {
  encoders_.finish();
  truth_.finish();
}

}  // namespace umbsim

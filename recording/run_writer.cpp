#include "recording/run_writer.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/text/decimal.h"
#include "recording/names.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBuffered = 1 << 16;

// One row, value by value.
class Row {
 public:
  Row& add(double value) {
    end_ = write_decimal(separated(), value);
    return *this;
  }
  Row& add(std::int64_t value) {
    end_ = std::to_chars(separated(), text_ + sizeof text_, value).ptr;
    return *this;
  }
  void append_to(fmt::memory_buffer& text) const { text.append(text_, static_cast<const char*>(end_)); }

 private:
  char* separated() {
    if (end_ != text_) *end_++ = ',';
    return end_;
  }

  char text_[6 * kDecimalRoom];  // of at most five values
  char* end_ = text_;
};

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
  using namespace std::string_view_literals;
  encoders_.text().append("time_s,left_ticks,right_ticks"sv);
  if (has_commands) encoders_.text().append(",left_command_radps,right_command_radps"sv);
  encoders_.end_row();
  truth_.text().append("time_s,x_m,y_m,theta_rad"sv);
  truth_.end_row();
}

void RunWriter::add(const EncoderSample& row) {
  const double left = row.left_command_radps, right = row.right_command_radps;
  check_finite(std::isfinite(row.time_s) && std::isfinite(left) && std::isfinite(right), id_, "encoders.csv",
               row.time_s);
  Row written;
  written.add(row.time_s).add(row.left_ticks).add(row.right_ticks);
  if (has_commands_) written.add(left).add(right);
  written.append_to(encoders_.text());
  encoders_.end_row();
}

void RunWriter::add(const TruthSample& row) {
  const Pose2& X_WB = row.X_WB;
  check_finite(
      std::isfinite(row.time_s) && std::isfinite(X_WB.x_m) && std::isfinite(X_WB.y_m) && std::isfinite(X_WB.theta_rad),
      id_, "truth.csv", row.time_s);
  Row written;
  written.add(row.time_s).add(X_WB.x_m).add(X_WB.y_m).add(X_WB.theta_rad).append_to(truth_.text());
  truth_.end_row();
}

void RunWriter::finish() {
  encoders_.finish();
  truth_.finish();
}

}  // namespace umbsim

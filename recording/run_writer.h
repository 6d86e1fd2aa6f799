#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "recording/recording.h"

namespace umbsim {

/// A text file that grows row by row. Only its last rows are in memory.
class GrowingFile {
 public:
  /// Throws RunError if it cannot be made.
  explicit GrowingFile(const std::filesystem::path& file);

  /// Where the next row goes.
  fmt::memory_buffer& text() { return text_; }
  /// A row is complete. Throws RunError if it cannot be written.
  void end_row();
  /// No more rows. Throws RunError if not all of it could be written.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void flush();
  [[noreturn]] void fail(int error) const;

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  fmt::memory_buffer text_;
};

/// Writes runs/<id>/{encoders,truth}.csv of a recording while the run is being driven. The text is the same for the same
/// values on every run. Throws RunError if something cannot be written, or is not finite.
class RunWriter {
 public:
  RunWriter(const std::filesystem::path& recording, const std::string& id, bool has_commands);

  void add(const EncoderSample& row);
  void add(const TruthSample& row);
  void finish();

 private:
  std::string id_;
  bool has_commands_;
  GrowingFile encoders_;
  GrowingFile truth_;
};

/// The recording.yaml of a recording whose rows stand there already. Throws RunError.
void write_recording_header(const Recording& recording, const std::filesystem::path& directory);

}  // namespace umbsim

#include "batch/progress_log.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <thread>

namespace umbsim {
namespace {

using namespace std::chrono_literals;

/// What a log of three cases of ten leaves behind.
std::string written(bool terminal, std::chrono::milliseconds every) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  {
    ProgressLog log("demo", 2, 10, {stream, terminal, every});
    std::this_thread::sleep_for(10ms);
    log.step();
    log.step(false);
    std::this_thread::sleep_for(200ms);
  }
  std::fclose(stream);
  std::string result(text, size);
  std::free(text);
  return result;
}

TEST(ProgressLog, WritesLinesIntoALog) {
  const std::string text = written(false, 60ms);
  EXPECT_NE(text.find("umbsim: demo: 4/10 points, "), std::string::npos) << text;
  EXPECT_NE(text.find(" left\n"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos) << text;
}

TEST(ProgressLog, IsQuietWhereNothingLastsAMinute) { EXPECT_EQ(written(false, ProgressLog::Options{}.every), ""); }

TEST(ProgressLog, DrawsABarOnATerminalAndTakesItAway) {
  const std::string text = written(true, 60ms);
  EXPECT_NE(text.find("\r\033[K[############..................] demo: 4/10 points"), std::string::npos) << text;
  EXPECT_EQ(text.substr(text.size() - 4), "\r\033[K");
}

TEST(ProgressLog, TimesAreForReading) {
  EXPECT_EQ(duration_text(11.2), "12 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(3725), "1 h 02 min");
}

}  // namespace
}  // namespace umbsim

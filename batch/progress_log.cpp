#include "batch/progress_log.h"

#include <unistd.h>

#include <cmath>

#include <fmt/format.h>

namespace umbsim {
namespace {
constexpr std::chrono::milliseconds kRedraw{200};
constexpr int kBar = 30;
}  // namespace

std::string duration_text(double seconds) {
  const auto s = std::int64_t(std::ceil(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

ProgressLog::Options ProgressLog::on_standard_error() {
  Options options;
  options.terminal = isatty(STDERR_FILENO) != 0;
  if (options.terminal) options.every = kRedraw;
  return options;
}

ProgressLog::ProgressLog(std::string what, std::int64_t done, std::int64_t total, Options options)
    : what_(std::move(what)), done_(done), total_(total), options_(options), start_(std::chrono::steady_clock::now()),
      watcher_([this](const std::stop_token& stop) { watch(stop); }) {}

ProgressLog::~ProgressLog() {
  watcher_.request_stop();
  watcher_.join();
  if (options_.terminal) fmt::print(options_.stream, "\r\033[K");
  std::fflush(options_.stream);
}

void ProgressLog::step(bool ours) {
  const std::lock_guard lock(mutex_);
  ++done_;
  ours_ += ours;
}

std::string ProgressLog::line() const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  std::string text = fmt::format("{}: {}/{} points", what_, done_, total_);
  if (ours_ == 0) return text;
  const double per_second = double(ours_) / elapsed.count();
  text +=
      per_second >= 1 ? fmt::format(", {:.1f} per s", per_second) : fmt::format(", {:.1f} per min", 60 * per_second);
  return text + fmt::format(", {} left", duration_text(double(total_ - done_) / per_second));
}

void ProgressLog::watch(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    woken_.wait_for(lock, stop, options_.every, [] { return false; });
    if (stop.stop_requested()) return;
    if (options_.terminal) {
      const auto filled = std::size_t(total_ > 0 ? kBar * done_ / total_ : kBar);
      fmt::print(options_.stream, "\r\033[K[{}{}] {}", std::string(filled, '#'),
                 std::string(std::size_t(kBar) - filled, '.'), line());
    } else {
      fmt::print(options_.stream, "umbsim: {}\n", line());
    }
    std::fflush(options_.stream);
  }
}

}  // namespace umbsim

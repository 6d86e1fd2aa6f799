#include "core/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/terminal.h"

namespace umbsim {
namespace {
constexpr double kQuiet_s = 0.5;  // shorter work shows nothing
constexpr double kRedraw_s = 0.1;
constexpr int kBar = 30;
}  // namespace

Progress::Progress(std::string what, int total)
    : what_(std::move(what)), total_(total), terminal_(shows_progress()), start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void Progress::step() {
  const std::lock_guard lock(mutex_);
  ++done_;
  show();
}

void Progress::reach(int done) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  done_ = std::min(done, total_);
  show();
}

void Progress::show() {
  if (!terminal_) return;
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (elapsed_s < kQuiet_s || (elapsed_s - last_draw_s_ < kRedraw_s && done_ < total_)) return;
  last_draw_s_ = elapsed_s;
  draw(elapsed_s);
}

void Progress::draw(double elapsed_s) {
  drawn_ = true;
  const int filled = total_ > 0 ? kBar * done_ / total_ : kBar;
  const double left_s =
      std::max(done_ < total_ ? 1.0 : 0.0, std::ceil(elapsed_s / std::max(done_, 1) * (total_ - done_)));
  fmt::print(stderr, "\r\033[K{} [{}{}] {}/{}, {:.0f} s left", what_, std::string(std::size_t(filled), '#'),
             std::string(std::size_t(kBar - filled), '.'), done_, total_, left_s);
  std::fflush(stderr);
}

}  // namespace umbsim

#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace umbsim {

/// Of pieces of work that are done in parallel the first one, by number, that fails: the same one however many threads
/// there are. Pieces behind one that has failed are left out; those that have begun are finished. Thrown out of a
/// parallel loop instead, it would cancel the loops within them, which then leave their work half done and say nothing.
class FirstFailure {
 public:
  template <class Work>
  void attempt(std::size_t number, const Work& work) {
    if (number > first_) return;
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (number > first_) return;
      first_ = number;
      failure_ = std::current_exception();
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::atomic<std::size_t> first_{std::numeric_limits<std::size_t>::max()};
  std::exception_ptr failure_;
};

}  // namespace umbsim

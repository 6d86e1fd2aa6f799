#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <string>

namespace umbsim {

/// The results that were made last, by key. Safe to call from several threads: two that ask for the same at once both
/// make it.
template <class Result>
class Recent {
 public:
  explicit Recent(std::size_t most) : most_(most) {}

  template <class Make>
  Result get(const std::string& key, const Make& make) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
    }
    Result result = make();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (kept_.emplace(key, result).second) order_.push_back(key);
    if (order_.size() > most_) {
      kept_.erase(order_.front());
      order_.pop_front();
    }
    return result;
  }

 private:
  std::size_t most_;
  std::mutex mutex_;
  std::map<std::string, Result> kept_;
  std::deque<std::string> order_;
};

}  // namespace umbsim

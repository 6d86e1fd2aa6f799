#include "gap/remembered.h"

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace umbsim::gap {
namespace {

constexpr std::size_t kMostKept = 1500;  // runs: some 100 MB of tracks and counts

// Everything that a run's simulation depends on, as bytes.
std::string key_of(std::size_t run, const std::vector<Effect>& effects) {
  std::string key = std::to_string(run);
  for (const Effect& e : effects) {
    key += '\n' + e.info->name + '\t' + e.values.run + '\t';
    key.append(reinterpret_cast<const char*>(e.values.numbers.data()), e.values.numbers.size() * sizeof(double));
  }
  return key;
}

template <class Result>
class Memory {
 public:
  template <class Simulate>
  Result get(const std::string& key, const Simulate& simulate) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
    }
    Result result = simulate();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (kept_.emplace(key, result).second) order_.push_back(key);
    if (order_.size() > kMostKept) {
      kept_.erase(order_.front());
      order_.pop_front();
    }
    return result;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, Result> kept_;
  std::deque<std::string> order_;
};

template <class Call>
auto with_memory(const Call& call) {
  using Result = decltype(call(std::size_t(0), std::vector<Effect>{}));
  const auto memory = std::make_shared<Memory<Result>>();
  return [call, memory](std::size_t run, const std::vector<Effect>& effects) {
    return memory->get(key_of(run, effects), [&] { return call(run, effects); });
  };
}

}  // namespace

Simulator remembered(Simulator simulator) {
  simulator.ticks = with_memory(simulator.ticks);
  if (simulator.commands) simulator.commands = with_memory(simulator.commands);
  return simulator;
}

}  // namespace umbsim::gap

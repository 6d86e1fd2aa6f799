#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace umbsim {

/// A random stream of its own for every (seed, name, index): adding a stream never changes another one.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name, std::uint64_t index = 0);

  double normal(double mean = 0, double sd = 1);
  double uniform(double min = 0, double max = 1);
  std::uint64_t bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace umbsim

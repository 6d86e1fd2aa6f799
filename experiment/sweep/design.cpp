#include "experiment/sweep/design.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <numeric>

#include "core/random.h"

namespace umbsim {
namespace {

// A permutation by sorting random keys: the same with every standard library.
std::vector<std::int64_t> shuffled(std::int64_t count, RandomStream& random) {
  std::vector<std::uint64_t> keys;
  for (std::int64_t i = 0; i < count; ++i) keys.push_back(random.bits());
  std::vector<std::int64_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), std::int64_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int64_t a, std::int64_t b) { return keys[std::size_t(a)] < keys[std::size_t(b)]; });
  return order;
}

}  // namespace

const char* name(Design design) {
  constexpr const char* kNames[] = {"grid", "list", "latin_hypercube", "sobol"};
  return kNames[int(design)];
}

std::vector<double> latin_hypercube(std::int64_t samples, std::size_t dimensions, std::uint64_t seed) {
  std::vector<double> shares(std::size_t(samples) * dimensions);
  for (std::size_t axis = 0; axis < dimensions; ++axis) {
    RandomStream random(seed, "latin hypercube", axis);
    const std::vector<std::int64_t> part = shuffled(samples, random);
    for (std::size_t s = 0; s < std::size_t(samples); ++s) {
      shares[s * dimensions + axis] = (double(part[s]) + random.uniform()) / double(samples);
    }
  }
  return shares;
}

std::vector<double> sobol(std::int64_t samples, std::size_t dimensions) {
  boost::random::sobol engine(dimensions);
  std::vector<double> shares(std::size_t(samples) * dimensions);
  // 53 bits of the 64 fill a double below 1.
  for (double& share : shares) share = double(engine() >> 11) * 0x1p-53;
  return shares;
}

}  // namespace umbsim

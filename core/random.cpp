#include "core/random.h"

namespace umbsim {
namespace {

// splitmix64 (Steele, Lea, Flood 2014), the usual seeder of larger generators.
std::uint64_t mix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

std::mt19937_64 seeded(std::uint64_t seed, std::string_view name, std::uint64_t index) {
  // Mixed after every part: neighbouring seeds and indices, and names alike but for a letter, must not meet.
  std::uint64_t state = seed;
  state = mix(state);
  for (const unsigned char c : name) {
    state ^= c;
    state = mix(state);
  }
  state ^= index;
  std::uint64_t a = mix(state);
  std::uint64_t b = mix(state);
  std::seed_seq sequence{std::uint32_t(a), std::uint32_t(a >> 32), std::uint32_t(b), std::uint32_t(b >> 32)};
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name, std::uint64_t index)
    : engine_(seeded(seed, name, index)) {}

double RandomStream::normal(double mean, double sd) { return mean + sd * normal_(engine_); }

double RandomStream::uniform(double min, double max) {
  return min + (max - min) * (double(engine_() >> 11) * 0x1p-53);
}

}  // namespace umbsim

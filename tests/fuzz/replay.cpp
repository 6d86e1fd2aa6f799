// Runs a target on the kept corpus, and on what simple changes make of it for a while: TARGET FOLDER SECONDS.
// A crash ends it, and so does what takes longer than two seconds of processor time.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "tests/fuzz/target.h"

namespace umbsim::fuzz {
namespace {

constexpr double kSlow_s = 2;

double processor_s() { return double(std::clock()) / CLOCKS_PER_SEC; }

void run(const std::string& bytes, const std::string& what) {
  const double begin_s = processor_s();
  run_target(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (processor_s() - begin_s < kSlow_s) return;
  std::fprintf(stderr, "%s takes %.1f s\n", what.c_str(), processor_s() - begin_s);
  std::exit(1);
}

std::string changed(std::string bytes, const std::vector<std::string>& all, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : std::size_t(random() % n); };
  for (std::size_t i = 1 + below(4); i > 0 && !bytes.empty(); --i) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = char(random());
        break;
      case 1:
        bytes[at] = char(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, below(32));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(64)));
        break;
      case 4:
        bytes.resize(at);
        break;
      default: {
        const std::string& other = all[below(all.size())];
        bytes.insert(at, other.substr(below(other.size()), below(64)));
      }
    }
  }
  return bytes;
}

int replay(const std::filesystem::path& corpus, double seconds) {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    std::ifstream in(entry.path(), std::ios::binary);
    all.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    run(all.back(), entry.path().string());
  }
  if (all.empty()) {
    std::fprintf(stderr, "%s is empty\n", corpus.c_str());
    return 1;
  }
  std::mt19937 random(30);
  std::size_t runs = 0;
  for (const double end_s = processor_s() + seconds; processor_s() < end_s; ++runs) {
    const std::string bytes = changed(all[runs % all.size()], all, random);
    written("last", bytes);  // what a crash was about
    run(bytes, "change " + std::to_string(runs));
  }
  std::printf("%zu kept inputs, %zu changed ones\n", all.size(), runs);
  return 0;
}

}  // namespace
}  // namespace umbsim::fuzz

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: %s CORPUS SECONDS\n", argv[0]), 2;
  return umbsim::fuzz::replay(argv[1], std::atof(argv[2]));
}

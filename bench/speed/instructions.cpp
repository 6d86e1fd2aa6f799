// Instructions per simulated second, counted by valgrind's callgrind: repeatable where a clock is not. Only the drive
// is counted, not start-up, construction and files.
//   umbsim_instructions record FILE   counts and writes FILE
//   umbsim_instructions check FILE    counts and compares with FILE; 1 if a case costs over 5 % more, 77 if it cannot
//   tell umbsim_instructions drive CASE    what is counted: prints the simulated seconds
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/speed/cases.h"

namespace {

using namespace umbsim;
using namespace umbsim::bench;
using Json = nlohmann::ordered_json;

constexpr double kAllowedRise = 0.05;
constexpr int kSkipped = 77;

constexpr double kSide_m = 1;  // of the squares: callgrind is slow

std::string build() {
  const std::string flags = UMBSIM_BUILD_FLAGS;
  return flags.empty() ? UMBSIM_BUILD_TYPE : UMBSIM_BUILD_TYPE " " + flags;
}

}  // namespace

/// Callgrind collects while this function runs.
extern "C" __attribute__((noinline)) void umbsim_counted(const std::function<void()>* task) { (*task)(); }

namespace {

int drive(const std::string& name) {
  for (const Case& c : kCases) {
    if (name != c.name) continue;
    const RobotModel robot = load_robot(c.robot_urdf);
    const PhysicsOptions shipped;
    const auto engine = make_ours(setup(c, robot, shipped.step_s, shipped.fine_step_s));
    Outcome out;
    const std::function<void()> task = [&] { out = bench::drive(c, *engine, robot, kSide_m); };
    umbsim_counted(&task);
    fmt::print("simulated_s {}\n", out.simulated_s);
    return 0;
  }
  fmt::print(stderr, "no case '{}'\n", name);
  return 2;
}

std::string own_path() {
  std::array<char, 4096> path{};
  const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
  return {path.data(), std::size_t(std::max<ssize_t>(length, 0))};
}

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return text;
  std::array<char, 4096> piece{};
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), pipe)) text.append(piece.data(), n);
  pclose(pipe);
  return text;
}

double number_after(const std::string& text, const char* word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + std::strlen(word), nullptr);
}

// The C library picks variants of sin and memcpy by processor; without these features it picks the same anywhere. An
// empty environment: neither its size nor the locale counts.
double instructions_per_simulated_s(const Case& c) {
  const std::string text = output_of(fmt::format(
      "env -i PATH=\"$PATH\" LC_ALL=C "
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX_Fast_Unaligned_Load,-AVX2_Usable,-AVX_Usable "
      "valgrind --tool=callgrind --callgrind-out-file=/dev/null --collect-atstart=no "
      "--toggle-collect=umbsim_counted '{}' drive {} 2>&1", own_path(), c.name));
  const double simulated_s = number_after(text, "simulated_s ");
  const double instructions = number_after(text, "Collected : ");
  if (simulated_s > 0 && instructions > 0) return instructions / simulated_s;
  fmt::print(stderr, "callgrind did not run:\n{}\n", text);
  std::exit(2);
}

Json count_all() {
  Json json{{"format", "umbsim-instructions/1"}, {"compiler", __VERSION__}, {"build", build()}};
  for (const Case& c : kCases) {
    const double count = instructions_per_simulated_s(c);
    fmt::print("{:<8}{:>12.0f} instructions per simulated second\n", c.name, count);
    std::fflush(stdout);
    json["instructions_per_simulated_s"][c.name] = std::round(count);
  }
  return json;
}

int skip(const std::string& why) {
  fmt::print("skipped: {}\n", why);
  return kSkipped;
}

int check(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) return skip(file + " is not there; bench/instructions --record writes it");
  const Json record = Json::parse(stream);
  for (const auto& [key, mine] : {std::pair{"compiler", std::string(__VERSION__)}, std::pair{"build", build()}}) {
    if (record.at(key) == mine) continue;
    return skip(fmt::format("recorded with {} '{}', this is '{}'", key, record.at(key).get<std::string>(), mine));
  }
  const Json now = count_all();
  int risen = 0;
  for (const auto& [name, before] : record.at("instructions_per_simulated_s").items()) {
    const double ratio = now["instructions_per_simulated_s"].value(name, 0.0) / before.get<double>();
    fmt::print("{:<8}{:+.2f} % against the record\n", name, 100 * (ratio - 1));
    risen += ratio > 1 + kAllowedRise;
  }
  if (risen) fmt::print("over 5 % more instructions. If that is meant: bench/instructions --record\n");
  return risen ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: umbsim_instructions record FILE | check FILE | drive CASE\n");
    return 2;
  }
  const std::string verb = argv[1], what = argv[2];
  if (verb == "drive") return drive(what);
  if (std::system("valgrind --version > /dev/null 2>&1") != 0) return skip("valgrind is not installed");
  if (verb == "check") return check(what);
  std::ofstream(what) << count_all().dump(2) << "\n";
  return 0;
}

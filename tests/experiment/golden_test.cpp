// The traces of a few scenarios, to the last bit, against those that are kept for this compiler and C library in
// golden_traces.txt. UMBSIM_GOLDEN=write writes them again: after a change that is meant to change figures, or for a
// compiler that has none yet.
#include <gnu/libc-version.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "experiment/run.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::shipped;

const std::string kFile = std::string(UMBSIM_SOURCE_DIR) + "/tests/experiment/golden_traces.txt";

// FNV-1a, 64 bits, over the bits of numbers.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte, word >>= 8) value_ = (value_ ^ (word & 0xff)) * 0x100000001b3ull;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Recording& recording) {
    for (const RecordedRun& run : recording.runs) {
      for (const EncoderSample& s : run.encoders) {
        for (const std::int64_t ticks : {s.left_ticks, s.right_ticks}) add(std::uint64_t(ticks));
        for (const double x : {s.time_s, s.left_command_radps, s.right_command_radps}) add(x);
      }
      for (const TruthSample& s : run.truth) {
        for (const double x : {s.time_s, s.X_WB.x_m, s.X_WB.y_m, s.X_WB.theta_rad}) add(x);
      }
    }
  }
  std::string text() const {
    std::ostringstream out;
    out << std::hex << value_;
    return out.str();
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

// What bits may depend on: the compiler, the C library, and what its sin, exp and others say at points of their range:
// glibc has several of each, and chooses by the processor.
std::string platform() {
#if defined(__clang__)
  const std::string compiler = "clang-" + std::to_string(__clang_major__);
#else
  const std::string compiler = "gcc-" + std::to_string(__GNUC__);
#endif
  Hash libm;
  for (int i = 1; i <= 2000; ++i) {
    const volatile double point = 0.0037 * i;  // computed when it runs, not by the compiler
    const double x = point;
    for (const double y : {std::sin(x), std::cos(x), std::tan(x), std::exp(x), std::log(x), std::atan2(x, 2.0),
                           std::pow(x, 1.7), std::hypot(x, 1.0), std::tanh(x)}) {
      libm.add(y);
    }
  }
  return compiler + "/glibc-" + gnu_get_libc_version() + "/libm-" + libm.text().substr(0, 8);
}

struct Traced {
  std::string name;
  std::string scenario;
  std::vector<std::string> settings;
};

// Short courses that pass through what can round: flat floor, noise of every kind, cables, casters, arcs, payloads.
const std::vector<Traced> kTraced = {
    {"nominal", "nominal", {"course.side_m=1", "runs.per_direction=1"}},
    {"exact", "labmate_exact", {"course.side_m=1", "runs.per_direction=1"}},
    {"umbmark", "umbmark", {"course.side_m=1", "runs.per_direction=2", "noise.radius_scatter=0.0001"}},
    {"cables", "extended_umbmark", {"course.side_m=1", "runs.per_direction=1", "bumps.count=3"}},
    {"circle", "circle", {"runs.per_direction=1"}},
    {"fixes", "uncertainty", {"course.side_m=1", "runs.per_direction=2"}},
    {"optiodom",
     "nominal",
     {"robot.urdf=optiodom.urdf", "course.side_m=1", "runs.per_direction=1", "noise.floor_rms_m=0.0005",
      "noise.floor_wavelength_m=0.5", "effects.load_shift={payload_kg: 2}",
      "effects.wheel_radius_difference.relative=0.01"}},
};

std::string trace_hash(const Traced& traced) {
  const ExperimentResult r =
      run_experiment(shipped(traced.scenario, traced.settings), 0, false, {Rows::To::memory, {}});
  Hash hash;
  hash.add(r.recording);
  for (const CalibrationPass& pass : r.passes) hash.add(pass.recording);
  if (r.umbmark) {
    for (const Cluster* c : {&r.umbmark->cw, &r.umbmark->ccw}) {
      for (const double x : {c->centroid_x_m, c->centroid_y_m, c->heading_rad}) hash.add(x);
    }
  }
  return hash.text();
}

// platform -> scenario -> hash
using Golden = std::map<std::string, std::map<std::string, std::string>>;

Golden read_golden() {
  Golden golden;
  std::ifstream in(kFile);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string platform, name, hash;
    if (words >> platform >> name >> hash && platform[0] != '#') golden[platform][name] = hash;
  }
  return golden;
}

void write_golden(const Golden& golden) {
  std::ofstream out(kFile);
  out << "# Hashes of traces. Written by UMBSIM_GOLDEN=write build/release/tests/experiment/golden_test\n";
  for (const auto& [platform, hashes] : golden) {
    for (const auto& [name, hash] : hashes) out << platform << ' ' << name << ' ' << hash << '\n';
  }
  ASSERT_TRUE(out.flush()) << kFile;
}

TEST(Golden, TracesAreThoseThatAreKept) {
  std::map<std::string, std::string> now;
  for (const Traced& traced : kTraced) now[traced.name] = trace_hash(traced);
  Golden golden = read_golden();
  const char* wish = std::getenv("UMBSIM_GOLDEN");
  if (wish && std::string(wish) == "write") {
    golden[platform()] = now;
    write_golden(golden);
    return;
  }
  if (!golden.count(platform())) {
    GTEST_SKIP() << "no traces are kept for " << platform() << "; UMBSIM_GOLDEN=write keeps them in " << kFile;
  }
  EXPECT_EQ(golden[platform()], now) << "if figures are meant to change: UMBSIM_GOLDEN=write renews " << kFile;
}

}  // namespace
}  // namespace umbsim

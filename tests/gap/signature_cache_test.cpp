// Tracks that are kept: the same bytes, whatever happens to the files.
#include "gap/replay/signature_cache.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

#include "gap/replay/signature_files.h"
#include "tests/gap/recordings.h"

namespace umbsim::gap {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string pattern = (fs::path(::testing::TempDir()) / "signatures_XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path); }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file()) all.push_back(entry.path());
    }
    return all;
  }
  fs::path path;
};

Recording two_runs() {
  Recording r;
  r.robot = {"labmate.urdf", 0.075, 0.34, 2000};
  for (const char* id : {"cw-1", "ccw-1"}) {
    RecordedRun run;
    run.id = id;
    run.encoders = {{0, 0, 0}, {0.1, 5, 6}};
    run.truth = {{0, {}}, {0.1, {0.01, 0, 0}}};
    r.runs.push_back(run);
  }
  return r;
}

/// A simulator whose tracks depend on everything that it is told, and that counts.
struct Counted {
  std::shared_ptr<std::atomic<int>> calls = std::make_shared<std::atomic<int>>(0);
  Simulator simulator() const {
    const auto number = [](std::size_t run, const std::vector<Effect>& effects) {
      double x = std::sqrt(2.0) + double(run);
      for (const Effect& e : effects) x += std::exp(e.values.numbers.front()) * double(e.info->name.size());
      return x;
    };
    return {[calls = calls, number](std::size_t run, const std::vector<Effect>& effects, double roughness) {
              ++*calls;
              const double x = number(run, effects) + roughness;
              return std::vector<Pose2>{{x, 1 / x, -x}, {x * x, 0, std::sin(x)}};
            },
            [calls = calls, number](std::size_t run, const std::vector<Effect>& effects) {
              ++*calls;
              return std::vector<std::array<double, 2>>{{number(run, effects), 0.1}};
            },
            {}};
  }
};

const std::vector<Effect> kWide{testing::effect("wheelbase", {{"relative", 0.01}})};
const std::vector<Effect> kWider{testing::effect("wheelbase", {{"relative", 0.02}})};

bool same(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Pose2)) == 0;
}

TEST(SignatureCache, TheSameBytesAndNothingTwice) {
  const Folder folder;
  const Recording recording = two_runs();
  const Counted counted;
  const Simulator plain = counted.simulator();
  for (int call_of_the_program = 0; call_of_the_program < 2; ++call_of_the_program) {
    const Counted own;
    const Simulator kept = cached(own.simulator(), recording, "robot", {folder.path});
    for (int again = 0; again < 2; ++again) {
      for (std::size_t run = 0; run < 2; ++run) {
        for (const auto& effects : {std::vector<Effect>{}, kWide, kWider}) {
          EXPECT_TRUE(same(kept.ticks(run, effects, 0), plain.ticks(run, effects, 0)));
          EXPECT_EQ(kept.commands(run, effects), plain.commands(run, effects));
        }
      }
    }
    EXPECT_EQ(*own.calls, call_of_the_program == 0 ? 12 : 0);
  }
  // A rough floor is another floor.
  const Counted rough;
  const Simulator kept = cached(rough.simulator(), recording, "robot", {folder.path});
  for (int again = 0; again < 2; ++again) {
    EXPECT_TRUE(same(kept.ticks(0, kWide, 1e-4), plain.ticks(0, kWide, 1e-4)));
    EXPECT_FALSE(same(kept.ticks(0, kWide, 1e-4), kept.ticks(0, kWide, 0)));
  }
  EXPECT_EQ(*rough.calls, 1);
  // Another robot, another run: nothing of it is known.
  const Counted other;
  cached(other.simulator(), recording, "another robot", {folder.path}).ticks(0, {}, 0);
  Recording changed = recording;
  changed.runs[0].encoders[1].left_ticks = 4;
  cached(other.simulator(), changed, "robot", {folder.path}).ticks(0, {}, 0);
  EXPECT_EQ(*other.calls, 2);
}

TEST(SignatureCache, BrokenFilesAreComputedAgain) {
  const Folder folder;
  const Recording recording = two_runs();
  const Counted counted;
  const std::vector<Pose2> right = cached(counted.simulator(), recording, "", {folder.path}).ticks(0, kWide, 0);
  ASSERT_EQ(folder.files().size(), 1u);
  const fs::path file = folder.files().front();
  const auto whole = fs::file_size(file);
  const auto harms = {std::function<void()>([&] { fs::resize_file(file, whole - 1); }),
                      std::function<void()>([&] { fs::resize_file(file, 0); }),
                      std::function<void()>([&] { std::ofstream(file) << "something else"; }),
                      std::function<void()>([&] {
                        std::fstream f(file, std::ios::in | std::ios::out | std::ios::binary);
                        f.seekp(std::streamoff(whole) - 80);  // within the numbers
                        f.put('x');
                      })};
  int expected = 1;
  for (const auto& harm : harms) {
    harm();
    EXPECT_TRUE(same(cached(counted.simulator(), recording, "", {folder.path}).ticks(0, kWide, 0), right));
    EXPECT_EQ(*counted.calls, ++expected);
    EXPECT_EQ(fs::file_size(file), whole) << "it is written again";
  }
}

TEST(SignatureCache, AFolderThatCannotBeWrittenIsDoneWithout) {
  const Folder folder;
  std::ofstream(folder.path / "file") << "";
  const Counted counted;
  const Simulator kept = cached(counted.simulator(), two_runs(), "", {folder.path / "file" / "below"});
  EXPECT_TRUE(same(kept.ticks(1, kWide, 0), counted.simulator().ticks(1, kWide, 0)));
  EXPECT_EQ(folder.files().size(), 1u);
}

TEST(SignatureCache, TwoProcessesAtOnce) {
  const Folder folder;
  constexpr int kKeys = 200;
  const auto key = [](int i) { return fmt::format("{:064x}", i); };
  const auto numbers = [](int i) { return std::vector<double>(1000, 1.0 / (i + 1)); };
  std::vector<pid_t> children;
  for (int process = 0; process < 2; ++process) {
    const pid_t child = fork();
    if (child == 0) {
      bool right = true;
      {
        SignatureFiles files(folder.path, 1u << 30);
        for (int i = 0; i < kKeys; ++i) {
          files.write(key(i), numbers(i));
          const auto read = files.read(key(i));
          right = right && read && *read == numbers(i);
        }
      }
      _exit(right ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(folder.files().size(), std::size_t(kKeys)) << "nothing half written is left";
}

TEST(SignatureCache, TheOldestGoFirst) {
  const Folder folder;
  constexpr std::uint64_t kBound = 100'000;
  const auto key = [](int i) { return fmt::format("{:064x}", i); };
  {
    SignatureFiles files(folder.path, kBound);
    for (int i = 0; i < 30; ++i) {
      files.write(key(i), std::vector<double>(1000, i));
      fs::last_write_time(folder.path / "00" / key(i), fs::file_time_type::clock::now() - std::chrono::minutes(59 - i));
    }
  }
  std::uint64_t bytes = 0;
  for (const fs::path& file : folder.files()) bytes += fs::file_size(file);
  EXPECT_LE(bytes, kBound);
  const SignatureFiles files(folder.path, kBound);
  EXPECT_FALSE(files.read(key(0)));
  EXPECT_TRUE(files.read(key(29)));
}

}  // namespace
}  // namespace umbsim::gap

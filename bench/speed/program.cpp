// The program as a user starts it, `umbsim run`, in a process of its own: time on the clock, time on the processors and
// peak memory, with start-up and writing of the result folder.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

struct Cost {
  double wall_s = 0;
  double cpu_s = 0;
  double peak_mib = 0;
};

double seconds(const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); }

pid_t start(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawn(&child, argv[0], &quiet, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) throw std::runtime_error("cannot start " + words[0]);
  return child;
}

Cost run_program(int per_direction, int jobs) {
  const auto folder = std::filesystem::temp_directory_path() / ("umbsim-bench-" + std::to_string(getpid()));
  const std::vector<std::string> words{UMBSIM_PROGRAM, "run", UMBSIM_SCENARIOS_DIR "/umbmark.yaml",
                                       "--set", "calibration.method=none",
                                       "--set", "runs.per_direction=" + std::to_string(per_direction),
                                       "--jobs", std::to_string(jobs), "--out", folder.string(), "--force"};
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = start(words);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::filesystem::remove_all(folder);
  if (status != 0) throw std::runtime_error("umbsim run failed");
  return {wall_s, seconds(usage.ru_utime) + seconds(usage.ru_stime), double(usage.ru_maxrss) / 1024};
}

// One and two cores in turn, so that both meet the same machine.
void one_and_two_cores(benchmark::State& state) {
  Cost best[2];
  for (auto _ : state) {
    double both_s = 0;
    for (int jobs = 1; jobs <= 2; ++jobs) {
      const Cost cost = run_program(int(state.range(0)), jobs);
      Cost& b = best[jobs - 1];
      const double peak_mib = std::max(b.peak_mib, cost.peak_mib);
      if (b.wall_s == 0 || cost.wall_s < b.wall_s) b = cost;
      b.peak_mib = peak_mib;
      both_s += cost.wall_s;
    }
    state.SetIterationTime(both_s);
  }
  state.counters["one_core_s"] = best[0].wall_s;
  state.counters["two_cores_s"] = best[1].wall_s;
  state.counters["one_core_cpu_s"] = best[0].cpu_s;
  state.counters["two_cores_cpu_s"] = best[1].cpu_s;
  state.counters["scaling"] = best[0].wall_s / best[1].wall_s;
  state.counters["peak_mib"] = std::max(best[0].peak_mib, best[1].peak_mib);
}

// Ten runs, and two hundred.
BENCHMARK(one_and_two_cores)->Name("umbmark")->Arg(5)->ArgName("per_direction")->Iterations(15)
    ->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(one_and_two_cores)->Name("sweep")->Arg(100)->ArgName("per_direction")->Iterations(3)
    ->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

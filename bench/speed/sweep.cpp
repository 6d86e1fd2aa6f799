// What a sweep costs beside its runs, and what a large store costs: umbsim_sweep_bench SWEEP.yaml [POINTS].
// The same points are driven bare, by run_experiment alone, and by run_sweep, in turn, so that both meet the same
// machine. Processor time is that of all threads, the median of all repeats. Then a store of POINTS (100000) points is
// written, merged, opened, filtered and exported.
#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include "batch/store/store_export.h"
#include "experiment/output/figures.h"
#include "experiment/run.h"
#include "experiment/sweep/run_sweep.h"

namespace {

namespace fs = std::filesystem;
using namespace umbsim;

constexpr int kRepeats = 15;

struct Cost {
  double wall_s = 0;
  double cpu_s = 0;
};

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class Work>
Cost measured(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu_begin = cpu_s();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), cpu_s() - cpu_begin};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void overhead(const Sweep& sweep, const fs::path& folder) {
  std::vector<Scenario> scenarios;
  for (std::int64_t i = 0; i < sweep.points; ++i) scenarios.push_back(scenario_of(sweep, sweep_point(sweep, i)));
  std::vector<double> bare_cpu, sweep_cpu, bare_wall, sweep_wall;
  for (int i = 0; i < kRepeats; ++i) {
    const Cost bare = measured([&] {
      tbb::parallel_for(std::size_t(0), scenarios.size(),
                        [&](std::size_t k) { run_experiment(scenarios[k], 0, false); });
    });
    const Cost whole = measured([&] { run_sweep(sweep, {folder, 0, {}, true, false}); });
    bare_cpu.push_back(bare.cpu_s), bare_wall.push_back(bare.wall_s);
    sweep_cpu.push_back(whole.cpu_s), sweep_wall.push_back(whole.wall_s);
  }
  const double bare_s = median(bare_cpu), sweep_s = median(sweep_cpu);
  fmt::print("{} points: bare {:.3f} s of processor, {:.3f} s on the clock; sweep {:.3f} s, {:.3f} s\n", sweep.points,
             bare_s, median(bare_wall), sweep_s, median(sweep_wall));
  fmt::print("overhead {:+.1f} % of processor time; {:.0f} points per core-hour; {:.0f} bytes per point\n",
             100 * (sweep_s / bare_s - 1), double(sweep.points) * 3600 / sweep_s,
             double(fs::file_size(folder / "sweep.sqlite")) / double(sweep.points));
}

StoredPoint made_up(const StoreLayout& layout, std::int64_t number) {
  StoredPoint p;
  p.number = number;
  p.axes = {double(number % 1000) / 1000, std::string(number % 2 ? "heading" : "endpoint")};
  // As full as the points of a calibrated UMBmark are: some 140 figures.
  for (std::size_t i = 0; i < layout.figures.size(); ++i) {
    p.figures.emplace_back();
    if (i % 5 < 3) p.figures.back() = 1 / (double(number) + double(i) + 1.5);
  }
  for (int i = 0; i < 10; ++i) p.runs.push_back({fmt::format("cw-{}", i), "cw", "before", 0.1 / (i + 1), 0.2, 0.3});
  return p;
}

void large_store(std::int64_t points, const fs::path& folder) {
  const StoreLayout layout{"bench", "bench", points, {"course.side_m", "calibration.method"}, figure_names()};
  const fs::path file = folder / "large.sqlite";
  const Cost writing = measured([&] {
    Store store = Store::open_for(file, layout, {{"version", "bench"}}, Store::Journal::wal);
    for (std::int64_t i = 0; i < points; ++i) store.put(made_up(layout, i));
    store.settle();
  });
  fmt::print("{} stored points: {:.0f} MB, {:.1f} s to write one by one\n", points, double(fs::file_size(file)) / 1e6,
             writing.wall_s);
  const Cost merging = measured([&] {
    Store merged = Store::open_for(folder / "merged.sqlite", layout, {{"version", "bench"}}, Store::Journal::wal);
    merged.take_over(file);
    merged.settle();
  });
  fmt::print("merging them into an empty store: {:.1f} s\n", merging.wall_s);
  const auto time = [&](const char* what, const ExportChoice& choice) {
    std::int64_t rows = 0;
    const Cost cost = measured([&] {
      Store store = Store::open(file);
      rows = export_store(store, choice);
    });
    fmt::print("{}: {} rows, {:.2f} s ({:.2f} s of processor), {:.0f} MB\n", what, rows, cost.wall_s, cost.cpu_s,
               double(fs::file_size(choice.file)) / 1e6);
  };
  const std::vector<Condition> where{parse_condition("course.side_m >= 0.5", ""),
                                     parse_condition("calibration.method = heading", "")};
  time("opening, all to CSV", {false, {}, {}, folder / "all.csv"});
  time("opening, all to JSON", {true, {}, {}, folder / "all.json"});
  time("opening, filtering, to CSV", {false, {}, where, folder / "some.csv"});
  time("opening, filtering, four columns to CSV",
       {false, {"point", "course.side_m", "recovery.e_d_error", "recovery.e_b_error"}, where, folder / "few.csv"});
  time("opening, all, four columns to JSON",
       {true, {"point", "course.side_m", "recovery.e_d_error", "recovery.e_b_error"}, {}, folder / "few.json"});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: umbsim_sweep_bench SWEEP.yaml [POINTS]\n");
    return 2;
  }
  const fs::path folder = fs::temp_directory_path() / fmt::format("umbsim-sweep-bench-{}", getpid());
  const Sweep sweep = read_sweep(argv[1], {},
                                 {"effects.wheel_radius_difference.relative={from: -0.01, to: 0.01, count: 5}",
                                  "effects.wheelbase.relative={from: -0.04, to: 0.04, count: 5}"});
  overhead(sweep, folder / "sweep");
  large_store(argc > 2 ? std::stoll(argv[2]) : 100000, folder);
  fs::remove_all(folder);
}

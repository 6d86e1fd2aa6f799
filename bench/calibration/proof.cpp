// umbsim_calibration_proof FOLDER [ROBOTS]: drives a Latin hypercube of robots in the simulator, calibrates each by
// every method, and writes table.md and picture.svg: bias, spread and coverage of the intervals.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "bench/calibration/page.h"
#include "bench/calibration/robots.h"
#include "calibration/methods/methods.h"
#include "core/text/text_file.h"
#include "experiment/run.h"

namespace umbsim::bench {
namespace {

using namespace calibration;

constexpr double kPerTenThousand = 1e4;
constexpr int kRobots = 200;
constexpr std::uint64_t kSeed = 27;

/// Error of one figure (log of found over true) and whether its interval held the truth.
struct Found {
  bool given = false;
  double error = 0;
  bool interval = false;
  bool held = false;
};

using FoundByMethod = std::map<std::string, std::array<Found, 3>>;

std::array<Found, 3> found(const Fit& fit, const LogFactors& truth, const OdometryParameters& nominal) {
  const FitFigures f = figures(fit, nominal);
  Fit exact;
  exact.factors = truth;
  const FitFigures t = figures(exact, nominal);
  const std::array<const Estimate*, 3> estimates{&f.e_d, &f.e_b, &f.mean_radius_m};
  const std::array<double, 3> truths{t.e_d.value, t.e_b.value, t.mean_radius_m.value};
  std::array<Found, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i].given = i < 2 || fit.scale_observed;
    result[i].error = std::log(estimates[i]->value / truths[i]);
    result[i].interval = result[i].given && estimates[i]->has_interval();
    result[i].held = result[i].interval && estimates[i]->low <= truths[i] && truths[i] <= estimates[i]->high;
  }
  return result;
}

FoundByMethod calibrated(const ProofRobot& robot) {
  FoundByMethod all;
  const Scenario scenario = proof_scenario(robot);
  const std::vector<Recording> squares{run_experiment(scenario, 1).recording};
  const std::vector<Recording> circles{run_experiment(on_circles(scenario), 1).recording};
  const OdometryParameters nominal = nominal_odometry(squares[0].robot);
  const LogFactors truth = true_factors(scenario);
  for (const Method& m : methods()) {
    all[m.name] = {};
    const bool on_circle = std::string(m.name) == "circles";
    const Runs runs = training_runs(on_circle ? circles : squares, {"runs"});
    try {
      all[m.name] = found(fit_with(m, runs, nominal), truth, nominal);
    } catch (const NotApplicable&) {  // counts as no answer
    }
  }
  return all;
}

FigureScore score(const std::vector<FoundByMethod>& robots, const std::string& method, std::size_t figure) {
  FigureScore s;
  double sum = 0, squares = 0, held = 0;
  for (const FoundByMethod& robot : robots) {
    const Found& f = robot.at(method)[figure];
    if (!f.given) continue;
    ++s.robots;
    sum += f.error;
    squares += f.error * f.error;
    s.intervals += f.interval;
    held += f.held;
  }
  if (s.robots < 2) return s;
  const double n = s.robots, variance = (squares - sum * sum / n) / (n - 1);
  s.bias = kPerTenThousand * sum / n;
  s.spread = kPerTenThousand * std::sqrt(variance);
  s.bias_se = s.spread / std::sqrt(n);
  s.covered = s.intervals > 0 ? held / s.intervals : 0;
  return s;
}

void prove(const std::filesystem::path& folder, int count) {
  const std::vector<ProofRobot> robots = proof_robots(count, kSeed);
  std::vector<FoundByMethod> all(robots.size());
  tbb::parallel_for(std::size_t(0), robots.size(), [&](std::size_t i) { all[i] = calibrated(robots[i]); });
  std::vector<MethodScore> scores;
  for (const Method& m : methods()) {
    scores.push_back({m.name, {}});
    for (std::size_t f = 0; f < 3; ++f) scores.back().figures[f] = score(all, m.name, f);
  }
  std::filesystem::create_directories(folder);
  write_text_file(folder / "table.md", score_table(scores));
  write_text_file(folder / "picture.svg", score_picture(scores));
  fmt::print("{}", score_table(scores));
}

}  // namespace
}  // namespace umbsim::bench

int main(int count, char** words) {
  if (count < 2) {
    fmt::print(stderr, "usage: umbsim_calibration_proof FOLDER [ROBOTS]\n");
    return 2;
  }
  umbsim::bench::prove(words[1], count > 2 ? std::atoi(words[2]) : umbsim::bench::kRobots);
}

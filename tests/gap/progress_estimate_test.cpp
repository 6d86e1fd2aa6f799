// How far a diagnosis has come, held against what real ones took: processor times of recordings of several kinds, as
// they were measured (progress_traces.csv: seconds, stage, share of it). No test here looks at a clock.
#include "gap/output/progress_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <vector>

namespace umbsim::gap {
namespace {

struct Event {
  double at_s = 0;
  std::string stage;
  double share = 0;
};
using Trace = std::vector<Event>;  ///< the last event is the end

std::map<std::string, Trace> traces() {
  std::map<std::string, Trace> all;
  std::ifstream file(std::string(UMBSIM_SOURCE_DIR) + "/tests/gap/progress_traces.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string name, at, share;
    Event e;
    std::getline(cells, name, ',');
    std::getline(cells, at, ',');
    std::getline(cells, e.stage, ',');
    std::getline(cells, share);
    e.at_s = std::stod(at);
    e.share = std::stod(share);
    all[name].push_back(e);
  }
  return all;
}

/// What was shown at a moment, and how long it really took from then on.
struct Moment {
  double fraction = 0;
  double left_s = 0;
  double really_left_s = 0;
};

// Looks at it at every event, and between two of them a few times, when nothing new is known.
std::vector<Moment> watched(const Trace& trace) {
  constexpr int kBetween = 4;
  ProgressEstimate estimate(stages_of_diagnosis());
  std::vector<Moment> moments;
  const double end_s = trace.back().at_s;
  for (std::size_t i = 0; i + 1 < trace.size(); ++i) {
    estimate.reached(trace[i].stage, trace[i].share, trace[i].at_s);
    for (int k = 0; k < kBetween; ++k) {
      const double now_s = trace[i].at_s + (trace[i + 1].at_s - trace[i].at_s) * k / kBetween;
      moments.push_back({estimate.fraction(now_s), estimate.left_s(now_s), end_s - now_s});
    }
  }
  estimate.finished();
  moments.push_back({estimate.fraction(end_s), 0, 0});
  return moments;
}

TEST(ProgressEstimate, NeverGoesBackAndEndsAtTheWhole) {
  ASSERT_GE(traces().size(), 6u);
  for (const auto& [name, trace] : traces()) {
    double before = 0;
    for (const Moment& m : watched(trace)) {
      EXPECT_GE(m.fraction, before) << name;
      before = m.fraction;
      if (m.really_left_s > 0) {
        EXPECT_LT(m.fraction, 1) << name << ": the whole, and " << m.really_left_s << " s are left";
      }
    }
    EXPECT_EQ(before, 1) << name;
  }
}

TEST(ProgressEstimate, NeverSaysThatItIsNearlyDoneWhileMuchIsLeft) {
  constexpr double kMuch = 0.2;     // of the whole time
  constexpr double kNearly = 0.15;  // of what is really left
  for (const auto& [name, trace] : traces()) {
    const double whole_s = trace.back().at_s;
    for (const Moment& m : watched(trace)) {
      if (m.left_s < 0 || m.really_left_s < kMuch * whole_s) continue;
      EXPECT_GT(m.left_s, kNearly * m.really_left_s)
          << name << " at " << whole_s - m.really_left_s << " of " << whole_s;
    }
  }
}

// The error of the time left, by how far the work has come: printed for docs/gap.md.
TEST(ProgressEstimate, IsRightWithinAFactorMostOfTheTime) {
  std::vector<double> factors;
  for (const auto& [name, trace] : traces()) {
    const double whole_s = trace.back().at_s;
    std::cout << name << ", " << whole_s << " s: said / really left";
    std::vector<Moment> moments = watched(trace);
    for (const double share : {0.1, 0.25, 0.5, 0.75}) {
      const auto at = std::find_if(moments.begin(), moments.end(),
                                   [&](const Moment& m) { return m.really_left_s <= (1 - share) * whole_s; });
      if (at->left_s < 0 || at->really_left_s <= 0) continue;
      factors.push_back(at->left_s / at->really_left_s);
      std::cout << "; at " << 100 * share << " %: " << std::round(10 * at->left_s) / 10 << " / "
                << std::round(10 * at->really_left_s) / 10 << " s (shown " << std::floor(100 * at->fraction) << " %)";
    }
    std::cout << "\n";
  }
  std::sort(factors.begin(), factors.end());
  const auto quantile = [&](double q) { return factors[std::size_t(q * double(factors.size() - 1))]; };
  std::cout << "said over really left: median " << quantile(0.5) << ", 10 % " << quantile(0.1) << ", 90 % "
            << quantile(0.9) << "\n";
  EXPECT_GT(quantile(0.5), 0.5);
  EXPECT_LT(quantile(0.5), 2.0);
  EXPECT_GT(quantile(0.1), 0.25);
  EXPECT_LT(quantile(0.9), 4.0);
}

// Bookkeeping without any recording.
TEST(ProgressEstimate, StagesThatDoNotComeAreSkippedAndNothingIsKnownAtFirst) {
  ProgressEstimate estimate({{"a", 1}, {"b", 4, 0.5}, {"c", 1}});
  EXPECT_LT(estimate.left_s(0), 0);
  EXPECT_EQ(estimate.fraction(0), 0);
  estimate.reached("a", 0.4, 0.8);
  EXPECT_LT(estimate.left_s(0.8), 0) << "the first stage is the measure of the others";
  estimate.reached("a", 0.5, 1);
  EXPECT_NEAR(estimate.left_s(1), 1 + 2 * (0.5 * 4) + 2, 1e-9) << "half of a, half of b's time, and c";
  estimate.reached("c", 0, 2);
  EXPECT_NEAR(estimate.left_s(2), 2, 1e-9) << "a took 2 s, c usually takes as long";
  const double there = estimate.fraction(2);
  EXPECT_NEAR(there, 0.5, 1e-9);
  EXPECT_GT(estimate.left_s(5), 2) << "c takes longer than usual: what is left does not shrink to nothing";
  EXPECT_GE(estimate.fraction(5), there);
  estimate.reached("a", 1, 6);  // stages do not come back
  EXPECT_EQ(estimate.current()->name, "c");
  estimate.finished();
  EXPECT_EQ(estimate.fraction(7), 1);
}

}  // namespace
}  // namespace umbsim::gap

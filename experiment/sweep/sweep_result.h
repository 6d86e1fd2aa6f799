#pragma once

#include <string>
#include <vector>

#include "batch/store/store.h"
#include "experiment/output/result_json.h"
#include "experiment/sweep/junit.h"
#include "experiment/sweep/sweep.h"

namespace umbsim {

/// A warning of a point that was driven.
struct WarnedPoint {
  std::int64_t number = 0;
  std::string label;
  std::string warning;
};

/// What a store holds, measured against the sweep's expectations.
struct SweepResult {
  std::int64_t done = 0;
  std::int64_t missing = 0;
  std::vector<FailedPoint> failed;
  std::vector<WarnedPoint> warned;
  std::vector<Check> checks;
  /// Points may fail where the sweep says so.
  bool failures_are_expected = false;
};
SweepResult measure_sweep(const Sweep& sweep, Store& store);

/// sweep.json (format umbsim-sweep-result/1).
Json sweep_json(const Sweep& sweep, const SweepResult& result);

/// What the report page of a sweep is made from. Of a large sweep it holds the main figures only, and then every k-th
/// point, so that the page stays small.
Json sweep_report_json(const Sweep& sweep, Store& store, const SweepResult& result);

}  // namespace umbsim

#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gap/trial/score/verdict.h"

namespace umbsim {

/// A share of the cases of one group.
struct Tally {
  int cases = 0;
  int right = 0;
  int right_or_tied = 0;
  int in_set = 0;
  int detected = 0;
  int unknown = 0;
  void add(const Verdict& v);
};

/// One bin of the calibration curve: first causes whose stated probability lies in it.
struct CalibrationBin {
  double from = 0;
  double to = 0;
  int cases = 0;
  int right = 0;
  double mean_probability = 0;
};

struct SeverityBin {
  double from = 0;
  double to = 0;
  Tally tally;
};

/// Rows: truth; columns: what was named first.
struct Confusion {
  std::vector<std::string> rows;
  std::vector<std::string> columns;
  std::map<std::pair<std::string, std::string>, int> counts;
};

std::map<std::string, Tally> by_tier(const std::vector<Verdict>& verdicts);
/// Of the single tier.
std::map<std::string, Tally> by_effect(const std::vector<Verdict>& verdicts);
/// Of the single tier, with known severity; edges 0.5, 1, 2, 5, 10 noise floors.
std::vector<SeverityBin> by_severity(const std::vector<Verdict>& verdicts);
/// Of all cases, in tenths.
std::vector<CalibrationBin> calibration_curve(const std::vector<Verdict>& verdicts);
/// Of no_effect, single, pairs and outside.
Confusion confusion(const std::vector<Verdict>& verdicts);

}  // namespace umbsim

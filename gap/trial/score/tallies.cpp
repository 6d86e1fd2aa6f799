#include "gap/trial/score/tallies.h"

#include <algorithm>
#include <limits>

namespace umbsim {

void Tally::add(const Verdict& v) {
  ++cases;
  right += v.right;
  right_or_tied += v.right_or_tied;
  in_set += v.in_set;
  detected += v.detected;
  unknown += v.unknown;
}

std::map<std::string, Tally> by_tier(const std::vector<Verdict>& verdicts) {
  std::map<std::string, Tally> tallies;
  for (const Verdict& v : verdicts) tallies[name(v.answer.tier)].add(v);
  return tallies;
}

std::map<std::string, Tally> by_effect(const std::vector<Verdict>& verdicts) {
  std::map<std::string, Tally> tallies;
  for (const Verdict& v : verdicts) {
    if (v.answer.tier == Tier::single) tallies[v.truth].add(v);
  }
  return tallies;
}

std::vector<SeverityBin> by_severity(const std::vector<Verdict>& verdicts) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<double> edges{0, 0.5, 1, 2, 5, 10, kInfinity};
  std::vector<SeverityBin> bins;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) bins.push_back({edges[i], edges[i + 1], {}});
  for (const Verdict& v : verdicts) {
    const std::optional<double> severity = v.answer.severity();
    if (v.answer.tier != Tier::single || !severity) continue;
    for (SeverityBin& bin : bins) {
      if (*severity >= bin.from && *severity < bin.to) bin.tally.add(v);
    }
  }
  return bins;
}

std::vector<CalibrationBin> calibration_curve(const std::vector<Verdict>& verdicts) {
  constexpr int kBins = 10;
  std::vector<CalibrationBin> bins;
  for (int i = 0; i < kBins; ++i) bins.push_back({double(i) / kBins, double(i + 1) / kBins, 0, 0, 0});
  for (const Verdict& v : verdicts) {
    if (v.failed) continue;
    CalibrationBin& bin = bins[std::size_t(std::clamp(int(v.probability * kBins), 0, kBins - 1))];
    bin.mean_probability = (bin.mean_probability * bin.cases + v.probability) / (bin.cases + 1);
    ++bin.cases;
    bin.right += v.right;
  }
  return bins;
}

Confusion confusion(const std::vector<Verdict>& verdicts) {
  Confusion c;
  c.rows = {"none"};
  c.columns = {"none"};
  for (const EffectInfo& info : catalogue()) {
    c.rows.push_back(info.name);
    c.columns.push_back(info.name);
  }
  for (const char* row : {"two effects", "outside the catalogue"}) c.rows.push_back(row);
  for (const char* column : {"combination", "unknown", "failed"}) c.columns.push_back(column);
  for (const Verdict& v : verdicts) {
    std::string row = v.truth;
    if (v.answer.tier == Tier::pairs) row = "two effects";
    if (v.answer.tier == Tier::outside) row = "outside the catalogue";
    if (v.answer.tier == Tier::end_points || v.answer.tier == Tier::poor_runs) continue;
    const std::string column = v.named.find('+') == std::string::npos ? v.named : "combination";
    ++c.counts[{row, column}];
  }
  return c;
}

}  // namespace umbsim

#include "gap/run_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace umbsim::gap {

RunGroups grouped(const Recording& recording) {
  RunGroups g;
  std::vector<std::string> keys;
  for (const RecordedRun& run : recording.runs) {
    const std::string turn = run.turn.value_or(recording.path.turn);
    const std::string key = fmt::format("{} {} {}", run.linear_speed_mps.value_or(0), run.payload_kg.value_or(0), turn);
    const auto found = std::find(keys.begin(), keys.end(), key);
    g.group_of.push_back(std::size_t(found - keys.begin()));
    if (found != keys.end()) continue;
    keys.push_back(key);
    g.rolling.push_back(turn == "arc");
  }
  return g;
}

}  // namespace umbsim::gap

#include "gap/replay/run_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace umbsim::gap {

RunGroups grouped(const std::vector<RecordedRun>& runs, const std::vector<const Recording*>& origin) {
  RunGroups g;
  std::vector<std::string> keys;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RecordedRun& run = runs[r];
    const std::string turn = run.turn.value_or(origin[r]->path.turn);
    const auto recording = std::find(origin.begin(), origin.end(), origin[r]) - origin.begin();
    const std::string key =
        fmt::format("{} {} {} {}", recording, run.linear_speed_mps.value_or(0), run.payload_kg.value_or(0), turn);
    const auto found = std::find(keys.begin(), keys.end(), key);
    g.group_of.push_back(std::size_t(found - keys.begin()));
    if (found != keys.end()) continue;
    keys.push_back(key);
    g.rolling.push_back(turn == "arc");
  }
  return g;
}

RunGroups grouped(const Recording& recording) {
  return grouped(recording.runs, std::vector<const Recording*>(recording.runs.size(), &recording));
}

}  // namespace umbsim::gap

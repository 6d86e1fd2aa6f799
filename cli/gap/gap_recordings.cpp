#include "cli/gap/gap_recordings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "calibration/intake/intake.h"
#include "calibration/intake/thinned.h"
#include "cli/gap/gap_simulator.h"
#include "cli/shipped.h"
#include "core/error.h"
#include "experiment/output/result_folder.h"
#include "gap/noise/clock.h"
#include "gap/replay/remembered.h"

namespace umbsim {
namespace {

// Readings of a track per second that a diagnosis uses. Errors of a track go on for a second or so, and nothing that is
// looked for is faster than a few hertz: more readings hardly tell more, and take memory and time.
constexpr double kTrack_hz = 30;

// Folders of one name are told apart by a number.
std::vector<std::string> names_of(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    std::string name = folder_name(folder);
    for (int i = 2; std::find(names.begin(), names.end(), name) != names.end(); ++i)
      name = fmt::format("{}-{}", folder_name(folder), i);
    names.push_back(name);
  }
  return names;
}

}  // namespace

GapRecordings::GapRecordings(const std::vector<std::string>& folders, const std::string& scenario) {
  if (folders.empty()) throw InputError("at least one recording is needed");
  const std::vector<std::string> names = names_of(folders);
  std::vector<Recording> recordings;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    auto [given, limits] = intake::take_in(folders[i]);
    recordings.push_back(intake::thinned_truth(gap::followed_through(given, limits), kTrack_hz));
    for (std::string& limit : limits)
      limits_.push_back(folders.size() > 1 ? names[i] + ": " + limit : std::move(limit));
  }
  name_ = fmt::format("{}", fmt::join(names, "+"));
  campaign_ = gap::joined(std::move(recordings), names);
  // In the order in which they are given, so that what wears goes on from one recording to the next.
  int first_run = 0;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const Recording& recording = campaign_.parts[i];
    replays_.emplace_back(scenario.empty() ? scenario_of(recording, folders[i])
                                           : read_scenario(shipped_path(ShippedKind::scenario, scenario)),
                          recording, true, first_run);
    first_run += int(recording.runs.size());
  }
}

gap::Simulator GapRecordings::simulator(bool no_cache) const {
  std::vector<gap::Simulator> each;
  for (const Replay& replay : replays_)
    each.push_back(gap::remembered(cached_gap_simulator(replay, no_cache), replay.recording()));
  return gap::joined(campaign_, std::move(each));
}

}  // namespace umbsim

#pragma once

#include <deque>
#include <string>
#include <vector>

#include "experiment/replay/replay.h"
#include "gap/replay/campaign.h"

namespace umbsim {

/// Recordings of one robot as a diagnosis follows them through: looked over, with clocks aligned, each with a replay of
/// its own. Not to be copied or moved: replays refer to recordings.
class GapRecordings {
 public:
  /// `scenario`: that was thought to describe them; empty: what each recording alone suggests. Throws InputError.
  GapRecordings(const std::vector<std::string>& folders, const std::string& scenario);
  GapRecordings(const GapRecordings&) = delete;
  GapRecordings& operator=(const GapRecordings&) = delete;

  const gap::Campaign& campaign() const { return campaign_; }
  /// Of the first recording.
  const Scenario& scenario() const { return replays_.front().scenario(); }
  const Replay& replay() const { return replays_.front(); }
  const std::vector<std::string>& limits() const { return limits_; }
  /// Names of the folders, joined by "+".
  const std::string& name() const { return name_; }

  /// Of all runs; tracks are kept while the program runs, and in the user's cache folder unless `no_cache`.
  gap::Simulator simulator(bool no_cache) const;

 private:
  gap::Campaign campaign_;
  std::deque<Replay> replays_;
  std::vector<std::string> limits_;
  std::string name_;
};

}  // namespace umbsim

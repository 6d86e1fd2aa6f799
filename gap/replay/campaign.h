#pragma once

#include <string>
#include <vector>

#include "gap/replay/simulator.h"
#include "recording/recording.h"

namespace umbsim::gap {

/// Recordings of one robot, their runs behind each other.
struct Campaign {
  Recording all;                     ///< the robot and all runs; of several recordings runs are named "recording/run"
  std::vector<Recording> parts;      ///< each recording as it was: path, encoders and tracker are its own
  std::vector<std::size_t> part_of;  ///< of each run

  bool several() const { return parts.size() > 1; }
  const Recording& of(std::size_t run) const { return parts[part_of[run]]; }
  /// Index within its own recording.
  std::size_t within(std::size_t run) const;
  /// Whether each of them was tracked all along, not at its ends alone.
  bool all_tracked() const;
};

Campaign campaign_of(Recording recording);

/// `names`: of the recordings, each once. Throws InputError where they state different wheels, wheelbases or counts: of
/// another robot, or another belief of it, they cannot be one.
Campaign joined(std::vector<Recording> recordings, const std::vector<std::string>& names);

/// One simulator for all runs of a campaign, from one of each part. How the robot was driven and read is asked of the
/// first part with commands, else of the first.
Simulator joined(const Campaign& campaign, std::vector<Simulator> simulators);

/// The part that says how the robot was driven and read.
std::size_t leading_part(const Campaign& campaign);

}  // namespace umbsim::gap

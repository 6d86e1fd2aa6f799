#pragma once

#include <functional>
#include <optional>

#include "batch/shard.h"
#include "bench/worlds/draw/plan.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim::worlds {

/// A folder of worlds is a trial's folder (gap/trial/write/trial_folder.h), with worlds.yaml in the place of
/// trial.yaml, so that `umbsim gap trial diagnose` and `score` work on it.
struct DrawResult {
  std::filesystem::path root;
  std::size_t cases = 0;
  std::size_t finished = 0;
  std::optional<std::string> seal;
  int worlds_redrawn = 0;  ///< of those drawn now: the nominal robot could not drive its runs
  int faults_redrawn = 0;  ///< the robot with its faults could not
  double wall_s = 0;
  std::size_t drawn_now = 0;
};

/// A case with its answer.
struct DrawnCase {
  World world;
  Recording recording;
  Json answer;
  int worlds_redrawn = 0;
  int faults_redrawn = 0;
};

/// What a folder of worlds is drawn from.
struct DrawSource {
  std::string name;
  std::uint64_t seed = 1;
  std::string worlds_yaml;                           ///< a folder with another one holds other worlds
  std::vector<CaseEntry> cases;                      ///< sorted by name
  std::function<DrawnCase(std::size_t index)> draw;  ///< called on several threads; the same every time
};

/// Draws what does not stand yet. Answers are sealed when every case stands. Throws InputError where the folder holds
/// something else, and what `draw` throws.
DrawResult draw_all(const DrawSource& source, const TrialFolder& folder, Shard shard, int jobs);
DrawResult draw_worlds(const WorldsPlan& plan, const TrialFolder& folder, Shard shard, int jobs);

/// Depends on the plan and the case alone. Throws RunError if no drawn world can be driven.
DrawnCase draw_case(const WorldsPlan& plan, const WorldCase& c);

}  // namespace umbsim::worlds

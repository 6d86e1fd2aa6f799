#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "gap/replay/campaign.h"
#include "gap/traits/signature_errors.h"
#include "recording/recording.h"

namespace umbsim::gap {

/// A recording beside what the simulator says of it without any effect. Outer index: run; inner: sample of the truth.
struct NominalReplay {
  const Recording* recording = nullptr;  ///< the robot and all runs; must outlive this
  std::vector<const Recording*> origin;  ///< of each run: with its path, encoders and tracker
  std::vector<std::string> conditions;   ///< of each run: speed, payload, kind of turn, start heading
  std::vector<std::vector<Pose2>> truth;
  std::vector<std::vector<Pose2>> tracks;
  std::vector<std::vector<std::array<double, 2>>> wheels_m;  ///< way of left and right wheel since the sample before
  std::vector<std::vector<double>> rolled_m;                 ///< mean of their absolute values
  std::vector<std::vector<Eigen::Vector3d>> velocity;        ///< along, across, turning: m/s, m/s, rad/s
  std::vector<std::vector<bool>> seen;  ///< whether a sample counts: of end points the first and the last, of a dense
                                        ///< track a few a second, for a tracker's errors go on from picture to picture
  std::size_t runs() const { return truth.size(); }
  bool same_condition(std::size_t a, std::size_t b) const {
    return origin[a] == origin[b] && conditions[a] == conditions[b] &&
           recording->runs[a].direction == recording->runs[b].direction;
  }
};

/// `tracks`: of every run, at the truth's times, without effects. The campaign, or recording, must outlive it.
NominalReplay beside(const Campaign& campaign, std::vector<std::vector<Pose2>> tracks);
NominalReplay beside(const Recording& recording, std::vector<std::vector<Pose2>> tracks);

/// The runs of one recording alone.
NominalReplay part_of(const NominalReplay& nominal, const Campaign& campaign, std::size_t part);

using Impulses3 = std::vector<Eigen::Vector3d>;  ///< (along, across, heading) before each sample

/// What a wheel whose radius is larger by one part in one adds to each step. `wheel`: 0 left, 1 right.
Impulses3 radius_impulses(const NominalReplay& nominal, std::size_t run, int wheel);

/// What a run does before each sample of its truth, by the ways of its wheels.
std::vector<CoursePart> parts_of(const NominalReplay& nominal, std::size_t run);

}  // namespace umbsim::gap

#pragma once

#include <optional>

#include "experiment/drive/drive_run.h"
#include "umbmark/course.h"

namespace umbsim {

/// Least friction with which a wheel climbs a round cable on its own traction: tan psi, cos psi = (R - r) / (R + r).
double climbing_friction(double wheel_radius_m, double cable_height_m);

/// Lays the scenario's cables one after another, evenly spread over their leg, just ahead of the wheel, and watches
/// whether the wheel gets over each.
class CableLayer {
 public:
  CableLayer(const Scenario& scenario, const RunSpec& spec, const Plan& plan);

  /// Call once per control period. `X_SB`: where the robot believes to be, `segment` of the plan.
  void lay_if_due(const Pose2& X_SB, int segment, World& world, const Rig& rig, RecordedRun& record);

  /// Not crossed: the wheel had not passed it when the next one was due or at the end of the leg, or went round its
  /// end.
  CableCount count() const { return {count_.not_crossed + int(last_.has_value()), count_.without_grip}; }

 private:
  void watch(const World& world, bool last_chance);
  Cable ahead_of_wheel(const World& world, const Rig& rig) const;

  LaidBumps bumps_;
  int wheel_;
  int leg_ = -1;
  int laid_ = 0;
  CableCount count_;
  std::optional<Cable> last_;  ///< laid and not yet passed
  Pose2 start_;
  double length_m_ = 0;
};

}  // namespace umbsim

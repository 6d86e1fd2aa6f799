#pragma once

#include <map>
#include <utility>
#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

constexpr double kSamePlace_m = 0.03;  ///< passes that are nearer than this are of one place

/// A sample on a leg: where, and how far off the smooth course, in the floor's frame.
struct Shifted {
  Pose2 X_WB;
  Eigen::Vector2d shift_m;
  int leg = 0;
  Eigen::Vector4d wheels = Eigen::Vector4d::Zero();  ///< cosines and sines of the wheels' angles
};

/// What a fit leaves along the legs of a run, a straight line through the neighbourhood taken out.
std::vector<Shifted> shifts_of(const Model& model, const Fit& fit, std::size_t run);

/// Takes out what goes with a wheel's angle, in the robot's frame.
void without_ripples(std::vector<Shifted>& run);

/// A run's samples by place.
class Passes {
 public:
  explicit Passes(std::vector<Shifted> all);
  const std::vector<Shifted>& all() const { return all_; }

  /// The sample nearest to a place, or null where none is near.
  const Shifted* nearest(const Pose2& place) const;

 private:
  using Spot = std::pair<long, long>;
  static Spot spot_of(const Pose2& place);

  std::vector<Shifted> all_;
  std::map<Spot, std::vector<std::size_t>> at_;
};

}  // namespace umbsim::gap

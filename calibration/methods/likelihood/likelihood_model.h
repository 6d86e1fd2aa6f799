#pragma once

#include <array>
#include <memory>
#include <vector>

#include "calibration/methods/likelihood/track_error.h"
#include "calibration/methods/likelihood/whitening.h"

namespace umbsim::calibration {

/// Everything that maximum likelihood fits, at its present values.
struct Model {
  std::vector<TrackError> runs;
  std::vector<std::size_t> block;  ///< of each run: which tracker
  std::vector<std::size_t> recordings;
  std::array<double, kRobotSize> robot{};
  std::vector<std::array<double, kTrackerSize>> trackers;
  std::vector<std::array<double, kStartSize>> starts;
  TrackNoise noise;
  std::vector<std::unique_ptr<Whitening>> whitening;
  bool scale = true;
  bool scrub = false;  ///< fitted, too; else none

  TrackError::Linearised at(std::size_t r) const {
    return runs[r].at(robot.data(), trackers[block[r]].data(), starts[r].data());
  }
};

/// Starts from the nominal robot, with every run at its first pose.
Model prepared(const Runs& runs, const OdometryParameters& nominal);

/// The whitening at the present values, which then stays while the parameters are fitted.
void set_whitening(Model& m);

/// Least squares of the whitened errors, by Ceres. Throws NotApplicable.
void solve(Model& m);

/// The noise levels that make what is left likeliest.
void fit_noise(Model& m);

/// Whether any run of this recording has a track, which can tell something of its tracker.
bool tracker_told(const Model& m, std::size_t tracker);

/// Standard deviations of what is believed before the data, about zero.
std::array<double, kTrackerSize> tracker_prior(const Model& m, std::size_t tracker);
std::array<double, kStartSize> start_prior(const TrackError& run);
double scrub_prior(const Model& m);

}  // namespace umbsim::calibration

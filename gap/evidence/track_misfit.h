#pragma once

#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// Mean square of the position error along the run, and the heading error at its end, after the best start pose.
struct TrackMisfit {
  double mean_square_m2 = 0;
  double end_rad = 0;
};

/// Of a simulated track against the recorded one, as track_error() gives it, but for how the tracker was mounted.
Eigen::VectorXd error_beside_mount(const Model& model, std::size_t run, const std::vector<Pose2>& predicted);

/// The error of its start (along, across, heading) that explains a track's error best.
Eigen::Vector3d best_start(const Model& model, std::size_t run, const Eigen::VectorXd& error);

/// `error`: of a predicted track against the recorded one, as track_error() gives it.
TrackMisfit aligned_misfit(const Model& model, std::size_t run, const Eigen::VectorXd& error);

/// Of a simulated track against the recorded one, but for how the tracker was mounted.
TrackMisfit aligned_misfit(const Model& model, std::size_t run, const std::vector<Pose2>& predicted);

/// Mean square position error of simulated tracks against the recorded ones, start poses aligned, m^2.
double mean_square_error_m2(const Model& model, const std::vector<std::vector<Pose2>>& tracks);

/// The root of it for a fit's tracks, on the runs that it was fitted on, mm.
double in_sample_error_mm(const Model& model, const Fit& fit);

constexpr int kNoiseDraws = 200;

/// Mean square position errors that noise alone makes where the prediction is right: heading and distance that walk,
/// wheels whose radii differ from run to run, the tracker. Drawn from the noise model; outer index: run, m^2.
/// `other_engine`: with what engines differ by (Scatter), alike in all runs of a draw.
std::vector<std::vector<double>> noise_misfits_m2(const Model& model, int draws, bool other_engine = false);

}  // namespace umbsim::gap

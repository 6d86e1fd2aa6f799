#include "gap/evidence/track_misfit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/random.h"

namespace umbsim::gap {
namespace {

// One track of noise: what a run strays, and what the tracker adds.
Eigen::VectorXd noise_track(const Model& model, std::size_t run, const Impulses3 radius[2], RandomStream& random) {
  const NoiseModel& noise = model.noise(run);
  const auto& rolled_m = model.nominal().rolled_m[run];
  const double scale[2] = {random.normal(0, model.radius_scatter(run)), random.normal(0, model.radius_scatter(run))};
  Impulses3 impulses(rolled_m.size(), Eigen::Vector3d::Zero());
  for (std::size_t k = 1; k < impulses.size(); ++k) {
    impulses[k] << random.normal(0, std::sqrt(noise.along_m2_pm * rolled_m[k])),
        random.normal(0, std::sqrt(noise.across_m2_pm * rolled_m[k])),
        random.normal(0, std::sqrt(noise.heading_rad2_pm * rolled_m[k]));
    for (int w = 0; w < 2; ++w) impulses[k] += scale[w] * radius[w][k];
  }
  Eigen::VectorXd error = model.filter(run).propagate(impulses);
  for (std::size_t k = 0; k < impulses.size(); ++k) {
    error[3 * Eigen::Index(k)] += random.normal(0, noise.position_sd_m);
    error[3 * Eigen::Index(k) + 1] += random.normal(0, noise.position_sd_m);
    error[3 * Eigen::Index(k) + 2] += random.normal(0, noise.heading_sd_rad);
  }
  return error;
}

}  // namespace

Eigen::VectorXd error_beside_mount(const Model& model, std::size_t run, const std::vector<Pose2>& predicted) {
  return track_error(predicted, model.nominal().truth[run]) - model.mount_error(run);
}

Eigen::Vector3d best_start(const Model& model, std::size_t run, const Eigen::VectorXd& error) {
  const TrackFilter& filter = model.filter(run);
  const auto products = filter.impulse_products(filter.whiten(error));
  return (products.with_itself[0] + 1e-9 * Eigen::Matrix3d::Identity()).ldlt().solve(products.with_column[0]);
}

TrackMisfit aligned_misfit(const Model& model, std::size_t run, const Eigen::VectorXd& error) {
  const TrackFilter& filter = model.filter(run);
  Impulses3 start(filter.samples(), Eigen::Vector3d::Zero());
  start[0] = best_start(model, run, error);
  const Eigen::VectorXd left = error - filter.propagate(start);
  TrackMisfit result;
  double seen = 0;
  for (std::size_t k = 0; k < filter.samples(); ++k) {
    if (!model.nominal().seen[run][k]) continue;
    result.mean_square_m2 += left.segment<2>(3 * Eigen::Index(k)).squaredNorm();
    seen += 1;
  }
  result.mean_square_m2 /= std::max(1.0, seen);
  result.end_rad = left[left.size() - 1];
  return result;
}

TrackMisfit aligned_misfit(const Model& model, std::size_t run, const std::vector<Pose2>& predicted) {
  return aligned_misfit(model, run, error_beside_mount(model, run, predicted));
}

double mean_square_error_m2(const Model& model, const std::vector<std::vector<Pose2>>& tracks) {
  double sum = 0;
  for (std::size_t r = 0; r < tracks.size(); ++r) sum += aligned_misfit(model, r, tracks[r]).mean_square_m2;
  return sum / double(tracks.size());
}

double in_sample_error_mm(const Model& model, const Fit& fit) {
  return 1000 * std::sqrt(mean_square_error_m2(model, fit.predicted.tracks));
}

std::vector<std::vector<double>> noise_misfits_m2(const Model& model, int draws, bool other_engine) {
  std::vector<Eigen::VectorXd> engines(std::size_t(draws), Eigen::VectorXd::Zero(model.nuisances()));
  RandomStream between(1, "difference of engines");
  for (Eigen::VectorXd& engine : engines) {
    for (Eigen::Index i = 0; i < engine.size() && other_engine; ++i)
      engine[i] = between.normal(0, model.engine_sd()[i]);
  }
  std::vector<std::vector<double>> squares(model.nominal().runs());
  tbb::parallel_for(std::size_t(0), squares.size(), [&](std::size_t r) {
    RandomStream random(1, "noise along a run", r);
    const Impulses3 radius[2] = {radius_impulses(model.nominal(), r, 0), radius_impulses(model.nominal(), r, 1)};
    for (int i = 0; i < draws; ++i) {
      const Eigen::VectorXd error =
          noise_track(model, r, radius, random) + model.engine_tracks(r) * engines[std::size_t(i)];
      squares[r].push_back(aligned_misfit(model, r, error).mean_square_m2);
    }
  });
  return squares;
}

const std::vector<std::vector<double>>& Model::noise_m2(bool other_engine) const {
  auto& drawn = noise_m2_[other_engine];
  if (!drawn)
    drawn =
        std::make_shared<const std::vector<std::vector<double>>>(noise_misfits_m2(*this, kNoiseDraws, other_engine));
  return *drawn;
}

}  // namespace umbsim::gap

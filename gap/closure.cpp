#include "gap/closure.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>

#include "core/random.h"
#include "gap/noise_floor.h"

namespace umbsim::gap {
namespace {

constexpr int kResamples = 1000;

std::vector<Pose2> recorded(const Recording& recording, std::size_t run) {
  std::vector<Pose2> truth;
  for (const TruthSample& t : recording.runs[run].truth) truth.push_back(t.X_WB);
  return truth;
}

// Mean square of the position error along the run, and the heading error at its end, after the best start pose.
struct TrackError {
  double mean_square_m2 = 0;
  double end_rad = 0;
};

TrackError aligned_error(const Model& model, std::size_t run, const std::vector<Pose2>& predicted) {
  const TrackFilter& filter = model.filter(run);
  Eigen::VectorXd error = track_error(predicted, recorded(model.recording(), run));
  const auto products = filter.kick_products(filter.whiten(error));
  std::vector<Eigen::Vector3d> start(filter.samples(), Eigen::Vector3d::Zero());
  start[0] = (products.with_itself[0] + 1e-9 * Eigen::Matrix3d::Identity()).ldlt().solve(products.with_column[0]);
  error -= filter.propagate(start);
  TrackError result;
  double seen = 0;
  for (std::size_t k = 0; k < filter.samples(); ++k) {
    if (!model.nominal().seen[run][k]) continue;
    result.mean_square_m2 += error.segment<2>(3 * Eigen::Index(k)).squaredNorm();
    seen += 1;
  }
  result.mean_square_m2 /= std::max(1.0, seen);
  result.end_rad = error[error.size() - 1];
  return result;
}

}  // namespace

double mean_square_error_m2(const Model& model, const std::vector<std::vector<Pose2>>& tracks) {
  double sum = 0;
  for (std::size_t r = 0; r < tracks.size(); ++r) sum += aligned_error(model, r, tracks[r]).mean_square_m2;
  return sum / double(tracks.size());
}

Closure held_out_closure(const Model& model, const Fit& fit) {
  Closure closure;
  const std::size_t runs = model.all_runs().size();
  std::map<std::string, std::vector<std::size_t>> conditions;
  for (const std::size_t r : model.all_runs()) {
    conditions[model.nominal().conditions[r] + model.recording().runs[r].direction].push_back(r);
  }
  if (fit.families.empty() || conditions.size() < 2) return closure;
  std::vector<double> before(runs);
  std::vector<double> after(runs);
  std::vector<double> floor(runs);
  double before_rad2 = 0;
  double after_rad2 = 0;
  for (const auto& [condition, held] : conditions) {
    std::vector<std::size_t> rest;
    for (const std::size_t r : model.all_runs()) {
      if (std::find(held.begin(), held.end(), r) == held.end()) rest.push_back(r);
    }
    const std::vector<Effect> effects = model.fitted_on(fit, rest);
    for (const std::size_t r : held) {
      const TrackError plain = aligned_error(model, r, model.nominal().tracks[r]);
      const TrackError with = aligned_error(model, r, model.simulate_run(r, effects));
      before[r] = plain.mean_square_m2;
      after[r] = with.mean_square_m2;
      floor[r] = noise_floor_m2(model.nominal(), model.noise(), r);
      before_rad2 += plain.end_rad * plain.end_rad / double(runs);
      after_rad2 += with.end_rad * with.end_rad / double(runs);
    }
  }
  const auto fraction = [&](const std::vector<std::size_t>& chosen) {
    double b = 0;
    double a = 0;
    double f = 0;
    for (const std::size_t r : chosen) {
      b += before[r];
      a += after[r];
      f += floor[r];
    }
    return 1 - (a - f) / std::max(b - f, 0.1 * f);
  };
  double gap_m2 = 0;
  double floor_sum_m2 = 0;
  for (const std::size_t r : model.all_runs()) {
    gap_m2 += before[r] - floor[r];
    floor_sum_m2 += floor[r];
  }
  // Within the noise there is no gap to close.
  closure.known = gap_m2 > 0.1 * floor_sum_m2;
  closure.fraction = closure.known ? fraction(model.all_runs()) : 0;
  RandomStream random(1, "closure");
  std::vector<double> resampled;
  for (int i = 0; i < kResamples; ++i) {
    std::vector<std::size_t> chosen;
    for (std::size_t j = 0; j < runs; ++j) chosen.push_back(std::size_t(random.bits() % runs));
    resampled.push_back(fraction(chosen));
  }
  std::sort(resampled.begin(), resampled.end());
  if (!closure.known) std::fill(resampled.begin(), resampled.end(), 0.0);
  closure.ci95[0] = resampled[kResamples / 40];
  closure.ci95[1] = resampled[kResamples - 1 - kResamples / 40];
  const auto rms_mm = [&](const std::vector<double>& squares) {
    double sum = 0;
    for (const double s : squares) sum += s;
    return 1000 * std::sqrt(sum / double(runs));
  };
  closure.before_mm = rms_mm(before);
  closure.after_mm = rms_mm(after);
  closure.floor_mm = rms_mm(floor);
  closure.before_deg = degrees(std::sqrt(before_rad2));
  closure.after_deg = degrees(std::sqrt(after_rad2));
  return closure;
}

}  // namespace umbsim::gap

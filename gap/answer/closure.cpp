#include "gap/answer/closure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/random.h"
#include "gap/evidence/track_misfit.h"

namespace umbsim::gap {
namespace {

constexpr int kResamples = 1000;

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / double(values.size());
}

// The largest sum over the runs that noise alone makes, but for one draw in twenty.
double most_by_noise(const std::vector<std::vector<double>>& draws) {
  std::vector<double> sums(kNoiseDraws, 0.0);
  for (const auto& run : draws) {
    for (int i = 0; i < kNoiseDraws; ++i) sums[std::size_t(i)] += run[std::size_t(i)];
  }
  std::sort(sums.begin(), sums.end());
  return sums[kNoiseDraws - 1 - kNoiseDraws / 20];
}

// With the numbers of fewer runs, or if the robot cannot be driven with these, with those of all.
std::vector<Pose2> driven(const Model& model, std::size_t run, const std::vector<Effect>& effects, const Fit& fit) {
  try {
    return model.simulate_run(run, effects);
  } catch (const std::runtime_error&) {
    return model.simulate_run(run, fit.driven_at(fit.p));
  }
}

}  // namespace

double most_hidden_mm(const Model& model, bool other_engine) {
  const double sum_m2 = most_by_noise(model.noise_m2(other_engine));
  return 1000 * std::sqrt(sum_m2 / double(model.all_runs().size()));
}

Closure held_out_closure(const Model& model, const Fit& fit) {
  Closure closure;
  const std::size_t runs = model.all_runs().size();
  std::map<std::string, std::vector<std::size_t>> conditions;
  for (const std::size_t r : model.all_runs()) {
    conditions[model.condition(r)].push_back(r);
  }
  if (fit.hypotheses.empty() || conditions.size() < 2) return closure;
  std::vector<double> before(runs);
  std::vector<double> after(runs);
  const auto& noise = model.noise_m2();
  std::vector<double> floor(runs);
  const std::size_t parts = fit.hypotheses.size();
  std::vector<TrackMisfit> without(parts);  // sums over the runs
  double before_rad2 = 0;
  double after_rad2 = 0;
  for (const auto& [condition, held] : conditions) {
    std::vector<std::size_t> rest;
    for (const std::size_t r : model.all_runs()) {
      if (std::find(held.begin(), held.end(), r) == held.end()) rest.push_back(r);
    }
    const Eigen::VectorXd numbers = model.numbers_on(fit, rest);
    for (const std::size_t r : held) {
      const TrackMisfit plain = aligned_misfit(model, r, model.nominal().tracks[r]);
      const TrackMisfit with = aligned_misfit(model, r, driven(model, r, fit.driven_at(numbers), fit));
      before[r] = plain.mean_square_m2;
      after[r] = with.mean_square_m2;
      floor[r] = mean(noise[r]);
      before_rad2 += plain.end_rad * plain.end_rad / double(runs);
      after_rad2 += with.end_rad * with.end_rad / double(runs);
      for (std::size_t i = 0; i < parts; ++i) {
        const TrackMisfit less =
            parts == 1 ? plain : aligned_misfit(model, r, driven(model, r, fit.driven_at(numbers, i), fit));
        without[i].mean_square_m2 += less.mean_square_m2 / double(runs);
        without[i].end_rad += less.end_rad * less.end_rad / double(runs);
      }
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
  double before_sum_m2 = 0;
  for (const double b : before) before_sum_m2 += b;
  // Within the noise there is no gap to close, nor one that a cause between commands and ticks could close.
  const double most_noise_m2 = most_by_noise(noise);
  closure.known = before_sum_m2 > most_noise_m2 && before != after;
  closure.most_noise_mm = 1000 * std::sqrt(most_noise_m2 / double(runs));
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
  for (const TrackMisfit& less : without) {
    closure.worth.push_back({1000 * std::sqrt(less.mean_square_m2) - closure.after_mm,
                             degrees(std::sqrt(less.end_rad)) - closure.after_deg});
  }
  return closure;
}

}  // namespace umbsim::gap

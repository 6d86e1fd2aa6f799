#include "gap/noise/noise_estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

// Whether two runs drove the same way at the same times, by their odometry.
bool alike(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  const std::size_t n = std::min(a.size(), b.size());
  if (double(std::max(a.size(), b.size()) - n) > 0.05 * double(n)) return false;
  double square = 0;
  double square_rad = 0;
  for (std::size_t k = 0; k < n; ++k) {
    square += std::pow(a[k].x_m - b[k].x_m, 2) + std::pow(a[k].y_m - b[k].y_m, 2);
    square_rad += std::pow(a[k].theta_rad - b[k].theta_rad, 2);
  }
  return std::sqrt(square / double(n)) < 0.01 && std::sqrt(square_rad / double(n)) < 0.02;
}

// A count that gets lost is made up for over several readings: what random walks leave shows whole in samples that are
// longer apart.
constexpr double kSeldom_s = 0.5;

// A contaminated normal distribution (Tukey 1960): one innovation in a hundred is of ten times the deviation. The
// likelier of the two counts, which a constant tells from their sum. A cap in place of the second would make no noise
// at all likeliest once all innovations are beyond it.
double robust_log_likelihood(const TrackFilter& filter, const Eigen::VectorXd& column) {
  constexpr double kShare = 0.01, kWider = 10;
  const Eigen::ArrayXd half_squares = filter.whiten(column).array().square() / 2;
  const double seldom = std::log((1 - kShare) * kWider / kShare);
  return -0.5 * filter.log_det() - half_squares.min(seldom + half_squares / (kWider * kWider)).sum();
}

// What remains of one run when another like it is subtracted.
struct Difference {
  Eigen::VectorXd column;
  std::vector<Pose2> path;
  std::vector<double> rolled_m;
  std::vector<bool> seen;  // of end points: which samples are; else empty
};

// How far a run has come at each sample, metres that its wheels rolled. What stands creeps on, so that no two samples
// are at one place.
std::vector<double> progress_m(const NominalReplay& n, std::size_t run) {
  constexpr double kStanding_mps = 1e-4;
  std::vector<double> way;
  double rolled_m = 0;
  for (std::size_t k = 0; k < n.truth[run].size(); ++k) {
    rolled_m += n.rolled_m[run][k];
    way.push_back(rolled_m + kStanding_mps * n.recording->runs[run].truth[k].time_s);
  }
  return way;
}

// The error of the sample nearest to a place, carried on to there at the rate at which it changes: two readings
// averaged would be less noisy than one.
Eigen::Vector3d error_at(const Eigen::VectorXd& error, const std::vector<double>& way_m, double place_m) {
  const Eigen::Index last = Eigen::Index(way_m.size()) - 1;
  const auto after = std::lower_bound(way_m.begin() + 1, way_m.end() - 1, place_m);
  Eigen::Index j = after - way_m.begin();
  const double step_m = way_m[std::size_t(j)] - way_m[std::size_t(j - 1)];
  double on = std::clamp((place_m - way_m[std::size_t(j)]) / step_m, -1.0, 0.0);
  if (on < -0.5) --j, on += 1;
  const Eigen::Index from = std::max<Eigen::Index>(0, j - 1), to = std::min(last, j + 1);
  return error.segment<3>(3 * j) + on / double(to - from) * (error.segment<3>(3 * to) - error.segment<3>(3 * from));
}

// Linear in what the robot does otherwise, however far the tracks part. `usual`: noise, of which only counts how well
// headings are seen.
Eigen::VectorXd error_of(const NominalReplay& n, std::size_t run, const NoiseModel& usual) {
  return TrackFilter(n.tracks[run], n.rolled_m[run], usual).error(n.tracks[run], n.truth[run]);
}

// Each run once as the first of a pair, in samples that are at least so long apart. Runs that repeat each other come to
// a place at different times: they are compared where they are, lest what the scenario errs by looks like noise.
std::vector<Difference> differences(const NominalReplay& n, const NoiseModel& usual, double apart_s) {
  std::vector<Difference> result;
  const bool ends = n.recording->truth_kind == "endpoints";
  for (std::size_t a = 0; a < n.runs(); ++a) {
    for (std::size_t b = a + 1; b < n.runs(); ++b) {
      if (!n.same_condition(a, b) || !alike(n.tracks[a], n.tracks[b])) continue;
      const Eigen::VectorXd first = error_of(n, a, usual), second = error_of(n, b, usual);
      const auto& times = n.recording->runs[a].truth;
      Difference d{Eigen::VectorXd(first.size()), {}, {}, {}};
      const std::vector<double> way = progress_m(n, a), other_way = progress_m(n, b);
      Eigen::Index rows = 0;
      double rolled_m = 0;
      double next_s = times.front().time_s;
      for (std::size_t k = 0; k < std::min(n.truth[a].size(), n.truth[b].size()); ++k) {
        rolled_m += n.rolled_m[a][k];
        if (times[k].time_s < next_s - 1e-6) continue;
        d.column.segment<3>(rows) =
            first.segment<3>(3 * Eigen::Index(k)) -
            (ends ? second.segment<3>(3 * Eigen::Index(k)) : error_at(second, other_way, way[k]));
        d.path.push_back(n.tracks[a][k]);
        d.rolled_m.push_back(rolled_m);
        if (ends) d.seen.push_back(n.seen[a][k] && n.seen[b][k]);
        rows += 3;
        rolled_m = 0;
        next_s = times[k].time_s + apart_s;
      }
      d.column.conservativeResize(rows);
      result.push_back(std::move(d));
      break;
    }
  }
  return result;
}

double replicate_log_likelihood(const std::vector<Difference>& differences, const NoiseModel& noise) {
  NoiseModel twice = noise;
  twice.heading_rad2_pm *= 2;
  twice.along_m2_pm *= 2;
  twice.across_m2_pm *= 2;
  twice.position_sd_m *= M_SQRT2;
  twice.heading_sd_rad *= M_SQRT2;
  double total = 0;
  for (const Difference& d : differences) {
    total += robust_log_likelihood(TrackFilter(d.path, d.rolled_m, twice, d.seen), d.column);
  }
  return total;
}

// End points are few: what is usual counts beside them. Walks are known to a factor of three, errors of a reading,
// which a recording states, to a fifth.
double log_prior(const NoiseModel& noise, const NoiseModel& usual) {
  constexpr double kWalk = 2 * 1.1, kReading = 0.2;  // standard deviations of logarithms
  double square = 0;
  for (const auto walk : {&NoiseModel::heading_rad2_pm, &NoiseModel::along_m2_pm, &NoiseModel::across_m2_pm}) {
    square += std::pow(std::log(noise.*walk / usual.*walk) / kWalk, 2);
  }
  for (const auto sd : {&NoiseModel::position_sd_m, &NoiseModel::heading_sd_rad, &NoiseModel::clock_s}) {
    square += std::pow(std::log(noise.*sd / usual.*sd) / kReading, 2);
  }
  return -0.5 * square;
}

// The likelihood's maximum over the noise model, by a coordinate search on logarithms: a handful of numbers. It looks
// far at first, for beside a good fit stands one that takes most innovations for outliers.
template <class Likelihood>
NoiseModel most_likely(NoiseModel best, const Likelihood& log_likelihood) {
  double NoiseModel::*members[] = {&NoiseModel::heading_rad2_pm, &NoiseModel::along_m2_pm,    &NoiseModel::across_m2_pm,
                                   &NoiseModel::position_sd_m,   &NoiseModel::heading_sd_rad, &NoiseModel::clock_s};
  double best_value = log_likelihood(best);
  for (double factor = 64; factor > 1.02; factor = std::sqrt(factor)) {
    for (int sweep = 0; sweep < 2; ++sweep) {
      for (const auto member : members) {
        if (member == &NoiseModel::heading_sd_rad && !best.sees_headings()) continue;
        for (const double f : {factor, 1 / factor}) {
          for (int step = 0; step < 6; ++step) {
            NoiseModel trial = best;
            trial.*member *= f;
            const double value = log_likelihood(trial);
            if (!(value > best_value)) break;  // nor where it is not a number
            best = trial;
            best_value = value;
          }
        }
      }
    }
  }
  return best;
}

constexpr int kLeft = 7;  // radii, wheelbase, tracker's frame, clock

Eigen::MatrixXd geometry_columns(const NominalReplay& n, std::size_t run, const TrackFilter& filter) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * Eigen::Index(filter.samples()), kLeft);
  for (int wheel = 0; wheel < 2; ++wheel) columns.col(wheel) = filter.propagate(radius_impulses(n, run, wheel));
  Impulses3 turned;
  for (const auto& way : n.wheels_m[run]) turned.emplace_back(0, 0, (way[1] - way[0]) / n.recording->robot.wheelbase_m);
  columns.col(2) = filter.propagate(turned);
  for (std::size_t k = 0; k < filter.samples(); ++k) {
    columns.block<3, 3>(3 * Eigen::Index(k), 3).setIdentity();
    columns.block<3, 1>(3 * Eigen::Index(k), 6) = n.velocity[run][k];
  }
  return columns;
}

// Fitting and estimating in turn.
NoiseModel from_what_is_left(const NominalReplay& n, NoiseModel noise) {
  const auto filter_of = [&](std::size_t r, const NoiseModel& model) {
    return TrackFilter(n.tracks[r], n.rolled_m[r], model, n.seen[r], n.velocity[r]);
  };
  for (int round = 0; round < 3; ++round) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(kLeft, kLeft) * 1e-6;
    Eigen::VectorXd c = Eigen::VectorXd::Zero(kLeft);
    std::vector<Eigen::VectorXd> error(n.runs());
    std::vector<Eigen::MatrixXd> columns(n.runs());
    for (std::size_t r = 0; r < n.runs(); ++r) {
      const TrackFilter filter = filter_of(r, noise);
      error[r] = filter.error(n.tracks[r], n.truth[r]);
      columns[r] = geometry_columns(n, r, filter);
      const Eigen::MatrixXd white = filter.whiten(columns[r]);
      A += white.transpose() * white;
      c += white.transpose() * filter.whiten(error[r]);
    }
    const Eigen::VectorXd x = A.ldlt().solve(c);
    noise = most_likely(noise, [&](const NoiseModel& model) {
      double total = 0;
      for (std::size_t r = 0; r < n.runs(); ++r) {
        total += robust_log_likelihood(filter_of(r, model), error[r] - columns[r] * x);
      }
      return total;
    });
  }
  return noise;
}

// Runs of one condition and direction, on the mean.
double repeats(const NominalReplay& n) {
  double conditions = 0;
  for (std::size_t r = 0; r < n.runs(); ++r) {
    bool first = true;
    for (std::size_t before = 0; before < r; ++before) first = first && !n.same_condition(before, r);
    conditions += first;
  }
  return double(n.runs()) / conditions;
}

// With what no recording shows. Of a single reading's error repeats share what they do not scatter by: so many of them
// say no more of it than one.
NoiseModel no_less_than(const NoiseModel& least, NoiseModel noise, double repeats) {
  for (const auto walk : {&NoiseModel::heading_rad2_pm, &NoiseModel::along_m2_pm, &NoiseModel::across_m2_pm}) {
    noise.*walk = std::max(noise.*walk, least.*walk);
  }
  for (const auto sd : {&NoiseModel::position_sd_m, &NoiseModel::heading_sd_rad, &NoiseModel::clock_s}) {
    const double shared = std::pow(least.*sd, 2) - std::pow(noise.*sd, 2);
    if (shared > 0) noise.*sd = std::sqrt(std::pow(noise.*sd, 2) + repeats * shared);
  }
  return noise;
}

}  // namespace

NoiseEstimate estimate_noise(const NominalReplay& nominal, const NoiseModel& least) {
  const Recording& recording = *nominal.recording;
  const double tick_m = 2 * M_PI * recording.robot.wheel_radius_m / recording.robot.ticks_per_revolution;
  const double rounding_m = tick_m / std::sqrt(12.0);
  const double position = recording.truth_position_sd_m > 0 ? recording.truth_position_sd_m : 1e-4;
  const double heading = recording.truth_heading_sd_rad > 0 ? recording.truth_heading_sd_rad : 1e-4;
  NoiseModel start;
  start.position_sd_m = std::hypot(position, rounding_m / M_SQRT2);
  start.heading_sd_rad = std::hypot(heading, rounding_m * M_SQRT2 / recording.robot.wheelbase_m);
  const std::vector<Difference> repeated = differences(nominal, start, 0);
  const auto log_likelihood = [&](const NoiseModel& noise) { return replicate_log_likelihood(repeated, noise); };
  if (recording.truth_kind == "endpoints") {
    const auto posterior = [&](const NoiseModel& noise) { return log_likelihood(noise) + log_prior(noise, start); };
    return {most_likely(start, posterior), false, {}};
  }
  if (!repeated.empty()) {
    const auto of_walks = [seldom = differences(nominal, start, kSeldom_s)](const NoiseModel& noise) {
      return replicate_log_likelihood(seldom, noise);
    };
    return {no_less_than(least, most_likely(start, log_likelihood), repeats(nominal)), true, of_walks};
  }
  return {no_less_than(least, from_what_is_left(nominal, start), 1), false, {}};
}

}  // namespace umbsim::gap

#include "gap/model.h"

#include "gap/closure.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

namespace umbsim::gap {
namespace {

constexpr int kFeatureRows = 8;  // three of a run, and five of the recording, which stand with the first run
constexpr int kLocal = 2;
constexpr double kDensest_hz = 12;  // of a truth that is used whole
constexpr double kThinned_hz = 2;   // of one that is thinned

bool acts_on_counts(const std::vector<Effect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [](const Effect& e) {
    return e.info->stage == Stage::drivetrain || e.info->stage == Stage::encoder ||
           e.info->name == "over_acceleration" || e.info->name == "fast_turning";
  });
}

Eigen::VectorXd joined(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd c(a.size() + b.size());
  c << a, b;
  return c;
}

// Wheel travel (left, right), metres, between the moments of one truth sample and the next.
std::vector<std::array<double, 2>> travel(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
  const auto& s = run.encoders;
  std::vector<std::array<double, 2>> at;
  std::size_t i = 0;
  for (const TruthSample& t : run.truth) {
    while (i + 2 < s.size() && s[i + 1].time_s < t.time_s) ++i;
    const double part = std::clamp((t.time_s - s[i].time_s) / (s[i + 1].time_s - s[i].time_s), 0.0, 1.0);
    const auto mix = [&](std::int64_t a, std::int64_t b) { return k * (double(a) + part * double(b - a)); };
    at.push_back({mix(s[i].left_ticks, s[i + 1].left_ticks), mix(s[i].right_ticks, s[i + 1].right_ticks)});
  }
  for (std::size_t j = at.size() - 1; j > 0; --j) {
    at[j][0] -= at[j - 1][0];
    at[j][1] -= at[j - 1][1];
  }
  at[0] = {0, 0};
  return at;
}

}  // namespace

std::vector<Effect> Fit::effects() const {
  std::vector<Effect> all;
  Eigen::Index at = 0;
  for (const Family& f : families) {
    const Eigen::Index n = Eigen::Index(f.parameters.size());
    for (Effect& e : effects_of(f, p.segment(at, n))) all.push_back(std::move(e));
    at += n;
  }
  return all;
}

std::string Fit::name() const {
  std::set<std::string> names;
  for (const Family& f : families) names.insert(f.effect);
  if (names.empty()) return "none";
  return fmt::format("{}", fmt::join(names, "+"));
}

Model::Model(const Recording& recording, Simulator simulator, const Scatter& scatter,
             const std::optional<NoiseModel>& known)
    : recording_(recording), simulator_(std::move(simulator)), scatter_(scatter) {
  for (const RecordedRun& run : recording.runs) {
    stretches_.push_back(umbsim::stretches(run, recording.robot));
    std::vector<Pose2> truth;
    for (const TruthSample& t : run.truth) truth.push_back(t.X_WB);
    const double rate_hz = double(truth.size() - 1) / (run.truth.back().time_s - run.truth.front().time_s);
    thinning_.push_back(rate_hz > kDensest_hz ? std::size_t(std::ceil(rate_hz / kThinned_hz)) : 1);
    truth_.push_back(std::move(truth));
    std::vector<double> rolled;
    for (const auto& d : travel(run, recording.robot)) rolled.push_back((std::abs(d[0]) + std::abs(d[1])) / 2);
    rolled_.push_back(std::move(rolled));
  }
  find_conditions();
  nominal_ = simulate({{}}).front();
  measured_.resize(recording.runs.size());
  nominal_features_.resize(recording.runs.size());
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    if (!recording.runs[r].has_commands) continue;
    std::vector<std::array<double, 2>> counts;
    const double k = 2 * M_PI / recording.robot.ticks_per_revolution;
    for (const EncoderSample& s : recording.runs[r].encoders) {
      counts.push_back({k * double(s.left_ticks), k * double(s.right_ticks)});
    }
    measured_[r] = features(r, counts);
    nominal_features_[r] = predicted_features(r, {});
  }
  habits_ = measured_habits(recording, stretches_);
  nominal_habits_ = predicted_habits({});
  if (known) noise_ = *known;
  else estimate_noise();
  make_filters();
  make_nuisances();
}

void Model::find_conditions() {
  for (const RecordedRun& run : recording_.runs) {
    const RecordedPath& p = recording_.path;
    conditions_.push_back(fmt::format("{} {} {} {}", run.linear_speed_mps.value_or(p.linear_speed_mps.value_or(0)),
                                      run.payload_kg.value_or(0), run.turn.value_or(p.turn),
                                      run.start_heading_rad.value_or(0)));
  }
}

std::vector<std::vector<std::vector<Pose2>>> Model::simulate(const std::vector<std::vector<Effect>>& sets) const {
  const std::size_t runs = recording_.runs.size();
  std::vector<std::vector<std::vector<Pose2>>> tracks(sets.size(), std::vector<std::vector<Pose2>>(runs));
  tbb::parallel_for(std::size_t(0), sets.size() * runs, [&](std::size_t i) {
    tracks[i / runs][i % runs] = simulator_.ticks(i % runs, sets[i / runs]);
  });
  for (const RecordedRun& run : recording_.runs) simulated_s_ += double(sets.size()) * run.encoders.back().time_s;
  return tracks;
}

// Gains from the total rotation; the lag from how far counts are behind wherever the speed changes.
CommandFeatures Model::features(std::size_t r, const std::vector<std::array<double, 2>>& counts) const {
  const auto& s = recording_.runs[r].encoders;
  CommandFeatures f;
  f.known = true;
  double sums[2][2] = {};  // |commanded|, counted with the command's sign
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double dt = s[i].time_s - s[i - 1].time_s;
    const double command[] = {s[i].left_command_radps, s[i].right_command_radps};
    for (int w = 0; w < 2; ++w) {
      sums[w][0] += std::abs(command[w]) * dt;
      const double sign = command[w] > 0 ? 1 : command[w] < 0 ? -1 : 0;
      sums[w][1] += sign * (counts[i][std::size_t(w)] - counts[i - 1][std::size_t(w)]);
    }
  }
  f.left_gain = sums[0][0] > 0 ? sums[0][1] / sums[0][0] - 1 : 0;
  f.right_gain = sums[1][0] > 0 ? sums[1][1] / sums[1][0] - 1 : 0;
  // Least squares of (commanded - counted angle) on (speed, angle, way, 1), each wheel; the speed's coefficient is the lag.
  double lag = 0;
  for (int w = 0; w < 2; ++w) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    double commanded = 0;
    double rolled = 0;
    for (std::size_t i = 1; i < s.size(); ++i) {
      const double dt = s[i].time_s - s[i - 1].time_s;
      const double speed = w == 0 ? s[i].left_command_radps : s[i].right_command_radps;
      commanded += speed * dt;
      rolled += std::abs(speed) * dt;
      const Eigen::Vector4d x(speed, commanded, rolled, 1);
      A += x * x.transpose();
      b += x * (commanded - (counts[i][std::size_t(w)] - counts[0][std::size_t(w)]));
    }
    lag += 0.5 * A.ldlt().solve(b)[0];
  }
  f.lag_s = lag;
  return f;
}

CommandFeatures Model::predicted_features(std::size_t run, const std::vector<Effect>& effects) const {
  if (!recording_.runs[run].has_commands || !simulator_.commands) return {};
  return features(run, simulator_.commands(run, effects));
}

Habits Model::predicted_habits(const std::vector<Effect>& effects) const {
  return simulator_.habits ? simulator_.habits(effects) : Habits{};
}

Eigen::VectorXd Model::feature_rows(std::size_t run, const CommandFeatures& a, const CommandFeatures& b, const Habits& ha,
                                    const Habits& hb) const {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(kFeatureRows);
  if (run == 0) {
    for (std::size_t i = 0; i < ha.size(); ++i) rows[3 + Eigen::Index(i)] = (ha[i] - hb[i]) / kHabitsSd[i];
  }
  if (!measured_[run].known || !a.known || !b.known) return rows;
  rows.head<3>() << (a.left_gain - b.left_gain) / scatter_.gain, (a.right_gain - b.right_gain) / scatter_.gain,
      (a.lag_s - b.lag_s) / scatter_.lag_s;
  return rows;
}

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

// Robust log likelihood of differences of replicates under a noise model: large innovations count as 4 sigma.
double replicate_log_likelihood(const std::vector<Eigen::VectorXd>& differences,
                                const std::vector<std::vector<Pose2>>& paths,
                                const std::vector<std::vector<double>>& rolled, const NoiseModel& noise) {
  NoiseModel twice = noise;
  twice.heading_rad2_pm *= 2;
  twice.along_m2_pm *= 2;
  twice.across_m2_pm *= 2;
  twice.position_sd_m *= M_SQRT2;
  twice.heading_sd_rad *= M_SQRT2;
  double total = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const TrackFilter filter(paths[i], rolled[i], twice);
    const Eigen::VectorXd white = filter.whiten(differences[i]);
    total -= 0.5 * filter.log_det();
    for (Eigen::Index k = 0; k < white.size(); ++k) total -= 0.5 * std::min(white[k] * white[k], 16.0);
  }
  return total;
}

}  // namespace

std::vector<bool> Model::seen(std::size_t run) const {
  std::vector<bool> seen;
  for (std::size_t k = 0; k < truth_[run].size(); ++k) seen.push_back(observed(run, k));
  return seen;
}

std::vector<Eigen::Vector3d> Model::velocity(std::size_t run) const {
  const auto& truth = recording_.runs[run].truth;
  const std::vector<Pose2>& path = nominal_[run];
  std::vector<Eigen::Vector3d> result;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const std::size_t a = k > 0 ? k - 1 : 0;
    const std::size_t b = std::min(path.size() - 1, k + 1);
    const Pose2 u = inverse(path[a]) * path[b];
    const double dt = std::max(1e-6, truth[b].time_s - truth[a].time_s);
    result.emplace_back(u.x_m / dt, u.y_m / dt, u.theta_rad / dt);
  }
  return result;
}

namespace {

// The likelihood's maximum over the noise model, by a coordinate search on logarithms: a handful of numbers.
template <class Likelihood>
NoiseModel most_likely(NoiseModel best, const Likelihood& log_likelihood) {
  double NoiseModel::*members[] = {&NoiseModel::heading_rad2_pm, &NoiseModel::along_m2_pm, &NoiseModel::across_m2_pm,
                                   &NoiseModel::position_sd_m, &NoiseModel::heading_sd_rad,
                                   &NoiseModel::clock_s};
  double best_value = log_likelihood(best);
  for (double factor = 4; factor > 1.1; factor = std::sqrt(factor)) {
    for (int sweep = 0; sweep < 2; ++sweep) {
      for (const auto member : members) {
        for (const double f : {factor, 1 / factor}) {
          for (int step = 0; step < 6; ++step) {
            NoiseModel trial = best;
            trial.*member *= f;
            const double value = log_likelihood(trial);
            if (value <= best_value) break;
            best = trial;
            best_value = value;
          }
        }
      }
    }
  }
  best.heading_rad2_pm = std::max(best.heading_rad2_pm, 1e-9);
  best.along_m2_pm = std::max(best.along_m2_pm, 1e-10);
  best.across_m2_pm = std::max(best.across_m2_pm, 1e-10);
  return best;
}

}  // namespace

// Without runs that can be subtracted: what the geometry (radii, wheelbase), the tracker's frame and the clock leave of
// each run is taken for noise, by fitting and estimating in turn.
void Model::noise_from_what_is_left() {
  const std::size_t runs = truth_.size();
  const double b = recording_.robot.wheelbase_m;
  for (int round = 0; round < 3; ++round) {
    constexpr int kColumns = 7;
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(kColumns, kColumns) * 1e-6;
    Eigen::VectorXd c = Eigen::VectorXd::Zero(kColumns);
    std::vector<Eigen::VectorXd> error(runs);
    std::vector<Eigen::MatrixXd> columns(runs);
    for (std::size_t r = 0; r < runs; ++r) {
      const TrackFilter filter(nominal_[r], rolled_[r], noise_, seen(r), velocity(r));
      const std::size_t n = filter.samples();
      error[r] = track_error(nominal_[r], truth_[r]);
      const auto wheels = travel(recording_.runs[r], recording_.robot);
      std::vector<std::vector<Eigen::Vector3d>> kicks(3, std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero()));
      columns[r] = Eigen::MatrixXd::Zero(3 * Eigen::Index(n), kColumns);
      for (std::size_t k = 1; k < n; ++k) {
        kicks[0][k] = {wheels[k][0] / 2, 0, -wheels[k][0] / b};
        kicks[1][k] = {wheels[k][1] / 2, 0, wheels[k][1] / b};
        kicks[2][k] = {0, 0, (wheels[k][1] - wheels[k][0]) / b};
        const Eigen::Index row = 3 * Eigen::Index(k);
        const double dt = std::max(1e-6, recording_.runs[r].truth[k].time_s - recording_.runs[r].truth[k - 1].time_s);
        const Pose2 u = inverse(nominal_[r][k - 1]) * nominal_[r][k];
        columns[r](row, 3) = 1;
        columns[r](row + 1, 4) = 1;
        columns[r](row + 2, 5) = 1;
        columns[r].block<3, 1>(row, 6) << u.x_m / dt, u.y_m / dt, u.theta_rad / dt;
      }
      columns[r](0, 3) = columns[r](1, 4) = columns[r](2, 5) = 1;
      for (int i = 0; i < 3; ++i) columns[r].col(i) = filter.propagate(kicks[std::size_t(i)]);
      const Eigen::MatrixXd white = filter.whiten(columns[r]);
      A += white.transpose() * white;
      c += white.transpose() * filter.whiten(error[r]);
    }
    const Eigen::VectorXd x = A.ldlt().solve(c);
    noise_ = most_likely(noise_, [&](const NoiseModel& noise) {
      double total = 0;
      for (std::size_t r = 0; r < runs; ++r) {
        const TrackFilter filter(nominal_[r], rolled_[r], noise, seen(r), velocity(r));
        const Eigen::VectorXd white = filter.whiten(error[r] - columns[r] * x);
        total -= 0.5 * filter.log_det();
        for (Eigen::Index k = 0; k < white.size(); ++k) total -= 0.5 * std::min(white[k] * white[k], 16.0);
      }
      return total;
    });
  }
}

void Model::estimate_noise() {
  const double tick_m = 2 * M_PI * recording_.robot.wheel_radius_m / recording_.robot.ticks_per_revolution;
  const double rounding_m = tick_m / std::sqrt(12.0);
  const double position = recording_.truth_position_sd_m > 0 ? recording_.truth_position_sd_m : 1e-4;
  const double heading = recording_.truth_heading_sd_rad > 0 ? recording_.truth_heading_sd_rad : 1e-4;
  noise_.position_sd_m = std::hypot(position, rounding_m / M_SQRT2);
  noise_.heading_sd_rad = std::hypot(heading, rounding_m * M_SQRT2 / recording_.robot.wheelbase_m);
  std::vector<Eigen::VectorXd> differences;
  std::vector<std::vector<Pose2>> paths;
  std::vector<std::vector<double>> rolled;
  for (std::size_t a = 0; a < recording_.runs.size(); ++a) {
    for (std::size_t b = a + 1; b < recording_.runs.size(); ++b) {
      if (conditions_[a] != conditions_[b] || recording_.runs[a].direction != recording_.runs[b].direction) continue;
      if (recording_.path.shape != "square") continue;
      // The same plan in time, or they cannot be subtracted.
      const std::size_t n = std::min(truth_[a].size(), truth_[b].size());
      if (!alike(nominal_[a], nominal_[b]) || recording_.truth_kind == "endpoints") continue;
      Eigen::VectorXd ya = track_error(nominal_[a], truth_[a]);
      const Eigen::VectorXd yb = track_error(nominal_[b], truth_[b]);
      differences.push_back(ya.head(3 * Eigen::Index(n)) - yb.head(3 * Eigen::Index(n)));
      paths.emplace_back(nominal_[a].begin(), nominal_[a].begin() + std::ptrdiff_t(n));
      rolled.emplace_back(rolled_[a].begin(), rolled_[a].begin() + std::ptrdiff_t(n));
      break;  // each run once as the first of a pair
    }
  }
  replicated_ = !differences.empty();
  if (!replicated_) {
    if (recording_.truth_kind == "track") noise_from_what_is_left();
    return;
  }
  noise_ = most_likely(noise_, [&](const NoiseModel& noise) {
    return replicate_log_likelihood(differences, paths, rolled, noise);
  });
}

void Model::make_filters() {
  filters_.clear();
  for (std::size_t r = 0; r < recording_.runs.size(); ++r) filters_.emplace_back(nominal_[r], rolled_[r], noise_, seen(r), velocity(r));
}

// Shared: marker offset (2), clock, and for every pair of speed, payload and kind of turn the scatter between engines.
void Model::make_nuisances() {
  std::vector<std::string> groups;
  std::vector<std::size_t> group_of;
  for (std::size_t r = 0; r < recording_.runs.size(); ++r) {
    const RecordedRun& run = recording_.runs[r];
    const std::string key = fmt::format("{} {} {}", run.linear_speed_mps.value_or(0), run.payload_kg.value_or(0),
                                        run.turn.value_or(recording_.path.turn));
    const auto found = std::find(groups.begin(), groups.end(), key);
    group_of.push_back(std::size_t(found - groups.begin()));
    if (found == groups.end()) groups.push_back(key);
  }
  constexpr int kShared = 6;
  constexpr int kPerGroup = 5;
  nuisances_ = kShared + kPerGroup * int(groups.size());
  nuisance_sd_.resize(nuisances_);
  nuisance_sd_.head(kShared) << scatter_.marker_m, scatter_.marker_m, scatter_.clock_s, scatter_.creep_across, 1,
      frame_is_free() ? scatter_.frame_rad : 0;
  // No two engines, and no real tyre, grip sideways alike: the creep of the tyres is a nuisance up to its usual size.
  Effect creep = neutral_effect(find_effect("tyre_creep"));
  constexpr double kCreep = 0.01;
  creep.values.numbers = {0, kCreep};
  const auto crept = simulate({{creep}}).front();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const bool arcs = groups[g].size() >= 3 && groups[g].substr(groups[g].size() - 3) == "arc";
    nuisance_sd_.segment(kShared + kPerGroup * Eigen::Index(g), kPerGroup)
        << (arcs ? scatter_.arc_leg_scale : scatter_.leg_scale), scatter_.turn_scale,
        scatter_.arc_scale, scatter_.heading_rad_pm, scatter_.lateral;
  }
  const auto slipped = little_slip();
  local_sd_ = Eigen::VectorXd::Constant(kLocal, scatter_.radius);
  nuisance_columns_.resize(recording_.runs.size());
  local_columns_.resize(recording_.runs.size());
  for (std::size_t r = 0; r < recording_.runs.size(); ++r) {
    const std::size_t n = filters_[r].samples();
    Eigen::MatrixXd raw = Eigen::MatrixXd::Zero(3 * Eigen::Index(n), nuisances_);
    Eigen::MatrixXd local(3 * Eigen::Index(n), kLocal);
    const auto& truth = recording_.runs[r].truth;
    for (std::size_t k = 0; k < n; ++k) {
      const Eigen::Index row = 3 * Eigen::Index(k);
      raw(row, 0) = 1;
      raw(row + 1, 1) = 1;
      raw(row + 2, 5) = 1;
      const std::size_t a = k > 0 ? k - 1 : 0;
      const std::size_t b = std::min(n - 1, k + 1);
      const double dt = std::max(1e-6, truth[b].time_s - truth[a].time_s);
      const Pose2 u = inverse(nominal_[r][a]) * nominal_[r][b];
      raw.block<3, 1>(row, 2) << u.x_m / dt, u.y_m / dt, u.theta_rad / dt;
    }
    raw.col(3) = track_error(nominal_[r], crept[r]) / kCreep;
    if (!slipped.empty()) raw.col(4) = track_error(nominal_[r], slipped[r]);
    const double b = recording_.robot.wheelbase_m;
    const auto wheels = travel(recording_.runs[r], recording_.robot);
    std::vector<std::vector<Eigen::Vector3d>> kicks(kPerGroup + kLocal,
                                                    std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero()));
    for (std::size_t k = 1; k < n; ++k) {
      const double ds = (wheels[k][0] + wheels[k][1]) / 2;
      const double turn = (wheels[k][1] - wheels[k][0]) / b;
      kicks[0][k][0] = ds;
      const bool arc = std::abs(ds) > 0.3 * b / 2 * std::abs(turn);
      kicks[arc ? 2 : 1][k][2] = turn;
      kicks[3][k][2] = std::abs(ds);
      kicks[4][k][1] = ds;
      kicks[kPerGroup][k] = {wheels[k][0] / 2, 0, -wheels[k][0] / b};
      kicks[kPerGroup + 1][k] = {wheels[k][1] / 2, 0, wheels[k][1] / b};
    }
    const Eigen::Index first = kShared + kPerGroup * Eigen::Index(group_of[r]);
    for (int i = 0; i < kPerGroup; ++i) raw.col(first + i) = filters_[r].propagate(kicks[std::size_t(i)]);
    for (int i = 0; i < kLocal; ++i) local.col(i) = filters_[r].propagate(kicks[std::size_t(kPerGroup + i)]);
    nuisance_columns_[r] = Eigen::MatrixXd::Zero(3 * Eigen::Index(n) + kFeatureRows, nuisances_);
    nuisance_columns_[r].topRows(3 * Eigen::Index(n)) = filters_[r].whiten(raw);
    local_columns_[r] = Eigen::MatrixXd::Zero(3 * Eigen::Index(n) + kFeatureRows, kLocal);
    local_columns_[r].topRows(3 * Eigen::Index(n)) = filters_[r].whiten(local);
  }
}

// A real robot's tracker is mounted by hand: its frame is free unless heading and position are known as well as a
// simulated one's.
bool Model::frame_is_free() const { return recording_.truth_heading_sd_rad > 0.001; }

// Tracks with the floor just so slippery that the robot moves by a share of the noise floor: engines, and tyres, differ
// in when exactly they let go under a jolt. Empty if no floor is that slippery.
std::vector<std::vector<Pose2>> Model::little_slip() const {
  const double wanted_m = scatter_.slip_share * noise_floor_m(*this);
  Effect slippery = neutral_effect(find_effect("slippery_floor"));
  double grips = 0.8;
  double slips = 0.02;
  std::vector<std::vector<Pose2>> tracks;
  for (int i = 0; i < 7; ++i) {
    const double friction = std::sqrt(grips * slips);
    slippery.values.numbers = {friction};
    auto trial = simulate({{slippery}}).front();
    if (displacement_m(trial, nominal_) > wanted_m) {
      slips = friction;
      tracks = std::move(trial);
    } else {
      grips = friction;
    }
  }
  return tracks;
}

std::vector<Eigen::VectorXd> Model::residuals(const std::vector<std::vector<Pose2>>& tracks,
                                              const std::vector<Effect>& effects) const {
  std::vector<Eigen::VectorXd> result(recording_.runs.size());
  const bool counts = acts_on_counts(effects);
  tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t r) {
    const Eigen::VectorXd white = filters_[r].whiten(track_error(tracks[r], truth_[r]));
    result[r].resize(white.size() + kFeatureRows);
    result[r] << white, feature_rows(r, measured_[r], counts ? predicted_features(r, effects) : nominal_features_[r], habits_,
        counts ? predicted_habits(effects) : nominal_habits_);
  });
  return result;
}

std::vector<Eigen::MatrixXd> Model::columns(const std::vector<Effect>& at,
                                            const std::vector<std::vector<Effect>>& stepped,
                                            const std::vector<double>& steps) const {
  std::vector<std::vector<Effect>> sets = stepped;
  sets.insert(sets.begin(), at);
  const auto tracks = simulate(sets);
  std::vector<Eigen::MatrixXd> result(recording_.runs.size());
  tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t r) {
    const Eigen::Index n = 3 * Eigen::Index(filters_[r].samples());
    Eigen::MatrixXd raw(n, Eigen::Index(stepped.size()));
    result[r] = Eigen::MatrixXd::Zero(n + kFeatureRows, raw.cols());
    for (std::size_t j = 0; j < stepped.size(); ++j) {
      const Eigen::Index c = Eigen::Index(j);
      raw.col(c) = track_error(tracks[0][r], tracks[j + 1][r]) / steps[j];
      if (acts_on_counts(stepped[j])) {
        const CommandFeatures before = acts_on_counts(at) ? predicted_features(r, at) : nominal_features_[r];
        result[r].col(c).tail(kFeatureRows) = feature_rows(r, predicted_features(r, stepped[j]), before, predicted_habits(stepped[j]), predicted_habits(at)) / steps[j];
      }
    }
    result[r].topRows(n) = filters_[r].whiten(raw);
  });
  return result;
}

std::vector<RunGram> Model::grams(const std::vector<Eigen::VectorXd>& residual,
                                  const std::vector<Eigen::MatrixXd>& columns,
                                  const std::vector<LocalColumns>& local) const {
  std::vector<RunGram> result(recording_.runs.size());
  tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t r) {
    const Eigen::Index effects = columns.empty() ? 0 : columns[r].cols();
    const Eigen::Index more = local.empty() ? 0 : local[r].columns.cols();
    const Eigen::Index kept = 1 + nuisances_ + effects;
    Eigen::MatrixXd all(residual[r].size(), kept + kLocal + more);
    all.col(0) = residual[r];
    all.middleCols(1, nuisances_) = nuisance_columns_[r];
    if (effects > 0) all.middleCols(1 + nuisances_, effects) = columns[r];
    all.middleCols(kept, kLocal) = local_columns_[r];
    Eigen::VectorXd sd = local_sd_;
    if (more > 0) {
      all.rightCols(more) = local[r].columns;
      sd = joined(sd, local[r].prior_sd);
    }
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(all.cols(), all.cols());
    products.selfadjointView<Eigen::Lower>().rankUpdate(all.transpose());
    products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
    result[r] = integrated_out(products, int(kept), sd);
  });
  return result;
}

std::vector<Eigen::VectorXd> Model::left_over(const Fit& fit) const {
  std::vector<Eigen::VectorXd> left = residuals(fit.tracks, fit.effects());
  for (std::size_t r = 0; r < left.size(); ++r) left[r] -= nuisance_columns_[r] * fit.nuisance;
  return left;
}

double Model::rows() const {
  double rows = 0;
  for (const TrackFilter& f : filters_) rows += 3 * double(f.samples());
  return rows;
}

std::vector<std::size_t> Model::all_runs() const {
  std::vector<std::size_t> runs(recording_.runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) runs[r] = r;
  return runs;
}

namespace {

std::vector<int> first_columns(Eigen::Index n) {
  std::vector<int> columns;
  for (int i = 1; i <= n; ++i) columns.push_back(i);
  return columns;
}

Eigen::VectorXd prior_sd(const std::vector<Family>& families) {
  std::vector<double> sd;
  for (const Family& f : families) {
    for (const FreeParameter& p : f.parameters) sd.push_back(p.prior_sd);
  }
  return Eigen::Map<Eigen::VectorXd>(sd.data(), Eigen::Index(sd.size()));
}

}  // namespace

namespace {

// log of the standard normal's distribution function, also far below zero.
double log_normal_cdf(double x) {
  if (x > -6) return std::log(0.5 * std::erfc(-x / M_SQRT2));
  return -0.5 * x * x - std::log(-x * std::sqrt(2 * M_PI));
}

}  // namespace

double Model::log_evidence(const Fit& fit, const std::vector<std::size_t>& runs) const {
  const Eigen::VectorXd sd = joined(nuisance_sd_, prior_sd(fit.families));
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(sd.size());
  shift.tail(fit.p.size()) = fit.p;
  const Evidence e = evidence(fit.grams, runs, first_columns(sd.size()), sd, shift);
  double searched = 0;
  for (const Family& f : fit.families) searched += f.search_cost;
  double log_density = e.log_density - searched;
  if (!fit.linear) {
    // The simulator bends: the density where the descent ended, and the width that the derivatives give there.
    log_density = evidence(fit.grams, runs, first_columns(nuisances_), nuisance_sd_).log_density - searched;
    const Eigen::VectorXd s = sd.tail(fit.p.size());
    const Eigen::MatrixXd width = e.covariance.bottomRightCorner(s.size(), s.size());
    log_density += 0.5 * std::log(std::max(1e-300, width.determinant())) - s.array().log().sum();
    log_density -= 0.5 * fit.p.cwiseQuotient(s).squaredNorm();
    return log_density;
  }
  // A number that cannot be negative has half a normal for its prior.
  Eigen::Index i = nuisances_;
  for (const Family& f : fit.families) {
    for (const FreeParameter& p : f.parameters) {
      if (p.min >= 0) log_density += log_normal_cdf(e.mean[i] / std::sqrt(e.covariance(i, i))) + std::log(2.0);
      ++i;
    }
  }
  return log_density;
}

std::vector<Effect> Model::fitted_on(const Fit& fit, const std::vector<std::size_t>& runs) const {
  const Eigen::VectorXd sd = joined(nuisance_sd_, prior_sd(fit.families));
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(sd.size());
  shift.tail(fit.p.size()) = fit.p;
  Fit other = fit;
  const Evidence e = evidence(fit.grams, runs, first_columns(sd.size()), sd, shift);
  other.p = e.mean.tail(fit.p.size());
  Eigen::Index i = 0;
  for (const Family& f : fit.families) {
    for (const FreeParameter& p : f.parameters) {
      // What happened in one run alone no other run can tell: the number stays as it is.
      const double sd_left = std::sqrt(e.covariance(nuisances_ + i, nuisances_ + i));
      if (!(sd_left < 0.8 * p.prior_sd)) other.p[i] = fit.p[i];
      other.p[i] = std::clamp(other.p[i], p.min, p.max);
      ++i;
    }
  }
  return other.effects();
}

void Model::score(Fit& fit) const {
  const std::vector<std::size_t> all = all_runs();
  fit.log_evidence = log_evidence(fit, all);
  fit.held_out = 0;
  std::set<std::string> conditions;
  for (std::size_t r : all) conditions.insert(conditions_[r] + recording_.runs[r].direction);
  for (const std::string& c : conditions) {
    std::vector<std::size_t> rest;
    for (std::size_t r : all) {
      if (conditions_[r] + recording_.runs[r].direction != c) rest.push_back(r);
    }
    if (!rest.empty()) fit.held_out += fit.log_evidence - log_evidence(fit, rest);
  }
}

Fit Model::none() const {
  Fit fit;
  fit.p.resize(0);
  fit.covariance.resize(0, 0);
  fit.tracks = nominal_;
  fit.grams = grams(residuals(nominal_, {}), {});
  const Evidence e = evidence(fit.grams, all_runs(), first_columns(nuisances_), nuisance_sd_);
  fit.residual = e.residual;
  fit.nuisance = e.mean;
  score(fit);
  return fit;
}

double Model::density_at(const std::vector<Family>& families, const Eigen::VectorXd& p) const {
  Fit fit;
  fit.families = families;
  fit.p = p;
  const std::vector<Effect> effects = fit.effects();
  const auto tracks = simulate({effects}).front();
  return evidence(grams(residuals(tracks, effects), {}), all_runs(), first_columns(nuisances_), nuisance_sd_).log_density;
}

Fit Model::fit(const std::vector<Family>& families, const Eigen::VectorXd& start, int rounds) const {
  Fit fit;
  fit.families = families;
  std::vector<FreeParameter> free;
  for (const Family& f : families) free.insert(free.end(), f.parameters.begin(), f.parameters.end());
  const Eigen::Index m = Eigen::Index(free.size());
  fit.p.resize(m);
  for (Eigen::Index i = 0; i < m; ++i) fit.p[i] = start.size() == m ? start[i] : free[std::size_t(i)].start;
  const Eigen::VectorXd sd = joined(nuisance_sd_, prior_sd(families));
  Fit best;
  double best_density = -1e300;
  // Places and moments bend the simulator most.
  if (std::any_of(families.begin(), families.end(), [](const Family& f) { return f.search_cost > 0; })) rounds *= 2;
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::vector<Effect>> sets{fit.effects()};
    std::vector<double> steps;
    for (Eigen::Index i = 0; i < m; ++i) {
      Fit stepped = fit;
      double step = free[std::size_t(i)].step;
      if (fit.p[i] + step > free[std::size_t(i)].max) step = -step;
      stepped.p[i] += step;
      steps.push_back(step);
      sets.push_back(stepped.effects());
    }
    const auto tracks = simulate(sets);
    fit.tracks = tracks.front();
    const std::vector<Eigen::VectorXd> residual = residuals(tracks.front(), sets.front());
    std::vector<Eigen::MatrixXd> J(recording_.runs.size());
    tbb::parallel_for(std::size_t(0), J.size(), [&](std::size_t r) {
      const Eigen::Index n = 3 * Eigen::Index(filters_[r].samples());
      Eigen::MatrixXd raw(n, m);
      J[r] = Eigen::MatrixXd::Zero(n + kFeatureRows, m);
      for (Eigen::Index j = 0; j < m; ++j) {
        const auto& set = sets[std::size_t(j) + 1];
        raw.col(j) = track_error(tracks[0][r], tracks[std::size_t(j) + 1][r]) / steps[std::size_t(j)];
        if (acts_on_counts(set)) {
          J[r].col(j).tail(kFeatureRows) =
              feature_rows(r, predicted_features(r, set), predicted_features(r, sets[0]), predicted_habits(set),
                           predicted_habits(sets[0])) / steps[std::size_t(j)];
        }
      }
      J[r].topRows(n) = filters_[r].whiten(raw);
    });
    fit.grams = grams(residual, J);
    fit.columns = std::move(J);
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(sd.size());
    shift.tail(m) = fit.p;
    const Evidence e = evidence(fit.grams, all_runs(), first_columns(sd.size()), sd, shift);
    // Density with the effects held at p: the honest objective of the descent.
    const Evidence held = evidence(fit.grams, all_runs(), first_columns(nuisances_), nuisance_sd_);
    double density = held.log_density;
    for (Eigen::Index i = 0; i < m; ++i) density -= 0.5 * std::pow(fit.p[i] / sd[nuisances_ + i], 2);
    fit.covariance = e.covariance.bottomRightCorner(m, m);
    fit.residual = held.residual;
    fit.nuisance = held.mean;
    if (density > best_density) {
      const bool small = density < best_density + 0.05;
      best_density = density;
      best = fit;
      if (small) break;
      Eigen::VectorXd next = e.mean.tail(m);
      double change = 0;
      for (Eigen::Index i = 0; i < m; ++i) {
        next[i] = std::clamp(next[i], free[std::size_t(i)].min, free[std::size_t(i)].max);
        change = std::max(change, std::abs(next[i] - fit.p[i]) / std::sqrt(fit.covariance(i, i) + 1e-300));
      }
      best.linear = change < 1;
      if (change < 0.1) break;
      fit.p = next;
    } else {
      // Where a step leads was not where the derivatives pointed, unless it was too small to matter.
      best.linear = density > best_density - 0.5;
      fit.p = (fit.p + best.p) / 2;
    }
  }
  score(best);
  return best;
}

}  // namespace umbsim::gap

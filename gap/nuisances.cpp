#include "gap/nuisances.h"

#include <algorithm>
#include <cmath>

#include "gap/noise_floor.h"
#include "gap/run_groups.h"

namespace umbsim::gap {
namespace {

constexpr int kShared = 7;  // marker (2), clock, creep, slip, lag, frame
constexpr int kCreepColumn = 3;
constexpr int kLagColumn = 5;
constexpr int kPerGroup = 5;  // legs, turns in place, rolling turns, heading and sideways along legs
constexpr int kOwn = 4;       // radii (2), clock, its rate
constexpr double kCreep = 0.01;
constexpr double kUnexplained = 20;  // times the scatter between engines

Eigen::VectorXd shared_sd(const RunGroups& groups, const Scatter& s, bool tracker_free) {
  Eigen::VectorXd sd(kShared + kPerGroup * Eigen::Index(groups.rolling.size()));
  sd.head(kShared) << s.marker_m, s.marker_m, s.clock_s, s.creep_across, 1, s.lag_s, tracker_free ? s.frame_rad : 0;
  for (std::size_t g = 0; g < groups.rolling.size(); ++g) {
    sd.segment(kShared + kPerGroup * Eigen::Index(g), kPerGroup) << (groups.rolling[g] ? s.arc_leg_scale : s.leg_scale),
        s.turn_scale, s.arc_scale, s.heading_rad_pm, s.lateral;
  }
  return sd;
}

// The marker, the clock and the frame stay what they are, whoever made the recording.
Eigen::VectorXd of_same_engine(Eigen::VectorXd sd, const Scatter& s) {
  sd.segment(kCreepColumn, 3) *= s.same_engine;
  sd.tail(sd.size() - kShared) *= s.same_engine;
  return sd;
}

struct LittleSlip {
  std::vector<std::vector<Pose2>> tracks;
  double friction = 0;
};

// Tracks with the floor just so slippery that the robot moves by `wanted_m`: engines, and tyres, differ in when exactly
// they let go under a jolt. Empty if no floor is that slippery.
LittleSlip little_slip(const NominalReplay& nominal, const Drive& drive, double wanted_m) {
  Effect slippery = neutral_effect(find_effect("slippery_floor"));
  double grips = 0.8;
  double slips = 0.02;
  LittleSlip little;
  for (int i = 0; i < 7; ++i) {
    const double friction = std::sqrt(grips * slips);
    slippery.values.numbers = {friction};
    auto trial = drive({slippery});
    if (displacement_m(trial, nominal.tracks) > wanted_m) {
      slips = friction;
      little = {std::move(trial), friction};
    } else {
      grips = friction;
    }
  }
  return little;
}

std::vector<Kicks3> group_kicks(const NominalReplay& nominal, std::size_t run) {
  const double b_m = nominal.recording->robot.wheelbase_m;
  std::vector<Kicks3> kicks(kPerGroup, Kicks3(nominal.truth[run].size(), Eigen::Vector3d::Zero()));
  for (std::size_t k = 1; k < kicks[0].size(); ++k) {
    const auto& way = nominal.wheels_m[run][k];
    const double ds_m = (way[0] + way[1]) / 2;
    const double turn_rad = (way[1] - way[0]) / b_m;
    const bool arc = std::abs(ds_m) > 0.3 * b_m / 2 * std::abs(turn_rad);
    kicks[0][k][0] = ds_m;
    kicks[arc ? 2 : 1][k][2] = turn_rad;
    kicks[3][k][2] = std::abs(ds_m);
    kicks[4][k][1] = ds_m;
  }
  return kicks;
}

Eigen::MatrixXd own_columns(const NominalReplay& nominal, const TrackFilter& filter, std::size_t run) {
  Eigen::MatrixXd raw(3 * Eigen::Index(filter.samples()), kOwn);
  for (int wheel = 0; wheel < 2; ++wheel) raw.col(wheel) = filter.propagate(radius_kicks(nominal, run, wheel));
  const auto& truth = nominal.recording->runs[run].truth;
  const double middle_s = (truth.front().time_s + truth.back().time_s) / 2;
  for (std::size_t k = 0; k < filter.samples(); ++k) {
    raw.block<3, 1>(3 * Eigen::Index(k), 2) = nominal.velocity[run][k];
    raw.block<3, 1>(3 * Eigen::Index(k), 3) = (truth[k].time_s - middle_s) * nominal.velocity[run][k];
  }
  return raw;
}

Eigen::MatrixXd whitened(const TrackFilter& filter, const Eigen::MatrixXd& raw, int more_rows) {
  Eigen::MatrixXd white = Eigen::MatrixXd::Zero(raw.rows() + more_rows, raw.cols());
  white.topRows(raw.rows()) = filter.whiten(raw);
  return white;
}

}  // namespace

bool tracker_is_free(const Recording& recording) { return recording.truth_heading_sd_rad > 0.001; }

Nuisances make_nuisances(const NominalReplay& nominal, const std::vector<TrackFilter>& filters, const Scatter& scatter,
                         const Drive& drive, double floor_m, int more_rows, int lag_row) {
  const RunGroups groups = grouped(*nominal.recording);
  const bool is_free = tracker_is_free(*nominal.recording);
  Nuisances n;
  n.shared_sds = {shared_sd(groups, scatter, is_free)};
  n.unexplained_sd = Eigen::VectorXd::Zero(n.shared_sds.front().size());
  if (!is_free) n.shared_sds.push_back(of_same_engine(n.shared_sds.front(), scatter));
  for (std::size_t g = 0; g < groups.rolling.size(); ++g) {
    const Eigen::Index first = kShared + kPerGroup * Eigen::Index(g);
    // Between turns in place only the moments at which a turn begins and ends roll in an arc: engines differ there.
    for (int i = 0; i < kPerGroup; ++i) {
      if (i != 2 || groups.rolling[g]) n.unexplained_sd[first + i] = kUnexplained * n.shared_sds.front()[first + i];
    }
  }
  n.own_sd.resize(kOwn);
  const double radius = is_free ? scatter.real_radius : scatter.radius;
  n.own_sd << radius, radius, is_free ? scatter.run_clock_s : 0, is_free ? scatter.clock_rate : 0;
  // No two engines, and no real tyre, grip sideways alike: the creep of the tyres is a nuisance up to its usual size.
  Effect creep = neutral_effect(find_effect("tyre_creep"));
  creep.values.numbers = {0, kCreep};
  const auto crept = drive({creep});
  const auto [slipped, friction] = little_slip(nominal, drive, scatter.slip_share * floor_m);
  n.slips_at = friction;
  for (std::size_t r = 0; r < nominal.runs(); ++r) {
    const Eigen::Index samples = Eigen::Index(filters[r].samples());
    Eigen::MatrixXd raw = Eigen::MatrixXd::Zero(3 * samples, n.shared_sds.front().size());
    for (Eigen::Index k = 0; k < samples; ++k) {
      raw(3 * k, 0) = raw(3 * k + 1, 1) = raw(3 * k + 2, 6) = 1;
      raw.block<3, 1>(3 * k, 2) = nominal.velocity[r][std::size_t(k)];
    }
    raw.col(3) = track_error(nominal.tracks[r], crept[r]) / kCreep;
    if (!slipped.empty()) raw.col(4) = track_error(nominal.tracks[r], slipped[r]);
    const auto kicks = group_kicks(nominal, r);
    const Eigen::Index first = kShared + kPerGroup * Eigen::Index(groups.group_of[r]);
    for (int i = 0; i < kPerGroup; ++i) raw.col(first + i) = filters[r].propagate(kicks[std::size_t(i)]);
    n.shared.push_back(whitened(filters[r], raw, more_rows));
    if (nominal.recording->runs[r].has_commands)
      n.shared.back()(3 * samples + lag_row, kLagColumn) = 1 / scatter.run_lag_s;
    n.own.push_back(whitened(filters[r], own_columns(nominal, filters[r], r), more_rows));
  }
  return n;
}

}  // namespace umbsim::gap

#include "gap/noise/nuisances.h"

#include <algorithm>
#include <cmath>

#include "gap/noise/noise_floor.h"
#include "gap/replay/run_groups.h"

namespace umbsim::gap {
namespace {

constexpr int kCommon = 11;  // creep, slip, late readings, CountsColumns: of the robot
constexpr int kSlipColumn = 1;
constexpr int kLateColumn = 2;
constexpr int kCountsColumn = 3;    // the first of these
constexpr int kLagColumn = 2;       // among CountsColumns
constexpr int kFrictionColumn = 4;  // the first of two, among them
constexpr int kPerTracker = 4;      // marker (2), clock, frame: of each recording
constexpr int kOwn = 4;             // radii (2), clock, its rate
constexpr double kCreep = 0.01;
constexpr double kUnexplained = 20;  // times the scatter between engines

// Columns that all runs share, in this order: of the robot, of each group of runs, of each recording's tracker.
struct Layout {
  explicit Layout(const NominalReplay& nominal) : groups(grouped(nominal.recording->runs, nominal.origin)) {
    for (const Recording* r : nominal.origin) {
      if (trackers.empty() || trackers.back() != r) trackers.push_back(r);
      tracker_of.push_back(trackers.size() - 1);
    }
  }
  Eigen::Index tracker(std::size_t t) const {
    return column_of(groups.rolling.size(), kLegScale) + kPerTracker * Eigen::Index(t);
  }
  Eigen::Index size() const { return tracker(trackers.size()); }
  bool any_free() const {
    return std::any_of(trackers.begin(), trackers.end(), [](const Recording* r) { return tracker_is_free(*r); });
  }

  RunGroups groups;
  std::vector<const Recording*> trackers;
  std::vector<std::size_t> tracker_of;  // of each run
};

Eigen::VectorXd shared_sd(const Layout& layout, const Scatter& s) {
  Eigen::VectorXd sd(layout.size());
  sd.head(kCommon) << s.creep_across, s.slip_share, s.late_s, s.engine_gain, s.wheel_gain, s.lag_s, s.servo_s,
      s.rolling * s.servo_s, s.scrubbing * s.servo_s, s.course_gain, s.course_gain;
  for (std::size_t t = 0; t < layout.trackers.size(); ++t) {
    // A truth without noise is a simulator's.
    const double frame = layout.trackers[t]->truth_heading_sd_rad > 0 ? s.frame_rad : 0;
    sd.segment(layout.tracker(t), kPerTracker) << s.marker_m, s.marker_m, s.clock_s, frame;
  }
  const RunGroups& groups = layout.groups;
  for (std::size_t g = 0; g < groups.rolling.size(); ++g) {
    const bool several = layout.trackers.size() > 1;
    const double arcs = several ? s.turns_between : s.arc_scale, turns = several ? s.turns_between : s.turn_scale;
    sd.segment(column_of(g, kLegScale), kContactDifferences) << (groups.rolling[g] ? s.arc_leg_scale : s.leg_scale),
        turns, arcs, s.heading_rad_pm, s.lateral, s.lead_s, s.lead_s, s.lead_s_pmps, s.lead_s_pradps, s.outward_mps;
  }
  return sd;
}

// Servos of four kinds: that give way under their load and under friction, under their load alone, that lag whatever
// the load, and that turn as they are told. When counts are read is another matter.
enum class Servo { rubs, gives_way, lags, exact };

Eigen::VectorXd with_servos(Eigen::VectorXd sd, Servo servo, const Scatter& s) {
  auto of_servos = sd.segment<CountsColumns::ColsAtCompileTime>(kCountsColumn);
  const double lag_s = of_servos[kLagColumn];
  if (servo == Servo::gives_way) of_servos.segment<2>(kFrictionColumn) *= s.same_servos;
  if (servo == Servo::lags || servo == Servo::exact) of_servos *= s.same_servos;
  if (servo == Servo::lags) of_servos[kLagColumn] = lag_s;
  return sd;
}

// This engine's contacts, and its encoders, which are read at once. The marker, the clock and the frame stay what they
// are, whoever made the recording.
Eigen::VectorXd with_same_contacts(Eigen::VectorXd sd, const Layout& layout, const Scatter& s) {
  sd.head(kCountsColumn) *= s.same_engine;
  sd.segment(kCommon, layout.tracker(0) - kCommon) *= s.same_engine;
  return sd;
}

// Neither free nor without noise: it may be a tracker that was mounted by hand, or a simulator's truth with noise on
// it.
bool may_be_exact(const Recording* r) { return r->truth_heading_sd_rad > 0 && !tracker_is_free(*r); }

Eigen::VectorXd with_exact_trackers(Eigen::VectorXd sd, const Layout& layout, const Scatter& s) {
  for (std::size_t t = 0; t < layout.trackers.size(); ++t) {
    if (!may_be_exact(layout.trackers[t])) continue;
    sd.segment(layout.tracker(t), kPerTracker) << s.exact_marker_m, s.exact_marker_m, s.clock_s, 0;
  }
  return sd;
}

// With trackers mounted by hand, and with exact ones, where there may be any.
std::vector<Eigen::VectorXd> by_mount(const Layout& layout, const Scatter& s) {
  std::vector<Eigen::VectorXd> sds{shared_sd(layout, s)};
  if (std::any_of(layout.trackers.begin(), layout.trackers.end(), may_be_exact))
    sds.push_back(with_exact_trackers(sds.front(), layout, s));
  return sds;
}

// Each of these with each kind of servo: whose contacts they are says nothing of servos.
std::vector<Eigen::VectorXd> by_servos(const std::vector<Eigen::VectorXd>& sds, const std::vector<Servo>& kinds,
                                       const Scatter& s) {
  std::vector<Eigen::VectorXd> all;
  for (const Servo kind : kinds) {
    for (const Eigen::VectorXd& sd : sds) all.push_back(with_servos(sd, kind, s));
  }
  return all;
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

std::vector<Impulses3> group_impulses(const NominalReplay& nominal, std::size_t run) {
  const double b_m = nominal.recording->robot.wheelbase_m;
  std::vector<Impulses3> impulses(kContactDifferences, Impulses3(nominal.truth[run].size(), Eigen::Vector3d::Zero()));
  const auto squared = [](double v) { return v * std::abs(v); };
  for (std::size_t k = 1; k < impulses[0].size(); ++k) {
    const auto& way = nominal.wheels_m[run][k];
    const double ds_m = (way[0] + way[1]) / 2;
    const double turn_rad = (way[1] - way[0]) / b_m;
    const bool arc = std::abs(ds_m) > 0.3 * b_m / 2 * std::abs(turn_rad);
    const Eigen::Vector3d &before = nominal.velocity[run][k - 1], &now = nominal.velocity[run][k];
    impulses[kLegScale][k][0] = ds_m;
    impulses[arc ? kArcScale : kTurnScale][k][2] = turn_rad;
    impulses[kHeadingOnLegs][k][2] = std::abs(ds_m);
    impulses[kLateralOnLegs][k][1] = ds_m;
    impulses[kLeadAlong][k][0] = now[0] - before[0];
    impulses[kLeadTurning][k][2] = now[2] - before[2];
    impulses[kLeadAlongGrows][k][0] = squared(now[0]) - squared(before[0]);
    impulses[kLeadTurningGrows][k][2] = squared(now[2]) - squared(before[2]);
    if (!arc) impulses[kOutward][k][0] = turn_rad * now[2];
  }
  return impulses;
}

Eigen::MatrixXd own_columns(const NominalReplay& nominal, const TrackFilter& filter, std::size_t run) {
  Eigen::MatrixXd raw(3 * Eigen::Index(filter.samples()), kOwn);
  for (int wheel = 0; wheel < 2; ++wheel) raw.col(wheel) = filter.propagate(radius_impulses(nominal, run, wheel));
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

// What all runs share, under each of the priors that may hold (Nuisances::shared_sds).
void believe(const Layout& layout, const Scatter& scatter, const Scatter& other, Nuisances& n) {
  const std::vector<Servo> any{Servo::rubs, Servo::gives_way, Servo::lags, Servo::exact};
  const std::vector<Eigen::VectorXd> mounts = by_mount(layout, scatter);
  const auto add = [&](const std::vector<Eigen::VectorXd>& sds) {
    n.shared_sds.insert(n.shared_sds.end(), sds.begin(), sds.end());
  };
  if (!layout.any_free()) add(by_servos(by_mount(layout, other), any, other));
  n.wide = n.shared_sds.size();
  add(by_servos(mounts, any, scatter));
  n.of_another = n.shared_sds.size();
  if (layout.any_free()) return;
  for (const Eigen::VectorXd& sd : by_servos(mounts, {Servo::gives_way, Servo::exact}, scatter))
    n.shared_sds.push_back(with_same_contacts(sd, layout, scatter));
}

}  // namespace

Scatter between_engines(Scatter scatter) {
  scatter.creep_across = 0.2;
  scatter.leg_scale = 3e-4;
  scatter.turn_scale = 9e-4;
  scatter.slip_share = 1;
  scatter.lead_s = 0.015;
  scatter.lead_s_pmps = 0.02;
  scatter.lead_s_pradps = 0.005;
  scatter.outward_mps = 1e-3;
  return scatter;
}

Eigen::Index column_of(std::size_t group, ContactDifference difference) {
  return kCommon + kContactDifferences * Eigen::Index(group) + difference;
}

bool tracker_is_free(const Recording& recording) { return recording.truth_heading_sd_rad > 0.001; }

Nuisances make_nuisances(const NominalReplay& nominal, const std::vector<TrackFilter>& filters, const Scatter& scatter,
                         const Drive& drive, double floor_m, const std::vector<CountsColumns>& counts) {
  const Layout layout(nominal);
  const RunGroups& groups = layout.groups;
  const Scatter other = layout.any_free() ? scatter : between_engines(scatter);
  Nuisances n;
  believe(layout, scatter, other, n);
  n.usual_sd = with_servos(shared_sd(layout, scatter), Servo::exact, scatter);
  n.lead_s = other.lead_s;
  for (std::size_t t = 0; t < layout.trackers.size(); ++t) {
    if (may_be_exact(layout.trackers[t])) n.markers.push_back(layout.tracker(t));
  }
  for (std::size_t g = 0; g < groups.rolling.size() && layout.trackers.size() > 1; ++g) {
    for (const ContactDifference d : {kTurnScale, kArcScale}) n.turns.push_back(column_of(g, d));
  }
  n.engine_sd = Eigen::VectorXd::Zero(layout.size());
  n.engine_sd.head(layout.tracker(0)) = n.shared_sds.front().head(layout.tracker(0));
  n.unexplained_sd = Eigen::VectorXd::Zero(layout.size());
  for (std::size_t g = 0; g < groups.rolling.size(); ++g) {
    // Between turns in place only the moments at which a turn begins and ends roll in an arc: engines differ there.
    for (const ContactDifference d : {kLegScale, kTurnScale, kArcScale, kHeadingOnLegs, kLateralOnLegs}) {
      const Eigen::Index at = column_of(g, d);
      if (d != kArcScale || groups.rolling[g]) n.unexplained_sd[at] = kUnexplained * n.shared_sds.front()[at];
    }
  }
  // No two engines, and no real tyre, grip sideways alike: the creep of the tyres is a nuisance up to its usual size.
  Effect creep = neutral_effect(find_effect("tyre_creep"));
  creep.values.numbers[1] = kCreep;  // across
  const auto crept = drive({creep});
  Effect late = neutral_effect(find_effect("encoder_latency"));
  late.values.numbers = {scatter.late_s};
  const auto read_late = drive({late});
  const auto [slipped, friction] = little_slip(nominal, drive, other.slip_share * floor_m);
  n.slips_at = friction;
  for (std::size_t r = 0; r < nominal.runs(); ++r) {
    const Eigen::Index samples = Eigen::Index(filters[r].samples());
    Eigen::MatrixXd raw = Eigen::MatrixXd::Zero(3 * samples, layout.size());
    const Eigen::Index tracker = layout.tracker(layout.tracker_of[r]);
    for (Eigen::Index k = 0; k < samples; ++k) {
      raw(3 * k, tracker) = raw(3 * k + 1, tracker + 1) = raw(3 * k + 2, tracker + 3) = 1;
      raw.block<3, 1>(3 * k, tracker + 2) = nominal.velocity[r][std::size_t(k)];
    }
    raw.col(kCreepColumn) = filters[r].error(nominal.tracks[r], crept[r]) / kCreep;
    if (!slipped.empty()) raw.col(kSlipColumn) = filters[r].error(nominal.tracks[r], slipped[r]) / other.slip_share;
    const auto impulses = group_impulses(nominal, r);
    for (std::size_t d = 0; d < impulses.size(); ++d)
      raw.col(column_of(groups.group_of[r], ContactDifference(d))) = filters[r].propagate(impulses[d]);
    // Counts that are read late are behind the pose and behind the commands alike.
    raw.col(kLateColumn) = filters[r].error(nominal.tracks[r], read_late[r]) / scatter.late_s;
    const int more_rows = int(counts[r].rows());
    n.shared.push_back(whitened(filters[r], raw, more_rows));
    n.shared.back().block(3 * samples, kCountsColumn, more_rows, counts[r].cols()) = counts[r];
    n.shared.back().block(3 * samples, kLateColumn, more_rows, 1) = counts[r].col(kLagColumn);
    n.tracks.push_back(std::move(raw));
    const bool is_free = tracker_is_free(*nominal.origin[r]);
    const double radius = is_free ? scatter.real_radius : scatter.radius;
    n.own_sd.push_back(
        Eigen::Vector4d(radius, radius, is_free ? scatter.run_clock_s : 0, is_free ? scatter.clock_rate : 0));
    n.own.push_back(whitened(filters[r], own_columns(nominal, filters[r], r), more_rows));
  }
  return n;
}

void whiten_again(Nuisances& n, const NominalReplay& nominal, const std::vector<TrackFilter>& filters) {
  for (std::size_t r = 0; r < filters.size(); ++r) {
    n.shared[r].topRows(n.tracks[r].rows()) = filters[r].whiten(n.tracks[r]);
    n.own[r] = whitened(filters[r], own_columns(nominal, filters[r], r), int(n.own[r].rows() - n.tracks[r].rows()));
  }
}

}  // namespace umbsim::gap

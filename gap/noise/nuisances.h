#pragma once

#include <functional>
#include <vector>

#include "gap/noise/track_filter.h"
#include "gap/replay/nominal_replay.h"
#include "gap/traits/traits.h"

namespace umbsim::gap {

/// How far a robot's contacts may be from the simulator's, and a robot from its own runs: standard deviations of
/// scatter that no effect of the catalogue is needed for.
struct Scatter {
  double radius = 6e-5;         ///< of a wheel's radius from run to run
  double real_radius = 2e-4;    ///< the same where the tracker is free: a real robot's tyres warm and wear
  double leg_scale = 8e-5;      ///< of distance, per driving condition
  double arc_leg_scale = 3e-4;  ///< the same between rolling turns
  double turn_scale = 3e-4;     ///< of turns in place
  double arc_scale = 1.5e-3;    ///< of rolling turns
  double turns_between = 3e-3;  ///< of all turns, between recordings of one robot: kinds of driving that tyres scrub in
  double heading_rad_pm = 5e-5;  ///< along legs
  double lateral = 3e-5;         ///< along legs
  /// Along, per second at 1 rad/s and as the square of the rate: a mass ahead of the axle pulls outward in turns in
  /// place, and wheels that scrub give way.
  double outward_mps = 1e-4;
  double late_s = 0.004;     ///< by which counts are read late; MuJoCo's are by 4.5 ms
  double lead_s = 0;         ///< of the pose before the counts, as speed goes, along and turning: contacts that creep
  double lead_s_pmps = 0;    ///< by which the lead along grows with the speed,
  double lead_s_pradps = 0;  ///< and the one of turns with theirs
  double marker_m = 0.003;   ///< of the tracked point from the axle's middle, where it was mounted by hand
  double frame_rad = 0.02;   ///< of the tracker's heading from the drive axis, the same
  double exact_marker_m = 5e-4;   ///< of the point where it is the axle's middle by definition: a simulation's truth
  double exact_start_rad = 5e-4;  ///< of the start where it is that of the course by definition, beside exact_marker_m
  double placed_m = 0.005;        ///< of the start where the robot was put there by hand, beside frame_rad
  double clock_s = 0.05;          ///< between encoders and tracker
  double run_clock_s = 0.02;      ///< the same from run to run, where the tracker is free
  double clock_rate = 1e-3;       ///< of one clock against the other, from run to run, where the tracker is free
  double friction = kOrdinaryFriction;  ///< of the most slippery floor that is ordinary
  double creep_across = 0.03;           ///< sideways creep of the tyres
  double slip_share = 0.2;              ///< displacement by slip under jolts, in noise floors
  double gain = 4e-4;                   ///< of counts over commands
  double engine_gain = 1e-3;    ///< of the same, alike in all runs and in both wheels: a speed control in proportion
  double wheel_gain = 7e-4;     ///< of the same, of one wheel against the other
  double course_gain = 1.5e-3;  ///< of the same as the heading from the start goes, cosine and sine, mirrored cw to ccw
  double lag_s = 0.02;          ///< of counts behind commands, alike in all runs: no servo follows at once
  double run_lag_s = 0.003;     ///< the same from run to run
  double servo_s = 0.02;        ///< time constant of servos that give way under their load
  double rolling = 0.01;  ///< friction that these give way under on the way (casters, gears), as a share of the weight,
  double scrubbing = 0.03;    ///< and in turns in place, where wheels scrub
  double same_engine = 0.1;   ///< share of what engines differ by that is left where both are the same,
  double same_servos = 0.03;  ///< and of what their servos do
};

/// The same where another engine made the runs, as measured between four of them (docs/worlds.md).
Scatter between_engines(Scatter scatter);

/// What contacts may do otherwise in each group of runs (RunGroups): the numbers of Scatter by these names.
enum ContactDifference : Eigen::Index {
  kLegScale,
  kTurnScale,
  kArcScale,
  kHeadingOnLegs,
  kLateralOnLegs,
  kLeadAlong,
  kLeadTurning,
  kLeadAlongGrows,
  kLeadTurningGrows,
  kOutward,
  kContactDifferences
};

/// Among the columns that all runs share: creep across, and what contacts do in a group of runs.
inline constexpr Eigen::Index kCreepColumn = 0;
Eigen::Index column_of(std::size_t group, ContactDifference difference);

/// Columns that are fitted always and credited to nobody. Per run, whitened; outer index: run.
struct Nuisances {
  /// First `wide`, if an engine made the recording that differs from this one by as much as engines do: with a tracker
  /// that was mounted by hand and, where its header does not speak against it, with an exact one; both with each kind
  /// of servo. Up to `of_another` the same, if engines, or a robot, differ by little. Then, if this engine made it,
  /// which runs show by how little they stray, with servos that give way or turn as they are told.
  std::vector<Eigen::VectorXd> shared_sds;
  std::size_t wide = 0;
  std::size_t of_another = 0;
  double lead_s = 0;         ///< of the poses of the first (Scatter)
  Eigen::VectorXd usual_sd;  ///< of a hand-mounted tracker, little differences and exact servos: runs are planned so
  std::vector<Eigen::Index> markers;  ///< of trackers that may be exact: first of two numbers, the point that each sees
  std::vector<Eigen::Index> turns;    ///< of several recordings: by which turns of each kind are off
  Eigen::VectorXd mount;  ///< where trackers that were mounted by hand are; 0 of exact and free ones, and of all else
  Eigen::VectorXd unexplained_sd;       ///< of all, if errors of no particular cause stood behind them
  std::vector<Eigen::MatrixXd> shared;  ///< one number for all runs that it acts in
  std::vector<Eigen::MatrixXd> tracks;  ///< the same as track errors, not whitened
  Eigen::VectorXd engine_sd;            ///< of what engines differ by; 0 of the trackers' numbers
  std::vector<Eigen::VectorXd> own_sd;
  std::vector<Eigen::MatrixXd> own;  ///< numbers of its own for each run
  double slips_at = 0;               ///< friction of the floor at which the wheels begin to let go; 0: at none
};

/// Tracks of all runs in the simulator under effects.
using Drive = std::function<std::vector<std::vector<Pose2>>(const std::vector<Effect>&)>;

/// A real robot's tracker is mounted by hand and has a clock of its own: its frame and clock are free unless it knows
/// headings as well as a simulated one.
bool tracker_is_free(const Recording& recording);

/// Of counts against commands, per unit of what may be alike in all runs: a gain of both wheels, one of the left wheel
/// against the right one, a lag (s), a servo's time constant (s), the same times friction on the way and in turns in
/// place (s), a gain that goes with the cosine and one with the sine of the heading from the start, to the side of
/// the turns. Rows in standard deviations.
using CountsColumns = Eigen::Matrix<double, Eigen::Dynamic, 8>;

/// `floor_m`: the noise floor, for how much slip is nobody's. `counts`: of each run, below its tracks' rows.
Nuisances make_nuisances(const NominalReplay& nominal, const std::vector<TrackFilter>& filters, const Scatter& scatter,
                         const Drive& drive, double floor_m, const std::vector<CountsColumns>& counts);

/// Whitens them anew, with other filters.
void whiten_again(Nuisances& nuisances, const NominalReplay& nominal, const std::vector<TrackFilter>& filters);

}  // namespace umbsim::gap

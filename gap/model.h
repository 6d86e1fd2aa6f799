#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gap/evidence.h"
#include "gap/family.h"
#include "gap/habits.h"
#include "gap/simulator.h"
#include "gap/track_filter.h"
#include "recording/recording.h"
#include "recording/stretches.h"

namespace umbsim::gap {

/// How far one engine's contact model may be from another's, and a robot from its own runs: standard deviations of
/// scatter that no effect of the catalogue is needed for.
struct Scatter {
  double radius = 5e-5;         ///< of a wheel's radius from run to run
  double leg_scale = 8e-5;      ///< of distance, per driving condition
  double arc_leg_scale = 3e-4;  ///< the same between rolling turns
  double turn_scale = 3e-4;     ///< of turns in place
  double arc_scale = 1.5e-3;      ///< of rolling turns
  double heading_rad_pm = 5e-5; ///< along legs
  double lateral = 3e-5;        ///< along legs
  double marker_m = 0.003;      ///< of the tracked point from the axle's middle
  double frame_rad = 0.02;      ///< of the tracker's heading from the drive axis, where it is free
  double clock_s = 0.05;        ///< between encoders and tracker
  double creep_across = 0.03;   ///< sideways creep of the tyres
  double slip_share = 0.2;      ///< displacement by slip under jolts, in noise floors
  double gain = 4e-4;           ///< of counts over commands
  double lag_s = 0.010;         ///< of counts behind commands
};

/// Counts against commands of one run: what the drivetrain and the encoders make of what was asked.
struct CommandFeatures {
  bool known = false;
  double left_gain = 0;   ///< counted over commanded rotation, minus 1
  double right_gain = 0;
  double lag_s = 0;       ///< of the counts behind the commands
};

/// Columns that belong to one run alone, and are integrated out.
struct LocalColumns {
  Eigen::MatrixXd columns;
  Eigen::VectorXd prior_sd;
};

/// A fitted combination of effects.
struct Fit {
  std::vector<Family> families;
  Eigen::VectorXd p;           ///< of all families in order
  Eigen::MatrixXd covariance;
  bool linear = true;          ///< the descent ended where the linear model has its optimum
  double log_evidence = 0;     ///< against no effect and the same nuisances
  double held_out = 0;         ///< sum of log predictive densities of each condition given the others, the same
  double residual = 0;         ///< squared whitened residual at the optimum
  std::vector<RunGram> grams;  ///< residual, nuisances, derivatives at p
  std::vector<Eigen::MatrixXd> columns;  ///< whitened derivatives at p, per run
  Eigen::VectorXd nuisance;    ///< posterior mean of the shared nuisances
  std::vector<std::vector<Pose2>> tracks;  ///< simulated at p

  double size = 0;  ///< root mean square displacement that the last family adds to the tracks, over the noise floor

  std::vector<Effect> effects() const;
  std::string name() const;    ///< effects joined by "+", in alphabetical order
};

/// A recording seen through the simulator: residuals, nuisances, noise, and the evidence for any combination of effects.
class Model {
 public:
  /// `known`: the noise, where it is not to be estimated from the runs.
  Model(const Recording& recording, Simulator simulator, const Scatter& scatter,
        const std::optional<NoiseModel>& known = std::nullopt);

  const Recording& recording() const { return recording_; }
  const NoiseModel& noise() const { return noise_; }
  const std::vector<Stretch>& stretches(std::size_t run) const { return stretches_[run]; }
  const std::vector<std::vector<Pose2>>& nominal_tracks() const { return nominal_; }
  const TrackFilter& filter(std::size_t run) const { return filters_[run]; }
  /// Whether a sample of the truth counts: of end points only the first and the last, of a dense track a few a second,
  /// for the errors of a tracker go on from one picture to the next.
  bool observed(std::size_t run, std::size_t sample) const {
    return sample == 0 || sample + 1 == truth_[run].size() ||
           (recording_.truth_kind != "endpoints" && sample % thinning_[run] == 0);
  }
  const std::vector<std::string>& conditions() const { return conditions_; }  ///< of each run
  const Habits& habits() const { return habits_; }  ///< measured
  const std::vector<double>& rolled(std::size_t run) const { return rolled_[run]; }
  const CommandFeatures& features_of(std::size_t run) const { return measured_[run]; }
  const CommandFeatures& nominal_features_of(std::size_t run) const { return nominal_features_[run]; }
  int nuisances() const { return nuisances_; }
  const Eigen::VectorXd& nuisance_sd() const { return nuisance_sd_; }
  bool replicated() const { return replicated_; }

  /// Tracks of all runs under each set of effects.
  std::vector<std::vector<std::vector<Pose2>>> simulate(const std::vector<std::vector<Effect>>& sets) const;

  /// Derivative columns of a family at its start, seen from the nominal model (or in proportion from zero).
  /// Result: for each run, whitened columns with features below.
  std::vector<Eigen::MatrixXd> columns(const std::vector<Effect>& at, const std::vector<std::vector<Effect>>& stepped,
                                       const std::vector<double>& steps) const;

  /// Whitened residual of every run for simulated tracks under `effects`.
  std::vector<Eigen::VectorXd> residuals(const std::vector<std::vector<Pose2>>& tracks,
                                         const std::vector<Effect>& effects) const;

  /// Grams of residual, nuisances and the given columns; further columns of each run alone are integrated out.
  std::vector<RunGram> grams(const std::vector<Eigen::VectorXd>& residual, const std::vector<Eigen::MatrixXd>& columns,
                             const std::vector<LocalColumns>& local = {}) const;

  /// What a fit leaves of the whitened residual of each run, after the shared nuisances.
  std::vector<Eigen::VectorXd> left_over(const Fit& fit) const;

  /// No effect at all.
  Fit none() const;

  /// Log density of the data with the families' numbers held at p, against none: how well a start would do.
  double density_at(const std::vector<Family>& families, const Eigen::VectorXd& p) const;

  /// Fits the free numbers of the families together, in the simulator. `start`: empty for the families' own.
  Fit fit(const std::vector<Family>& families, const Eigen::VectorXd& start = {}, int rounds = 4) const;

  /// The effects of a fit with their numbers taken from a subset of the runs.
  std::vector<Effect> fitted_on(const Fit& fit, const std::vector<std::size_t>& runs) const;

  /// One run under effects.
  std::vector<Pose2> simulate_run(std::size_t run, const std::vector<Effect>& effects) const {
    return simulator_.ticks(run, effects);
  }

  /// Log evidence over the runs of a subset, of a fit's linearised model.
  double log_evidence(const Fit& fit, const std::vector<std::size_t>& runs) const;

  std::vector<std::size_t> all_runs() const;
  double rows() const;  ///< numbers in all residuals
  double simulated_s() const { return simulated_s_; }

 private:
  std::vector<bool> seen(std::size_t run) const;
  std::vector<Eigen::Vector3d> velocity(std::size_t run) const;
  bool frame_is_free() const;
  void noise_from_what_is_left();
  void find_conditions();
  void estimate_noise();
  void make_filters();
  void make_nuisances();
  std::vector<std::vector<Pose2>> little_slip() const;
  void score(Fit& fit) const;
  CommandFeatures features(std::size_t run, const std::vector<std::array<double, 2>>& counts_rad) const;
  CommandFeatures predicted_features(std::size_t run, const std::vector<Effect>& effects) const;
  Eigen::VectorXd feature_rows(std::size_t run, const CommandFeatures& a, const CommandFeatures& b, const Habits& ha,
                               const Habits& hb) const;
  Habits predicted_habits(const std::vector<Effect>& effects) const;

  const Recording& recording_;
  Simulator simulator_;
  Scatter scatter_;
  NoiseModel noise_;
  bool replicated_ = false;
  std::vector<std::vector<Stretch>> stretches_;
  std::vector<std::string> conditions_;
  std::vector<std::vector<double>> rolled_;
  std::vector<std::vector<Pose2>> truth_;
  std::vector<std::size_t> thinning_;  ///< every so many-th sample of the truth counts
  std::vector<std::vector<Pose2>> nominal_;
  std::vector<TrackFilter> filters_;
  std::vector<CommandFeatures> measured_;
  std::vector<CommandFeatures> nominal_features_;
  Habits habits_{};          // measured
  Habits nominal_habits_{};
  int nuisances_ = 0;
  Eigen::VectorXd nuisance_sd_;
  std::vector<Eigen::MatrixXd> nuisance_columns_;   // per run, whitened, with feature rows of zeros
  std::vector<Eigen::MatrixXd> local_columns_;      // per run: scatter of this run alone
  Eigen::VectorXd local_sd_;
  mutable double simulated_s_ = 0;
};

}  // namespace umbsim::gap

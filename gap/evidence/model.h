#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gap/evidence/evidence.h"
#include "gap/hypotheses/hypothesis.h"
#include "gap/noise/counts_noise.h"
#include "gap/noise/noise_estimate.h"
#include "gap/noise/nuisances.h"
#include "gap/noise/track_filter.h"
#include "gap/replay/command_response.h"
#include "gap/replay/nominal_replay.h"
#include "gap/replay/passed_places.h"
#include "gap/replay/simulator.h"
#include "gap/traits/signature_errors.h"
#include "recording/command_features.h"
#include "recording/recording.h"

namespace umbsim::gap {

/// What the simulator says of all runs under some effects.
struct Predicted {
  std::vector<std::vector<Pose2>> tracks;
  std::vector<CommandResponse> counted;  ///< counts against commands, of each run
  CommandFeatures command_features{};
};

/// Columns that belong to one run alone, and are integrated out.
struct LocalColumns {
  Eigen::MatrixXd columns;
  Eigen::VectorXd prior_sd;
};

/// A fitted combination of effects.
struct Fit {
  std::vector<Hypothesis> hypotheses;
  Eigen::VectorXd p;  ///< of all hypotheses in order
  Eigen::MatrixXd covariance;
  bool linear = true;       ///< the descent ended where the linear model has its optimum
  double log_chance = 0;    ///< see Model::log_chance; part of the evidence
  double log_evidence = 0;  ///< against no effect and the same nuisances
  double held_out = 0;      ///< sum of log predictive densities of each condition given the others, the same
  double residual = 0;      ///< squared whitened residual at the optimum
  double misfit = 0;        ///< the same with what the nuisances cost: as many as there are rows, if the model is right
  std::vector<RunGram> grams;            ///< residual, nuisances, derivatives at p
  std::vector<Eigen::MatrixXd> columns;  ///< whitened derivatives at p, per run
  Eigen::VectorXd nuisance;              ///< posterior mean of the shared nuisances
  Predicted predicted;                   ///< at p
  std::size_t prior = 0;                 ///< of the nuisances, under which the data are likelier (Nuisances)

  double size = 0;  ///< root mean square displacement that the last hypothesis adds to the tracks, over the noise floor
  double seen = 0;  ///< root mean square of the same in the whitened tracks: what makes no way, but shakes, shows here

  std::vector<Effect> effects() const;
  /// The effects that a robot can be driven with, at other numbers; `without`: but for those of one hypothesis.
  std::vector<Effect> driven_at(const Eigen::VectorXd& numbers, std::size_t without = std::size_t(-1)) const;
  std::string name() const;  ///< effects joined by "+", in alphabetical order
  /// By how much log evidence the last effect is missed, without what goes with it: its own numbers' prior density over
  /// their posterior one, where it is off (Dickey 1971).
  double own_evidence() const;
  bool is_kinematic() const;  ///< all of its effects are
  bool is_local() const;      ///< one of them is at a place or a moment
};

/// How a descent to the best numbers goes: for how many rounds, and to what share of a step that led down it goes back.
/// What begins at a top goes back far: only how far derivatives hold is open there.
struct Descending {
  int rounds = 7;
  double back = 0.5;
};

/// Whitened residuals near some numbers of effects: residual - columns (p' - p), per run.
struct Linearisation {
  Eigen::VectorXd p;
  std::vector<Eigen::VectorXd> residual;
  std::vector<Eigen::MatrixXd> columns;

  /// Whether the residuals at `to` are where the derivatives put them, but for a small share of the step or of the
  /// noise.
  bool foretold(const Eigen::VectorXd& to, const std::vector<Eigen::VectorXd>& there) const;
  /// Goes to `to`; the derivatives along the step become what it showed.
  void learn(const Eigen::VectorXd& to, const std::vector<Eigen::VectorXd>& there, const Eigen::VectorXd& scale);
};

/// A recording seen through the simulator: residuals, nuisances, noise, and the evidence for any combination of
/// effects.
class Model {
 public:
  /// `simulator`: of the campaign's runs. `known`: the noise, where it is not to be estimated from the runs. The
  /// campaign must outlive the model.
  Model(const Campaign& campaign, Simulator simulator, const Scatter& scatter,
        const std::optional<NoiseModel>& known = std::nullopt);

  const Campaign& campaign() const { return *campaign_; }
  const Recording& recording() const { return campaign_->all; }
  const NominalReplay& nominal() const { return nominal_; }
  /// Of the first recording.
  const NoiseModel& noise() const { return noises_.front().noise; }
  const NoiseModel& noise(std::size_t run) const { return noises_[campaign_->part_of[run]].noise; }
  /// What is predicted as one when it is held out: runs of one recording, condition and direction.
  std::string condition(std::size_t run) const;
  bool tracker_is_free() const;  ///< of any recording
  /// Whether a fit says that this engine made the recordings: their runs stray from it by less than engines differ.
  bool same_engine(const Fit& fit) const { return fit.prior >= nuisances_.of_another; }
  /// Whether it is open that this engine made them: a real robot's runs are not.
  bool engine_is_open() const { return nuisances_.shared_sds.size() > nuisances_.of_another; }
  /// Whether a fit's contacts are another engine's, so that they do much otherwise. What rolls does alike in every one.
  bool contacts_differ(const Fit& fit) const { return !same_engine(fit) && !fit.is_kinematic(); }
  /// By how much log evidence a fit says that another engine made the runs; 0 where it is not open.
  double another_engine(const Fit& fit) const;
  /// Whether it says that one did which differs from this by as much as engines do. A real robot's runs are no
  /// engine's.
  bool another_engines(const Fit& fit) const { return fit.prior < nuisances_.wide; }
  /// From now on the runs are known to be such an engine's; not for a real robot's.
  void take_for_another_engines();
  /// This model, were engines to differ by little.
  Model with_little_differences() const;
  /// This model, were tyres to scrub alike in all kinds of driving (Scatter::turns_between), as a twin foretells.
  Model with_turns_alike() const;
  double noise_floor_m() const { return noise_floor_m_; }
  bool replicated() const { return replicated_; }
  const std::vector<Stretch>& stretches(std::size_t run) const { return stretches_[run]; }
  const std::vector<PassedPlace>& passed_places() const;  ///< of one recording; found once
  const TrackFilter& filter(std::size_t run) const { return filters_[run]; }
  const CommandFeatures& command_features() const { return measured_.command_features; }
  double wheel_width_m() const { return simulator_.wheel_width_m; }  ///< of the drive wheels; 0: not known
  double mass_kg() const { return simulator_.mass_kg; }
  /// That each motor moves as the robot speeds up, at the wheel.
  double motor_inertia_kgm2() const {
    return std::max(1e-6, mass_kg() / 2 * std::pow(recording().robot.wheel_radius_m, 2));
  }
  int nuisances() const { return int(nuisance_sd().size()); }
  /// Of another engine's recording with exact servos, as long as nothing is known of its tracker.
  const Eigen::VectorXd& nuisance_sd() const { return nuisances_.usual_sd; }
  /// What it may be (Nuisances).
  const std::vector<Eigen::VectorXd>& nuisance_sds() const { return nuisances_.shared_sds; }
  const Eigen::VectorXd& unexplained_sd() const { return nuisances_.unexplained_sd; }
  /// What other engines make of a run: track errors, as many as nuisances(), and how large each is.
  const Eigen::MatrixXd& engine_tracks(std::size_t run) const { return nuisances_.tracks[run]; }
  const Eigen::VectorXd& engine_sd() const { return nuisances_.engine_sd; }
  /// Track errors of a run that are its tracker's, by how it was mounted: neither the robot nor the simulator errs.
  Eigen::VectorXd mount_error(std::size_t run) const { return nuisances_.tracks[run] * nuisances_.mount; }
  /// Whitened columns of a run's own nuisances; the first two are the radii of its wheels.
  const Eigen::MatrixXd& own_columns(std::size_t run) const { return nuisances_.own[run]; }
  /// Of a wheel's radius from run to run.
  double radius_scatter(std::size_t run) const { return nuisances_.own_sd[run][0]; }
  /// Friction at which the robot begins to slip on these runs; 0: at none.
  double slips_at() const { return nuisances_.slips_at; }
  std::vector<std::size_t> all_runs() const;
  std::vector<std::size_t> one_of_each() const;  ///< the first run of every condition and direction
  double rows() const;                           ///< numbers in all residuals that count
  double simulated_s() const { return 0.001 * double(simulated_ms_); }

  /// All runs under each set of effects. `some`: only these runs are driven, the tracks of the others are empty.
  std::vector<Predicted> predict(const std::vector<std::vector<Effect>>& sets,
                                 const std::vector<std::size_t>& some = {}) const;

  /// Mean square position errors that noise alone makes (noise_misfits_m2), drawn once: kNoiseDraws of every run, m^2.
  const std::vector<std::vector<double>>& noise_m2(bool other_engine = false) const;

  std::vector<Pose2> simulate_run(std::size_t run, const std::vector<Effect>& effects) const {
    return simulator_.ticks(run, effects, roughness_under(effects));
  }

  /// Differences between two predictions over a step, per run: whitened, counts against commands below.
  std::vector<Eigen::MatrixXd> columns(const Predicted& at, const std::vector<Predicted>& stepped,
                                       const std::vector<double>& steps) const;
  /// Whitened residual of every run; empty where the run was not driven.
  std::vector<Eigen::VectorXd> residuals(const Predicted& predicted) const;

  /// Sum of squares, in standard deviations, by which a fit misses counts against commands beside the nuisances, with
  /// their cost: a lag that all runs share is one surprise, not one a run.
  double counts_misfit(const Fit& fit) const;
  double count_rows() const;
  /// The part of it that is how the robot was driven and read (recording/command_features.h).
  double command_features_misfit(const Predicted& predicted) const;

  /// Grams of residual, nuisances and the given columns; further columns of each run alone are integrated out.
  std::vector<RunGram> grams(const std::vector<Eigen::VectorXd>& residual, const std::vector<Eigen::MatrixXd>& columns,
                             const std::vector<LocalColumns>& local = {}) const;

  /// What a fit leaves of the whitened residual of each run, after the nuisances: those shared, and each run's own.
  std::vector<Eigen::VectorXd> left_over(const Fit& fit) const;

  /// No effect at all.
  Fit none() const;
  /// Another model's fit as this model sees it: the same numbers, with the nuisances as they then are.
  Fit held(Fit fit) const;

  /// Log likelihood that the runs scatter as little as they do, under effects that act by chance, against the noise as
  /// it was estimated: 0 or less. 0 where no runs were repeated.
  double log_chance(const std::vector<Effect>& effects) const;

  /// This model with the signatures of a fit's effects as unsure as they are in another engine and on other tyres: by
  /// part of the course and condition of driving, and from motion to motion.
  Model unsure_of(const Fit& fit) const;
  /// The same with other errors of signatures, as they are given.
  Model unsure_of(const Fit& fit, const ErrorsOf& errors) const;

  /// Log density of the data with a fit's numbers held where they are. `runs`: that count; empty: all.
  double held_density(const Fit& fit, const std::vector<std::size_t>& runs = {}) const;

  /// Log density of the data with the hypotheses' numbers held at p, against none: how well a start would do. `runs`:
  /// that count, and are driven; empty: all.
  double density_at(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& p,
                    const std::vector<std::size_t>& runs = {}) const;

  /// Fits the free numbers of the hypotheses together, in the simulator. `start`: empty for the hypotheses' own.
  /// `runs`: that count; empty: all. `known`: derivatives that were taken elsewhere, and are used as long as they
  /// foretell where a step leads.
  Fit fit(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& start = {},
          const Descending& descending = {}, const std::vector<std::size_t>& runs = {},
          const std::optional<Linearisation>& known = std::nullopt) const;

  /// The fit of all but one of a fit's hypotheses, from their numbers there.
  Fit without(const Fit& fit, std::size_t hypothesis) const;

  /// The numbers of a fit's effects taken from a subset of the runs: by the fit's derivatives, and where the simulator
  /// bends by going on from there.
  Eigen::VectorXd numbers_on(const Fit& fit, const std::vector<std::size_t>& runs) const;

  /// Log evidence over the runs of a subset, of a fit's linearised model.
  double log_evidence(const Fit& fit, const std::vector<std::size_t>& runs) const;

 private:
  struct Descent;  // fit.cpp

  // Of a run, and with five of the recording, which stand with the first run.
  static constexpr int kCountRows = CountsSd::RowsAtCompileTime;
  static constexpr int kFeatureRows = kCountRows + int(std::tuple_size<CommandFeatures>::value);

  void observe();
  std::vector<NoiseModel> noise_of_runs() const;
  void look_without_effects();  // when filters or nuisances are new
  // What an effect does may be off so: nuisances, and further variance of motions. whiten_all() follows.
  void take_as_unsure(const Predicted& with, const SignatureErrors& off, bool commanded = false);
  void add_nuisances(const std::vector<Eigen::MatrixXd>& tracks, const std::vector<Eigen::MatrixXd>& counts,
                     const Eigen::VectorXd& sd);
  void whiten_all();
  void allow_for_ordinary_floors();
  std::vector<Eigen::MatrixXd> products_of_nuisances() const;
  double roughness_under(const std::vector<Effect>& effects) const;
  CountsSd counts_sd(std::size_t run) const;
  CountsColumns alike_in_counts(std::size_t run) const;
  Eigen::VectorXd feature_rows(std::size_t run, const Predicted& a, const Predicted& b) const;
  Linearisation linearised(const Fit& fit) const;
  void take_derivatives(const Fit& at, Descent& d) const;
  void take_derivatives_again(const Fit& at, Descent& d) const;
  Eigen::VectorXd solve(Fit& at, const std::vector<std::size_t>& runs, const Descent& d) const;
  Fit descend(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& start, const Descending& descending,
              const std::vector<std::size_t>& runs, Descent& d, bool sure) const;
  void score(Fit& fit) const;

  const Campaign* campaign_;
  Simulator simulator_;
  Scatter scatter_;
  double step_rad_ = 0;  // between two counts, as wide as they really are
  std::vector<std::vector<Stretch>> stretches_;
  Predicted measured_;  // what was recorded, without tracks
  Predicted without_effects_;
  CommandFeatures features_sd_{};  // with which they are measured
  NominalReplay nominal_;
  std::vector<NoiseEstimate> noises_;  // of each recording; a usual one until it is estimated
  bool replicated_ = false;            // each of them from repeated runs
  double noise_floor_m_ = 0;
  std::vector<TrackFilter> filters_;
  std::vector<Impulses3> further_variance_;  // of single motions, by run
  Nuisances nuisances_;
  std::vector<Eigen::MatrixXd> products_of_nuisances_;  ///< by run: shared, then the run's own
  struct Unmoved {
    std::vector<Eigen::VectorXd> residuals;
    std::vector<RunGram> grams;
  };
  Unmoved unmoved_;                     ///< runs without effects
  mutable long long simulated_ms_ = 0;  ///< threads add to it; whole, so that their order does not show
  mutable std::shared_ptr<const std::vector<PassedPlace>> passed_places_;
  mutable std::array<std::shared_ptr<const std::vector<std::vector<double>>>, 2> noise_m2_;  ///< as it was drawn
};

}  // namespace umbsim::gap

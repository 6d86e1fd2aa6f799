#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gap/evidence/model.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Hypotheses of effects with their whitened derivatives from the nominal robot, so that any of them can be tried on
/// top of any fit by linear algebra.
class Screen {
 public:
  Screen(const Model& model, const std::set<std::string>& excluded);

  struct Candidate {
    Hypothesis hypothesis;
    Eigen::VectorXd start;
    std::vector<Eigen::VectorXd> starts;  ///< where the simulator bends; empty: only `start`
    Eigen::VectorXd reach;                ///< first steps of a search from the best of them; empty: none
    int local_searches = 1;               ///< from how many of the best of them
    bool any_start = false;               ///< searched from, however little the best of them explains
    std::vector<std::size_t> shown_by;    ///< runs that show it most, on which starts are tried first; empty: all
    double gain = 0;                      ///< log evidence expected on top of the fit
    /// Of its numbers against none, were it the only effect asked about (chi-squared); 1 where a hypothesis bends.
    double p_value = 1;
  };
  /// Hypotheses that could explain what `fit` leaves, best first; local ones (places, moments) are searched for anew.
  std::vector<Candidate> on_top_of(const Fit& fit) const;

  /// Those that are chosen, as their derivatives alone say, in the catalogue's order: nothing is simulated.
  std::vector<Candidate> by_derivatives(const Fit& fit, const std::function<bool(const Hypothesis&)>& chosen) const;

  /// Of a fit and a hypothesis that acts in proportion on top of it, whose derivatives were taken at the nominal robot.
  std::optional<Linearisation> near(const Fit& fit, const Hypothesis& hypothesis) const;

  const std::vector<Hypothesis>& hypotheses() const { return hypotheses_; }

 private:
  void simulate_steps();
  void try_start(const Fit& fit, Candidate& c) const;
  void offer_tyres(const Fit& fit, Candidate& c) const;
  void try_frictions(const Fit& fit, Candidate& c) const;
  void offer_local(const Fit& fit, std::vector<Candidate>& candidates) const;

  const Model& model_;
  std::set<std::string> excluded_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<std::pair<int, int>> range_;  // of each hypothesis's columns
  std::vector<Eigen::MatrixXd> columns_;    // per run
  Eigen::VectorXd prior_sd_;
};

/// Those of single effects, best first, that are fitted in the simulator.
std::vector<std::size_t> worth_a_fit(const std::vector<Screen::Candidate>& singles);

/// What the search found, all fitted in the simulator.
struct Found {
  std::vector<Fit> fits;  ///< of no effect, of single effects, and of the combinations that pay
  /// Of effects too small to be told from a difference of engines, and of combinations whose last effect brings less
  /// than it must, but not much less.
  std::vector<Fit> doubtful;
  std::map<std::string, double> p_values;  ///< of single effects that act in proportion, whatever evidence they have
};

/// Forward from single effects, to thresholds.most_effects of them.
Found search(const Model& model, const Screen& screen, const Thresholds& thresholds, const ProgressCallback& progress);

}  // namespace umbsim::gap

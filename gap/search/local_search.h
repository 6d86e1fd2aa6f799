#pragma once

#include <functional>
#include <optional>

#include "gap/search/search.h"

namespace umbsim::gap {

/// Log density of a hypothesis's numbers on top of `base`. Numbers with which the robot cannot be driven are the worst.
/// `base` is copied; `model` must stay. `runs`: that count, and are driven; empty: all.
std::function<double(const Eigen::VectorXd&)> density_on(const Model& model, const Fit& base,
                                                         const Hypothesis& hypothesis,
                                                         const std::vector<std::size_t>& runs = {});

/// The candidate with the best few of its starts alone, best first, of each hill one. All are tried on the few runs
/// that show most, and what does well there on all runs. Returns the best one's log density on top of `base`. Throws
/// nothing for numbers with which the robot cannot be driven: they are the worst.
double keep_best_starts(const Model& model, const Fit& base, Screen::Candidate& candidate);

/// Numbers of the candidate's hypothesis with which a fit on top of `base` begins: the highest of several hills.
/// Nothing where the best start is below `least` of log density: a local search takes many simulations.
std::optional<Eigen::VectorXd> searched_start(const Model& model, const Fit& base, Screen::Candidate candidate,
                                              double least);

/// Where a fit of `base` with one effect more begins, if a place or moment in `base` was fitted to make up for that
/// effect, too: its numbers are searched for anew beside the other, about where they were. `base` holds one such
/// hypothesis; `numbers`: of the effect that comes on top, behind which the rest of `base` stays as it is.
Eigen::VectorXd searched_again(const Model& model, const Fit& base, const Hypothesis& more,
                               const Eigen::VectorXd& numbers);

}  // namespace umbsim::gap

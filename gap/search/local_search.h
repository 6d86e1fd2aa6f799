#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "gap/search/search.h"

namespace umbsim::gap {

/// Log density of a hypothesis's numbers on top of `base`. Numbers with which the robot cannot be driven are the worst.
/// `base` is copied; `model` must stay. `runs`: that count, and are driven; empty: all.
std::function<double(const Eigen::VectorXd&)> density_on(const Model& model, const Fit& base,
                                                         const Hypothesis& hypothesis,
                                                         const std::vector<std::size_t>& runs = {});

/// The same where the hypothesis is driven alone, and what it changes is put on top of `base`: what happens at a place,
/// or where wheels let go, hardly hangs on what else is wrong with the robot, and it was driven without that, too.
std::function<double(const Eigen::VectorXd&)> density_beside(const Model& model, const Fit& base,
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

/// A fit with its place or moment searched for anew about where it is, the numbers of all other effects free: while it
/// was found without them it made up for them. The fit itself where it holds no place, or none does better.
Fit with_place_searched_again(const Model& model, const Fit& fit);

/// Fits that hold one place each, all of them with the place of the best where that makes them better: each search for
/// a place ends at some other top, and which effect stands beside it must not hang on that.
std::vector<Fit> with_the_best_place(const Model& model, std::vector<Fit> fits);

}  // namespace umbsim::gap

#include "gap/output/verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "gap/output/parameter_estimates.h"

namespace umbsim::gap {
namespace {

using Texts = std::vector<std::string>;

constexpr double kNotNear = 0.05;  // share of the squared error below which nothing comes near

int decimals(double mm) { return mm >= 10 ? 0 : mm >= 1 ? 1 : 2; }

double rounded(double mm, int digits) { return std::round(mm * std::pow(10, digits)) / std::pow(10, digits); }

std::string capitalised(std::string text) {
  text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

// "34 of 45 mm", with the digits of what there was.
std::string taken_away(double before_mm, double after_mm) {
  const int digits = decimals(before_mm);
  const double before = rounded(before_mm, digits);
  return fmt::format("{:.{}f} of {:.{}f} mm", before - rounded(after_mm, digits), digits, before, digits);
}

std::string left(double before_mm, double after_mm) { return fmt::format("{:.{}f} mm", after_mm, decimals(before_mm)); }

bool is_effect(const std::string& name) { return name != "none" && name != "unknown"; }

Texts effects_in(const std::string& name) {
  Texts parts;
  for (std::size_t from = 0; from <= name.size();) {
    const std::size_t to = std::min(name.find('+', from), name.size());
    parts.push_back(name.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

std::string noun_of(const std::string& name) {
  if (name == "none") return "no effect at all";
  if (name == "unknown") return "something that the catalogue does not have";
  return words_of(find_effect(name)).noun;
}

Texts some_of(Texts texts) {
  constexpr std::size_t kMost = 4;
  if (texts.size() <= kMost + 1) return texts;
  const std::string more = fmt::format("{} more", texts.size() - kMost);
  texts.resize(kMost);
  texts.push_back(more);
  return texts;
}

// What both an explanation and a rival of it name is not in doubt between them.
Texts without(const Texts& names, const Texts& others) {
  Texts rest;
  std::remove_copy_if(names.begin(), names.end(), std::back_inserter(rest), [&](const std::string& name) {
    return std::find(others.begin(), others.end(), name) != others.end();
  });
  return rest;
}

std::string together(const Texts& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " together with ") + noun_of(name);
  return text;
}

/// A part of the first cause, and what else could do the same.
struct Doubt {
  std::string own;
  Texts rivals;
};

// Of the set and of what is alike by prediction; what no data speak for (an effect that was excluded) stands last.
std::vector<Doubt> doubts(const Diagnosis& d) {
  const Texts own = effects_in(d.causes.front().name);
  const std::string it = own.size() > 1 ? "them" : "it";
  std::vector<Doubt> all;
  const auto add = [&](const std::string& part, const std::string& rival) {
    auto at = std::find_if(all.begin(), all.end(), [&](const Doubt& doubt) { return doubt.own == part; });
    if (at == all.end()) at = all.insert(all.end(), {part, {}});
    if (std::find(at->rivals.begin(), at->rivals.end(), rival) == at->rivals.end()) at->rivals.push_back(rival);
  };
  const auto part_of = [&](const Texts& part) { return part.size() == own.size() ? it : together(part); };
  for (const std::string& name : d.set) {
    if (name == d.causes.front().name) continue;
    const Texts rival = effects_in(name);
    const Texts mine = without(own, rival);
    const Texts theirs = without(rival, own);
    if (mine.empty())
      add(it + " alone", together(theirs) + " beside " + it);
    else
      add(part_of(mine), theirs.empty() ? "nothing of the kind" : together(theirs));
  }
  for (const Texts& group : d.indistinguishable) {
    for (std::size_t i = 1; i < group.size(); ++i) add(part_of({group.front()}), noun_of(group[i]));
  }
  return all;
}

Texts sentences(const Diagnosis& d) {
  const Cause& first = d.causes.front();
  const std::vector<ParameterEstimate> estimates = parameter_estimates(first, d);
  Texts all;
  for (const std::string& name : effects_in(first.name)) {
    std::vector<FoundParameter> numbers;
    std::map<std::string, std::string> facts;
    bool at_place = false;
    for (const ParameterEstimate& e : estimates) {
      if (e.effect != name) continue;
      numbers.push_back(found(e));
      at_place = at_place || (e.parameter == "x_m" && e.value == d.place_m[0]);
    }
    if (at_place) facts["wheel"] = d.place_wheel;
    for (const Effect& e : first.fit.effects()) {
      if (e.info->name == name) facts["run"] = e.values.run;
    }
    all.push_back(capitalised(found_sentence(find_effect(name), numbers, facts)) + ".");
  }
  return all;
}

std::string mostly(const Diagnosis& d) { return d.left_over.where.empty() ? "" : ", mostly " + d.left_over.where; }

std::string gap_text(const Diagnosis& d) {
  return fmt::format("the scenario is off by {} along the runs, and run-to-run noise alone makes {}",
                     millimetres(d.before_mm), millimetres(d.noise_floor_mm));
}

// Where no condition could be held out.
std::string worth_on_these_runs(const Diagnosis& d, const std::string& it) {
  const double after_mm = d.before_mm * std::sqrt(std::max(0.0, 1 - d.causes.front().squared_error_drop));
  return fmt::format(
      "On these very runs {} away {}; how much it would be on others is not known, for all were driven "
      "alike.",
      it, taken_away(d.before_mm, after_mm));
}

// Of causes that move no pose.
std::string shown_by_counts(const Diagnosis& d) {
  const auto& hypotheses = d.causes.front().fit.hypotheses;
  const bool counts =
      std::all_of(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& h) { return shows_in_counts(h); });
  return counts ? " It shows in what the wheels count against their commands." : "";
}

std::string worth(const Diagnosis& d) {
  const bool several = d.causes.front().fit.hypotheses.size() > 1;
  const std::string it = several ? "together they take" : "that takes";
  const Closure& c = d.closure;
  if (c.before_mm == 0) return worth_on_these_runs(d, it);
  if (!c.known && c.before_mm <= c.most_noise_mm)
    return "No track strays by more than noise makes it: there is nothing to take away." + shown_by_counts(d);
  if (!c.known || c.after_mm == c.before_mm) {
    if (!d.twin_is_nominal() && d.not_fitted)
      return "What it does to each run cannot be reproduced: the twin goes without.";
    return fmt::format("But {} nothing away on runs that were held out{}.", it,
                       d.twin_is_nominal() ? ": the twin goes without" : "") +
           shown_by_counts(d);
  }
  std::string text =
      fmt::format("{} away {} on runs that were held out.", capitalised(it), taken_away(c.before_mm, c.after_mm));
  const std::string rest = left(c.before_mm, c.after_mm);
  if (c.after_mm <= c.most_noise_mm)
    return text + fmt::format(" The {} that remain are no more than noise makes.", rest);
  return text + fmt::format(" {} remain unexplained{}, where noise alone makes {}.", rest, mostly(d),
                            left(c.before_mm, c.floor_mm));
}

// What goes with effective dimensions: creep of the tyres that scrub.
Texts goes_with(const EffectiveTwin& twin) {
  Texts texts;
  Eigen::Index first = 0;
  for (const Hypothesis& h : twin.fit.hypotheses) {
    const Eigen::VectorXd p = twin.fit.p.segment(first, Eigen::Index(h.parameters.size()));
    first += p.size();
    const bool dimension = std::find(twin.dimensions.begin(), twin.dimensions.end(), h.effect) != twin.dimensions.end();
    if (!dimension || !h.with) continue;
    for (const Effect& e : h.with(p)) {
      std::vector<FoundParameter> known;
      for (std::size_t i = 0; i < e.values.numbers.size(); ++i) {
        const double value = e.values.numbers[i];
        known.push_back({e.info->parameters[i].name, value, value, value});
      }
      texts.push_back(found_sentence(*e.info, known));
    }
  }
  return texts;
}

// Radii and a wheelbase, or a scrub, that are no cause and foretell what the causes leave.
std::string effective(const Diagnosis& d) {
  if (!d.effective) return "";
  Texts dimensions;
  for (const ParameterEstimate& e : effective_dimensions(d))
    dimensions.push_back(found_sentence(find_effect(e.effect), {found(e)}));
  for (const std::string& text : goes_with(*d.effective)) dimensions.push_back(text);
  const auto& [names, fit, closure] = *d.effective;
  const bool instead = fit.hypotheses.size() == names.size() && is_effect(d.causes.front().name);
  return fmt::format(
      " In the twin, {}{}. That is no cause, but what a calibration would find: with it {} of {} remain on runs that "
      "were held out.",
      listed(dimensions, "and"), instead ? ", in place of what is named" : "",
      left(closure.before_mm, closure.after_mm), left(closure.before_mm, closure.before_mm));
}

std::string ties_text(const Diagnosis& d, const std::vector<NextExperiment>& next) {
  Texts parts;
  for (const Doubt& doubt : doubts(d)) parts.push_back(doubt.own + " from " + listed(some_of(doubt.rivals), "or"));
  if (parts.empty()) return "";
  std::string text = fmt::format(" These runs cannot tell {}.", fmt::join(parts, ", nor "));
  if (next.empty()) text += " No kind of run that the diagnosis knows is expected to.";
  return text;
}

std::string next_text(const std::vector<NextExperiment>& next) {
  return next.empty() ? "" : fmt::format(" Next, to tell them apart, drive: {}.", next.front().run);
}

std::string no_gap(const Diagnosis& d) {
  std::string text = fmt::format("No gap beyond noise is proved: {}.", gap_text(d));
  Texts others;
  for (const std::string& name : d.set) {
    if (is_effect(name)) others.push_back(together(effects_in(name)));
  }
  if (others.empty()) return text;
  return text + fmt::format(" Too small to be proved by these runs, but possible: {}.", listed(some_of(others), "or"));
}

std::string unknown(const Diagnosis& d) {
  std::string text = fmt::format("No effect of the catalogue explains the gap: {}.", gap_text(d));
  const auto nearest = std::find_if(d.causes.begin(), d.causes.end(),
                                    [](const Cause& c) { return is_effect(c.name) && !c.fit.hypotheses.empty(); });
  if (nearest == d.causes.end() || nearest->squared_error_drop < kNotNear) {
    return text + fmt::format(" Nothing in it comes near. The gap sits {}.",
                              d.left_over.where.empty() ? "in no part of the runs more than in others"
                                                        : "mostly " + d.left_over.where);
  }
  if (!d.twin_is_nominal() && d.closure.known) {
    const Closure& c = d.closure;
    return text + fmt::format(
                      " What comes nearest is {}: that takes away {} on runs that were held out, and the twin "
                      "holds it; {} remain{}.",
                      together(effects_in(d.twin.name())), taken_away(c.before_mm, c.after_mm),
                      left(c.before_mm, c.after_mm), mostly(d));
  }
  const double after_mm = d.before_mm * std::sqrt(1 - nearest->squared_error_drop);
  return text + fmt::format(" What comes nearest is {}, with {} on these very runs; {} would remain{}.",
                            together(effects_in(nearest->name)), taken_away(d.before_mm, after_mm),
                            left(d.before_mm, after_mm), mostly(d));
}

}  // namespace

std::string millimetres(double mm) { return fmt::format("{:.{}f} mm", mm, decimals(mm)); }

std::string listed(const Texts& texts, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) text += i + 1 == texts.size() ? fmt::format(" {} ", last) : ", ";
    text += texts[i];
  }
  return text;
}

std::string verdict(const Diagnosis& d, const std::vector<NextExperiment>& next) {
  if (!d.detected) return no_gap(d) + next_text(next);
  if (!is_effect(d.causes.front().name)) return unknown(d) + effective(d) + next_text(next);
  std::string text;
  for (const std::string& sentence : sentences(d)) text += sentence + " ";
  return text + worth(d) + ties_text(d, next) + effective(d) + next_text(next);
}

}  // namespace umbsim::gap

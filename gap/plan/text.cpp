#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "core/text/wrapped_text.h"
#include "gap/plan/json.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kNameWidth = 24;
constexpr std::size_t kPairsShown = 20;

// The matrix in per cent: rows what is wrong, columns by number what would be named, the last one "none". A block of
// columns at a time, as many as fit.
std::string matrix_text(const Race& race) {
  const std::size_t n = race.effects.size();
  const std::size_t before = kNameWidth + 5;
  const std::size_t most = (kColumns - before) / 5;
  std::string text;
  for (std::size_t from = 0; from <= n; from += most) {
    const std::size_t to = std::min(from + most, n + 1);
    text += fitted("what is wrong  \\  named, %", before);
    for (std::size_t j = from; j < to; ++j) text += fmt::format("{:>5}", j == n ? "none" : std::to_string(j + 1));
    text += "\n";
    for (std::size_t i = 0; i < n; ++i) {
      text += fmt::format("{:>3}  {}", i + 1, fitted(race.effects[i], kNameWidth));
      for (std::size_t j = from; j < to; ++j) {
        const double percent = 100 * race.named(Eigen::Index(i), Eigen::Index(j));
        text += percent < 0.5 ? fmt::format("{:>5}", ".") : fmt::format("{:>5.0f}", percent);
      }
      text += "\n";
    }
  }
  return text;
}

// Pairs that are mistaken for each other, most often first.
std::string mistaken_text(const Separation& s) {
  auto pairs = s.alike;
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (std::size_t i = 0; i < pairs.size() && i < kPairsShown; ++i) {
    const auto& [pair, probability] = pairs[i];
    text += wrapped(
        fmt::format("  {} and {} are mistaken for each other in {:.0f} %", pair.first, pair.second, 100 * probability),
        4);
  }
  if (pairs.size() > kPairsShown)
    text += fmt::format("  and {} more pairs, see plan.json\n", pairs.size() - kPairsShown);
  return text;
}

// What cannot show whatever is driven is said once, with the severities.
std::string separation_text(const Separation& s, const std::vector<std::string>& hopeless) {
  std::string text;
  for (const auto& group : s.groups) text += wrapped(fmt::format("  not told apart: {}", fmt::join(group, ", ")), 4);
  std::vector<std::string> unseen;
  std::copy_if(s.not_shown.begin(), s.not_shown.end(), std::back_inserter(unseen), [&](const std::string& effect) {
    return std::find(hopeless.begin(), hopeless.end(), effect) == hopeless.end();
  });
  if (!unseen.empty()) text += wrapped(fmt::format("  not shown at all: {}", fmt::join(unseen, ", ")), 4);
  const std::size_t n = s.race.effects.size();
  return text + fmt::format("  {} of {} pairs of effects are shown and told apart\n", s.separated, n * (n - 1) / 2);
}

std::string step_text(const PlanStep& step, const PlanContext& context, std::size_t number) {
  constexpr std::size_t kFew = 4;
  std::string text =
      fmt::format("  {}. {} ({:.0f} s)", number, context.labels[step.run], context.durations_s[step.run]);
  if (!step.separates.empty()) {
    text += fmt::format(": {} more pair{}", step.separates.size(), step.separates.size() == 1 ? "" : "s");
  }
  if (!step.shows.empty()) text += fmt::format("; shows {}", fmt::join(step.shows, ", "));
  if (step.separates.size() <= kFew) {
    for (const Pair& p : step.separates) text += fmt::format("; {} from {}", p.first, p.second);
  }
  return wrapped(text, 5);
}

std::string steps_text(const Recommendation& r, const PlanContext& context) {
  std::string text;
  double duration_s = 0;
  for (std::size_t i = 0; i < r.steps.size(); ++i) {
    duration_s += context.durations_s[r.steps[i].run];
    text += step_text(r.steps[i], context, i + 1);
  }
  return text +
         fmt::format("  {} run{}, {:.0f} s of driving\n", r.steps.size(), r.steps.size() == 1 ? "" : "s", duration_s);
}

std::string weak_text(const Plan& plan, const std::vector<std::string>& hopeless) {
  std::string text;
  for (const auto& [effect, severity] : plan.weak) {
    if (std::find(hopeless.begin(), hopeless.end(), effect) != hopeless.end()) continue;
    text += wrapped(fmt::format("  {}: the most that is plausible is {:.2g} noise floors here", effect, severity), 4);
  }
  if (!hopeless.empty()) {
    text += wrapped(fmt::format("  cannot show in these runs at any plausible size: {}", fmt::join(hopeless, ", ")), 4);
  }
  return text;
}

}  // namespace

std::string plan_text(const Plan& plan, const PlanContext& context, const PlanOptions& options, bool matrix) {
  std::vector<std::string> hopeless;
  for (const auto& [effect, severity] : plan.weak) {
    if (severity < options.least) hopeless.push_back(effect);
  }
  std::string text =
      wrapped(context.title) +
      fmt::format("Before any data: effects of {} noise floors in these {} runs\n", options.severity, context.given);
  text += matrix ? matrix_text(plan.given.race) : mistaken_text(plan.given);
  text += separation_text(plan.given, hopeless) + weak_text(plan, hopeless);
  if (!plan.no_hypothesis.empty()) {
    text += wrapped(fmt::format("  no model of the diagnosis names: {}", fmt::join(plan.no_hypothesis, ", ")), 4);
  }
  text += "Shortest set of runs of the menu that separates them\n" + steps_text(plan.from_nothing, context) +
          separation_text(plan.from_nothing.result, hopeless);
  text += "Runs of the menu on top of these\n";
  if (plan.further.steps.empty())
    text += "  none separates more\n";
  else
    text += steps_text(plan.further, context) + separation_text(plan.further.result, hopeless);
  for (const std::string& limit : context.limits) text += wrapped("Limit: " + limit);
  return text;
}

}  // namespace umbsim::gap

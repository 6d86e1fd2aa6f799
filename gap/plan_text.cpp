#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gap/plan_json.h"

namespace umbsim::gap {
namespace {

constexpr int kNameWidth = 24;

// The matrix in per cent: rows what is wrong, columns by number what would be named, the last one "none".
std::string confusion_text(const Race& race) {
  std::string text = fmt::format("{:{}}", "what is wrong  \\  named, %", kNameWidth + 5);
  const std::size_t n = race.effects.size();
  for (std::size_t j = 0; j < n; ++j) text += fmt::format("{:>4}", j + 1);
  text += " none\n";
  for (std::size_t i = 0; i < n; ++i) {
    text += fmt::format("{:>3}  {:{}}", i + 1, race.effects[i], kNameWidth);
    for (std::size_t j = 0; j <= n; ++j) {
      const double percent = 100 * race.named(Eigen::Index(i), Eigen::Index(j));
      text += percent < 0.5 ? fmt::format("{:>4}", ".") : fmt::format("{:>4.0f}", percent);
    }
    text += "\n";
  }
  return text;
}

std::string separation_text(const Separation& s) {
  std::string text;
  for (const auto& group : s.groups) text += fmt::format("  not told apart: {}\n", fmt::join(group, ", "));
  if (!s.not_shown.empty()) text += fmt::format("  not shown at all: {}\n", fmt::join(s.not_shown, ", "));
  const std::size_t n = s.race.effects.size();
  text += fmt::format("  {} of {} pairs of effects are shown and told apart\n", s.separated, n * (n - 1) / 2);
  return text;
}

std::string steps_text(const Recommendation& r, const PlanContext& context) {
  std::string text;
  double duration_s = 0;
  for (std::size_t i = 0; i < r.steps.size(); ++i) {
    const PlanStep& step = r.steps[i];
    duration_s += context.durations_s[step.run];
    text += fmt::format("  {}. {} ({:.0f} s): {} more pairs", i + 1, context.labels[step.run],
                        context.durations_s[step.run], step.separates.size());
    if (!step.shows.empty()) text += fmt::format("; shows {}", fmt::join(step.shows, ", "));
    constexpr std::size_t kFew = 4;
    if (!step.separates.empty() && step.separates.size() <= kFew) {
      for (const Pair& p : step.separates) text += fmt::format("; {} from {}", p.first, p.second);
    }
    text += "\n";
  }
  return text + fmt::format("  {} runs, {:.0f} s of driving\n", r.steps.size(), duration_s);
}

}  // namespace

std::string plan_text(const Plan& plan, const PlanContext& context, const PlanOptions& options) {
  std::string text = fmt::format("{}\nBefore any data: effects of {} noise floors in these {} runs\n{}", context.title,
                                 options.severity, context.given, confusion_text(plan.given.race));
  text += separation_text(plan.given);
  for (const auto& [effect, severity] : plan.weak) {
    text += fmt::format("  {}: the most that is plausible is {:.2g} noise floors here\n", effect, severity);
  }
  if (!plan.no_family.empty()) {
    text += fmt::format("  no model of the diagnosis names: {}\n", fmt::join(plan.no_family, ", "));
  }
  text += "Shortest set of runs of the menu that separates them\n" + steps_text(plan.from_nothing, context) +
          separation_text(plan.from_nothing.result);
  text += "Runs of the menu on top of these\n";
  if (plan.further.steps.empty()) text += "  none separates more\n";
  else text += steps_text(plan.further, context) + separation_text(plan.further.result);
  for (const std::string& limit : context.limits) text += "Limit: " + limit + "\n";
  return text;
}

}  // namespace umbsim::gap

#include "gap/output/diagnosis_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text/wrapped_text.h"
#include "gap/output/parameter_estimates.h"
#include "gap/output/verdict.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kCausesShown = 5;
constexpr std::size_t kBelow = 11;  // the percentage

// Each number by its effect, in the order of the effects' names; those that stayed neutral are left out.
std::string numbers_text(const Cause& cause, const Diagnosis& d) {
  std::map<std::string, std::vector<std::string>> by_effect;
  for (const ParameterEstimate& e : parameter_estimates(cause, d)) {
    if (const std::string text = shown_text(e); !text.empty()) by_effect[e.effect].push_back(text);
  }
  for (const Effect& e : cause.fit.effects()) {
    const auto there = by_effect.find(e.info->name);
    if (e.info->one_run && there != by_effect.end()) there->second.push_back("in " + e.values.run);
  }
  std::string text;
  for (const auto& [effect, numbers] : by_effect) {
    text += wrapped(fmt::format("{:{}}{}: {}", "", kBelow, effect, fmt::join(numbers, ", ")), kBelow + 2);
  }
  return text;
}

std::string causes_text(const Diagnosis& d) {
  std::string text = "Which, with 95 % intervals:\n";
  for (std::size_t i = 0; i < d.causes.size() && i < kCausesShown; ++i) {
    const Cause& c = d.causes[i];
    std::string name = c.name;
    for (std::size_t at = 0; (at = name.find('+', at)) != std::string::npos; at += 3) name.replace(at, 1, " + ");
    text += wrapped(fmt::format("  {:5.1f} %  {}", 100 * c.probability, name), kBelow);
    if (c.name != "unknown" && c.name != "none") text += numbers_text(c, d);
  }
  return text;
}

std::string where_text(const Diagnosis& d) {
  std::string text = fmt::format("Where: stage {}, pattern {}", d.stage, d.pattern.empty() ? "undecided" : d.pattern);
  if (d.has_place) text += fmt::format(", at ({:.2f}, {:.2f}) m", d.place_m[0], d.place_m[1]);
  return wrapped(text);
}

std::string closure_text(const Closure& c) {
  return wrapped(fmt::format(
      "How far: held-out closure {:.1f} % ({:.1f} to {:.1f} %), {:.1f} mm -> {:.1f} mm, "
      "{:.3f} deg -> {:.3f} deg",
      100 * c.fraction, 100 * c.ci95[0], 100 * c.ci95[1], c.before_mm, c.after_mm, c.before_deg, c.after_deg));
}

std::string remainder_text(const Diagnosis& d) {
  const Remainder& rest = d.remainder;
  std::string text =
      fmt::format("Remainder: {} ({:.0f} % of the squared error beyond noise)", millimetres(rest.mm), 100 * rest.share);
  if (rest.pattern.empty()) return text;
  return text + fmt::format("; an effect of the catalogue with the pattern '{}' could take {} of it", rest.pattern,
                            rest.in_catalogue ? "most" : "a small part");
}

std::string found_text(const Diagnosis& d, const std::vector<NextExperiment>& next) {
  const std::string off = fmt::format("the scenario is off by {:.1f} mm;", d.before_mm);
  std::string text = d.in_poses
                         ? fmt::format("Gap: {} run-to-run noise makes {:.1f} mm.\n", off, d.noise_floor_mm)
                         : fmt::format("No gap in the poses: {} noise makes {:.1f} mm.\n", off, d.noise_floor_mm);
  text += where_text(d) + causes_text(d) + wrapped(fmt::format("Not told apart: {}", fmt::join(d.set, ", ")));
  for (const auto& group : d.indistinguishable)
    text += wrapped(fmt::format("Alike in these runs: {}", fmt::join(group, ", ")));
  for (const NextExperiment& n : next)
    text += wrapped(fmt::format("Next: {} separates {}", n.run, fmt::join(n.separates, ", ")));
  if (d.unexplained && !d.left_over.description.empty()) text += wrapped("Left over: " + d.left_over.description);
  text += wrapped(remainder_text(d));
  return d.closure.known ? text + closure_text(d.twin_closure()) : text;
}

std::string nothing_text(const Diagnosis& d) {
  std::string text = fmt::format("No gap is proved beyond the noise (floor {:.1f} mm, scenario off by {:.1f} mm).\n",
                                 d.noise_floor_mm, d.before_mm);
  if (d.set.size() > 1) text += wrapped(fmt::format("Not told apart: {}", fmt::join(d.set, ", ")));
  return text;
}

}  // namespace

std::string diagnosis_text(const Diagnosis& d, const std::vector<NextExperiment>& next) {
  std::string text = d.detected ? found_text(d, next) : nothing_text(d);
  for (const std::string& limit : d.limits) text += wrapped("Limit: " + limit);
  return text + "\n" + wrapped(verdict(d, next), 0) + "\n";
}

}  // namespace umbsim::gap

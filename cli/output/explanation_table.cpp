#include <fmt/format.h>

#include "cli/output/tables.h"
#include "core/text/wrapped_text.h"

namespace umbsim {
namespace {

std::string cells(const Contribution& c) {
  return fmt::format("{:>11.3f}{:>11.3f}{:>11.3f}{:>10.4f}", c.x_m * 1000, c.y_m * 1000, c.distance_m() * 1000,
                     degrees(c.heading_rad));
}

std::string line(const std::string& label, const Contribution& c) {
  constexpr std::size_t kLabel = 28;
  return fmt::format("  {}{}\n", fitted(label, kLabel), cells(c));
}

std::string header(const std::string& title) {
  return fmt::format("  {:<28}{:>11}{:>11}{:>11}{:>10}\n", title, "x mm", "y mm", "r mm", "heading");
}

std::string direction_table(const Explanation& e, Direction d) {
  std::string text = fmt::format("{}\n", name(d)) + header("each effect alone");
  for (const ExplainedEffect& effect : e.effects) text += line(effect.name, effect.alone.at(d));
  text += header("missed if it is left out");
  for (const ExplainedEffect& effect : e.effects) text += line(effect.name, effect.missed.at(d));
  text += header("together") + line("sum of the effects alone", e.sum_alone.at(d)) +
          line("their interaction", e.interaction.at(d)) + line("without any effect", e.baseline.at(d)) +
          line("the scenario", e.whole.at(d));
  return text;
}

}  // namespace

std::string explanation_table(const Scenario& scenario, const Explanation& e) {
  std::string text = wrapped(fmt::format("{}: what each effect does to the return error (mm, degrees)", scenario.name));
  for (const auto& [direction, whole] : e.whole) text += direction_table(e, direction);
  if (e.effects.empty()) text += "  The scenario has no effects; add some under `effects:`, or with --set.\n";
  return text;
}

}  // namespace umbsim

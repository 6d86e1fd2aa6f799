#include <fmt/format.h>

#include "cli/tables.h"

namespace umbsim {
namespace {

std::string cells(const Contribution& c) {
  return fmt::format("{:>11.3f}{:>11.3f}{:>11.3f}{:>10.4f}", c.x_m * 1000, c.y_m * 1000, c.distance_m() * 1000,
                     degrees(c.heading_rad));
}

std::string line(const char* label, const Contribution& c) { return fmt::format("  {:<28}{}\n", label, cells(c)); }

std::string direction_table(const Explanation& e, Direction d) {
  constexpr const char* kColumns = "       x mm       y mm       r mm   heading";
  std::string text = fmt::format("{}\n  {:<28}{:^43}  {:^43}\n  {:<28}{}  {}\n", name(d), "", "alone",
                                 "missed if left out", "effect", kColumns, kColumns);
  for (const ExplainedEffect& effect : e.effects) {
    text += fmt::format("  {:<28}{}  {}\n", effect.name, cells(effect.alone.at(d)), cells(effect.missed.at(d)));
  }
  text += line("sum of the effects alone", e.sum_alone.at(d)) + line("their interaction", e.interaction.at(d)) +
          line("without any effect", e.baseline.at(d)) + line("the scenario", e.whole.at(d));
  return text;
}

}  // namespace

std::string explanation_table(const Scenario& scenario, const Explanation& e) {
  std::string text = fmt::format("{}: what each effect does to the return error (mm, degrees)\n", scenario.name);
  for (const auto& [direction, whole] : e.whole) text += direction_table(e, direction);
  if (e.effects.empty()) text += "  The scenario has no effects; add some under `effects:`, or with --set.\n";
  return text;
}

}  // namespace umbsim

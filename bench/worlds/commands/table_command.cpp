#include <fmt/format.h>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/engines/engine.h"
#include "bench/worlds/world/outside.h"

namespace umbsim::worlds {
namespace {

void print_engines() {
  fmt::print("## Engines\n");
  for (const EngineKind& kind : engines()) {
    fmt::print("\n**{}**: {}\n\n| option | from | to | |\n|---|---|---|---|\n", kind.name, kind.text);
    for (const EngineOption& o : kind.options) {
      if (o.draw == EngineOption::Draw::choice) {
        std::string choices;
        for (const std::string& c : o.choices) choices += (choices.empty() ? "" : ", ") + c;
        fmt::print("| {} | {} | | {} |\n", o.name, choices, o.text);
      } else {
        fmt::print("| {} ({}) | {} | {} | {} |\n", o.name, o.unit, o.min, o.max, o.text);
      }
    }
  }
}

void print_catalogue() {
  fmt::print("\n## The catalogue's effects, as physics in each engine\n\n| effect |");
  for (const EngineKind& kind : engines()) fmt::print(" {} |", kind.name);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < engines().size(); ++i) fmt::print("---|");
  for (const EffectInfo& info : catalogue()) {
    fmt::print("\n| {} |", info.name);
    for (const EngineKind& kind : engines()) {
      const auto how = kind.expresses.find(info.name);
      fmt::print(" {} |", how == kind.expresses.end() ? "not expressed, never drawn" : how->second);
    }
  }
}

void print_outside() {
  fmt::print(
      "\n\n## Effects outside the catalogue, in every engine\n\n| effect | strength | from | to | |\n"
      "|---|---|---|---|---|\n");
  for (const OutsideInfo& info : outside_effects()) {
    fmt::print("| {} | {} ({}) | {} | {} | {} |\n", info.name, info.parameter, info.unit, info.plausible.min,
               info.plausible.max, info.text);
  }
}

}  // namespace

void add_table_command(CLI::App& app) {
  app.add_subcommand("table", "Engines with their options, and how each effect is physics in each of them")
      ->callback([] {
        print_engines();
        print_catalogue();
        print_outside();
      });
}

}  // namespace umbsim::worlds

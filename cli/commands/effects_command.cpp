#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/help/help.h"
#include "core/text/wrapped_text.h"
#include "effects/catalogue.h"

namespace umbsim {
namespace {

void list_effects() {
  for (const EffectInfo& info : catalogue()) {
    fmt::print("{}", wrapped(fmt::format("{:<26}{:<12}{}", info.name, name(info.stage), info.text.description), 38));
  }
}

void show_effect(const EffectInfo& info) {
  const EffectText& t = info.text;
  std::string text =
      fmt::format("{} ({})\n  {}\n  lecture:       {}\n  source:        {}\n  in the data:   {}\n  confused with: {}\n",
                  info.name, name(info.stage), t.description, t.lecture, t.source, t.signature, t.confused_with);
  for (const EffectParameter& p : info.parameters) {
    text += fmt::format("  {} [{}]: neutral {}, plausible {} to {}, allowed: {}\n", p.name, p.unit, p.neutral,
                        p.plausible_min, p.plausible_max, p.bounds.text());
  }
  if (info.one_run) text += "  run [id]: the run that it happens in, as in cw-1; empty: every run\n";
  fmt::print("{}", wrapped_lines(text, 17));
}

}  // namespace

void add_effects_command(CLI::App& app) {
  const auto wanted = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("effects", "List the catalogue of effects, or describe one");
  command->add_option("name", *wanted, "Effect to describe");
  add_example(command, "umbsim effects wheelbase");
  command->callback([wanted] {
    if (wanted->empty())
      list_effects();
    else
      show_effect(find_effect(*wanted));
  });
}

}  // namespace umbsim

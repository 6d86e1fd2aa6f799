#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/learn/learn.h"
#include "core/error.h"

namespace umbsim::worlds {
namespace {

struct Arguments {
  std::vector<std::string> folders;
  std::vector<std::string> without;
  int jobs = 0;
};

void learn(const Arguments& a) {
  std::vector<CaseShares> cases;
  for (const std::string& folder : a.folders) {
    for (CaseShares& c : look_at_cases(TrialFolder(folder), a.jobs)) {
      if (std::count(a.without.begin(), a.without.end(), c.engine) == 0) cases.push_back(std::move(c));
    }
  }
  fmt::print("// {:24} speeding leg    in place arc    motion counts\n", "effect");
  for (const auto& [effect, learned] : learned_by_effect(cases)) {
    const gap::SignatureErrors& e = learned.errors;
    fmt::print("{{\"{}\", {:{}}{{{{{:.3f}, {:.3f}, {:.3f}, {:.3f}}}, {:.2f}, {:.3f}}}}},  // {} cases, gain {:.0f}\n", effect,
               "", 24 - std::min<std::size_t>(24, effect.size()), e.parts[0], e.parts[1], e.parts[2], e.parts[3],
               e.motion, e.counts, learned.cases, learned.gain);
  }
}

}  // namespace

void add_learn_command(CLI::App& app) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "learn", "By how much each effect's signature is off in other engines: gap/traits/signature_errors.inc");
  command->add_option("folders", a->folders, "Folders of worlds, drawn and sealed")->required();
  command->add_option("--without", a->without, "Engine that nothing is learned from (repeatable)")
      ->allow_extra_args(false);
  command->add_option("-j,--jobs", a->jobs, "Cases at the same time; 0: one per core")->check(CLI::Range(0, 1024));
  command->callback([a] { learn(*a); });
}

}  // namespace umbsim::worlds

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/learn/learn.h"
#include "gap/trial/write/seal.h"

namespace umbsim::worlds {
namespace {

struct LearnArguments {
  std::vector<std::string> folders;
  std::vector<std::string> without;
  std::string out;
  int jobs = 0;
};

// A row of the table, in the form of gap/traits/signature_errors.cpp.
std::string row(const std::string& effect, const LearnedErrors& learned) {
  const gap::SignatureErrors& e = learned.errors;
  return fmt::format("{{\"{}\", {{{{{}, {}, {}, {}}}, {}, {}}}}},  // {} cases, gain {:.0f}\n", effect, e.parts[0],
                     e.parts[1], e.parts[2], e.parts[3], e.motion, e.counts, learned.cases, learned.gain);
}

void learn(const LearnArguments& a) {
  std::vector<CaseShares> cases;
  std::map<std::string, int> engines;
  int refused = 0;
  std::string table =
      "// Written by `umbsim_worlds learn` (docs/worlds.md), from folders whose answers have these hashes:\n";
  for (const std::string& folder : a.folders) {
    const TrialFolder worlds(folder);
    table += fmt::format("// {} {}\n", read_seal(worlds).value_or("not sealed"), folder);
    SharesFound found = look_at_cases(worlds, a.jobs);
    refused += found.refused;
    for (CaseShares& c : found.cases) {
      if (std::count(a.without.begin(), a.without.end(), c.engine) > 0) continue;
      ++engines[c.engine];
      cases.push_back(std::move(c));
    }
  }
  for (const auto& [engine, count] : engines) table += fmt::format("// {} cases in {}\n", count, engine);
  table += "// effect, speeding, leg, in place, arc; motion; counts\n";
  for (const auto& [effect, learned] : learned_by_effect(cases)) table += row(effect, learned);
  if (a.out.empty()) {
    fmt::print("{}", table);
  } else {
    write_file_whole(a.out, table);
  }
  if (refused > 0) fmt::print(stderr, "{} recordings that a diagnosis refuses are left out\n", refused);
}

}  // namespace

void add_learn_command(CLI::App& app) {
  const auto a = std::make_shared<LearnArguments>();
  CLI::App* command = app.add_subcommand(
      "learn", "By how much each effect's signature is off in other engines, from worlds whose answers are known");
  command->add_option("folders", a->folders, "Folders of worlds, drawn and sealed")->required();
  command->add_option("--without", a->without, "Engine that nothing is learned from (repeatable)")
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"ours", "planar", "bullet", "mujoco"}));
  command->add_option("-o,--out", a->out, "File of the table; default: it is printed");
  command->add_option("-j,--jobs", a->jobs, "Cases at the same time; 0: one per core")->check(CLI::Range(0, 1024));
  command->callback([a] { learn(*a); });
}

}  // namespace umbsim::worlds

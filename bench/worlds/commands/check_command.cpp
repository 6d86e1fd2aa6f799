#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/run/compare.h"
#include "core/progress.h"

namespace umbsim::worlds {
namespace {

struct CheckArguments {
  double severity = 3;
  std::uint64_t seed = 1;
  std::vector<std::string> effects;
};

std::string cell(const ComparedEffect& e, const std::string& engine) {
  for (const Compared& c : e.engines) {
    if (c.engine != engine) continue;
    return c.error.empty() ? fmt::format("{:.3f} ({:.3f})", c.ratio, c.alike) : c.error;
  }
  return "not expressed";
}

void run_check(const CheckArguments& a) {
  std::vector<std::string> names = a.effects;
  if (names.empty()) {
    for (const EffectInfo& info : catalogue()) names.push_back(info.name);
  }
  for (const std::string& n : names) find_effect(n);
  std::vector<ComparedEffect> compared(names.size());
  Progress progress("effects in every engine", int(names.size()));
  tbb::parallel_for(std::size_t(0), names.size(), [&](std::size_t i) {
    compared[i] = compare(names[i], a.severity, a.seed);
    progress.step();
  });
  fmt::print("| effect | noise floors here, signal |");
  std::string rule = "|---|---|";
  std::vector<std::string> others;
  for (const EngineKind& kind : engines()) {
    if (kind.name == "ours") continue;
    others.push_back(kind.name);
    fmt::print(" {} |", kind.name);
    rule += "---|";
  }
  fmt::print("\n{}\n", rule);
  for (const ComparedEffect& e : compared) {
    fmt::print("| {} | {:.1f}, {} |", e.effect, e.severity, name(e.signal));
    for (const std::string& engine : others) fmt::print(" {} |", cell(e, engine));
    fmt::print("\n");
  }
}

}  // namespace

void add_check_command(CLI::App& app) {
  const auto a = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Every effect in every engine, as a share of what it does in this simulator (and how alike)");
  command->add_option("effects", a->effects, "Effects of the catalogue; default: all");
  command->add_option("--severity", a->severity, "Noise floors in this simulator")->capture_default_str();
  command->add_option("--seed", a->seed, "Of signs and places")->capture_default_str();
  command->callback([a] { run_check(*a); });
}

}  // namespace umbsim::worlds

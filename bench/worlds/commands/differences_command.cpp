#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <fstream>
#include <memory>

#include "bench/worlds/checks/difference_picture.h"
#include "bench/worlds/checks/differences.h"
#include "bench/worlds/commands/commands.h"
#include "core/error.h"
#include "core/progress.h"

namespace umbsim::worlds {
namespace {

constexpr const char* kParts[] = {"start", "cruise", "stop", "turn", "arc", "circle"};

struct DifferencesArguments {
  int draws = 6;
  std::uint64_t seed = 1;
  std::string picture;
};

using Residuals = std::vector<PartResidual>;

template <class Keep>
Residuals kept(const Residuals& all, const Keep& keep) {
  Residuals some;
  for (const PartResidual& r : all) {
    if (keep(r)) some.push_back(r);
  }
  return some;
}

void print_row(const std::string& what, const Difference& d) {
  fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {} |\n", what, 1000 * d.along_m, 1000 * d.across_m,
             1000 * d.heading_rad, d.heading_share == 0 ? "" : fmt::format("{:.4f}", 100 * d.heading_share));
}

// The conditions' rows are of parts in which the robot turns, where engines differ most.
void print_conditions(const std::vector<Residuals>& of) {
  const auto turns = [](const PartResidual& r) { return r.angle_rad != 0; };
  const auto row = [&](const std::string& what, const auto& keep) {
    fmt::print("| {} |", what);
    for (std::size_t a = 0; a < of.size(); ++a) {
      for (std::size_t b = a + 1; b < of.size(); ++b) {
        fmt::print(" {:.4f} |", 100 * difference(kept(of[a], keep), kept(of[b], keep)).heading_share);
      }
    }
    fmt::print("\n");
  };
  for (const Size size : kSizes) {
    row(name(size), [&](const PartResidual& r) { return turns(r) && r.condition.size == size; });
  }
  for (const double speed : {0.2, 0.6}) {
    row(fmt::format("{} m/s", speed),
        [&](const PartResidual& r) { return turns(r) && r.condition.speed_mps == speed; });
  }
  for (const double payload : {0.0, 0.3}) {
    row(fmt::format("payload {:.0f} %", 100 * payload),
        [&](const PartResidual& r) { return turns(r) && r.condition.payload_share == payload; });
  }
}

void run_differences(const DifferencesArguments& a) {
  const std::vector<EngineKind>& kinds = engines();
  std::vector<Residuals> of(kinds.size());
  std::vector<int> refused(kinds.size());
  Progress progress("drives of engines", int(kinds.size()));
  tbb::parallel_for(std::size_t(0), kinds.size(), [&](std::size_t i) {
    of[i] = residuals_of(kinds[i], a.draws, a.seed, refused[i]);
    progress.step();
  });
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    fmt::print("{}: {} of {} draws of options drive\n", kinds[i].name, a.draws - refused[i], a.draws);
  }
  fmt::print(
      "\n| engines, part | along, mm | across, mm | heading, mrad | heading, % of the turn |\n|---|---|---|---|---|\n");
  std::vector<DifferenceBar> bars;
  std::string pairs;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = i + 1; j < kinds.size(); ++j) {
      const std::string pair = kinds[i].name + ", " + kinds[j].name;
      pairs += " " + kinds[i].name + " - " + kinds[j].name + " |";
      for (const char* part : kParts) {
        const auto of_part = [&](const PartResidual& r) { return r.part == part; };
        const Difference d = difference(kept(of[i], of_part), kept(of[j], of_part));
        print_row(pair + ", " + part, d);
        bars.push_back({pair, part, d.heading_rad});
      }
    }
  }
  fmt::print("\nHeading in turns, arcs and circles, % of the turn:\n\n| |{}\n|---|", pairs);
  for (std::size_t i = 0; i < kinds.size() * (kinds.size() - 1) / 2; ++i) fmt::print("---|");
  fmt::print("\n");
  print_conditions(of);
  if (a.picture.empty()) return;
  std::ofstream file(a.picture);
  file << difference_picture(bars);
  if (!file.flush()) throw RunError(a.picture + ": cannot be written");
}

}  // namespace

void add_differences_command(CLI::App& app) {
  const auto a = std::make_shared<DifferencesArguments>();
  CLI::App* command =
      app.add_subcommand("differences", "How far engines lead robots astray from their counts with nothing wrong");
  command->add_option("--draws", a->draws, "Draws of every engine's options")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", a->seed, "Of the draws")->capture_default_str();
  command->add_option("--picture", a->picture, "SVG file of the differences of heading");
  command->callback([a] { run_differences(*a); });
}

}  // namespace umbsim::worlds

// Random valid scenarios over the robots of a folder, half of them on uneven floors: how many do not stand, go far off
// without a word, or need a solver fallback that nobody reports. docs/robots.md. Arguments: folder, scenarios, seed,
// and `rigid` for supports without springs.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/standing/draw.h"
#include "core/error.h"
#include "experiment/run.h"

namespace {

using namespace umbsim;

constexpr double kFarOff_rad = 1;

struct Verdict {
  std::string kind, words;
};

Verdict judge(const ExperimentResult& r) {
  double worst_rad = 0;
  for (const RunDigest& digest : r.digests) worst_rad = std::max(worst_rad, std::abs(digest.error.theta_rad));
  std::string words;
  for (const std::string& warning : r.warnings) words += warning + " | ";
  const bool says_far = words.find("off by more than a radian") != words.npos;
  if (r.cost.solver_fallbacks > 0 && words.find("solver fallbacks") == words.npos)
    return {"fallback unreported", words};
  if (worst_rad > kFarOff_rad) return {says_far ? "far off, said why" : "far off, silent", words};
  if (r.cost.solver_fallbacks > 0) return {"fallback, reported", words};
  if (words.find("carried no load") != words.npos) return {"driven, a wheel unloaded, said", words};
  return {"driven", words};
}

std::string effects_of(const Scenario& scenario) {
  std::string text;
  for (const Effect& e : scenario.effects) text += fmt::format(", {} {:.3g}", e.info->name, e.values.numbers[0]);
  return text;
}

Verdict drive(const Scenario& scenario) {
  try {
    return judge(run_experiment(scenario, 0, false, {Rows::To::nowhere, {}}));
  } catch (const InputError& e) {
    const std::string what = e.what();
    return {what.find("does not stand") != what.npos ? "refused: does not stand" : "not valid: refused with its reason",
            what};
  } catch (const RunError& e) {
    const std::string what = e.what();
    return {what.find("tips over") != what.npos ? "failed: tips over, said" : "failed: other", what};
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool rigid = argc == 5 && std::string(argv[4]) == "rigid";
  if (argc != 4 && !rigid) {
    fmt::print(stderr, "umbsim_standing FOLDER SCENARIOS SEED [rigid]\n");
    return 2;
  }
  const std::vector<std::filesystem::path> robots = drivable_robots(argv[1]);
  const int count = std::atoi(argv[2]);
  std::map<std::string, int> counts, uneven_counts;
  for (int i = 0; i < count; ++i) {
    Scenario scenario = draw_scenario(robots, std::uint64_t(std::atoll(argv[3])), i);
    if (rigid) scenario.robot.suspension = {0., 0.};
    const Verdict outcome = drive(scenario);
    ++counts[outcome.kind];
    if (scenario.noise.floor_rms_m > 0) ++uneven_counts[outcome.kind];
    if (outcome.kind == "driven") continue;
    fmt::print("{} {} floor {:.2f} mm / {:.2f} m, friction {:.2f}, a {:.2f}{}: {}: {}\n", i,
               std::filesystem::path(scenario.robot.urdf).filename().string(), 1e3 * scenario.noise.floor_rms_m,
               scenario.noise.floor_wavelength_m, scenario.floor_friction, scenario.course.linear_acceleration_mps2,
               effects_of(scenario), outcome.kind, outcome.words);
    std::fflush(stdout);
  }
  fmt::print("\n{} robots, {} scenarios\n", robots.size(), count);
  for (const auto& [kind, number] : counts) {
    fmt::print("  {:<34}{:>5}, on uneven floors {:>5}\n", kind, number, uneven_counts[kind]);
  }
}

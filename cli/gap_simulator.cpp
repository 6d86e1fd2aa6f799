#include "cli/gap_simulator.h"

#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"
#include "core/sha256.h"
#include "core/text_file.h"
#include "experiment/build_info.h"

namespace umbsim {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t(1) << 30;

// What tracks depend on beside the recording: the program's own bytes (a commit does not tell two builds of a changed
// tree apart), the scenario, the robot.
std::string identity(const Scenario& scenario) {
  const BuildInfo build = build_info();
  std::string text = build.version + build.commit + build.compiler + build.bullet + build.build_type;
  text += sha256(read_text_file("/proc/self/exe", kMaxFileBytes)) + resolved_yaml(scenario);
  return text + sha256(read_text_file(scenario_urdf(scenario), kMaxFileBytes));
}

void show_stage(double elapsed_s, const std::string& stage, double left_s) {
  const std::string left = left_s < 0 ? "" : fmt::format(", about {:.0f} s left", std::ceil(left_s));
  fmt::print(stderr, "\r\033[K{:5.1f} s  {}{}", elapsed_s, stage, left);
}

void show_nothing(double, const std::string&, double) {}

}  // namespace

GapStages::GapStages(std::size_t runs)
    : terminal_(isatty(2) != 0), progress_(runs, terminal_ ? show_stage : show_nothing) {}

GapStages::~GapStages() { done(); }

void GapStages::done() {
  if (terminal_) fmt::print(stderr, "\r\033[K");
}

gap::Simulator gap_simulator(const Replay& replay) {
  return {[&replay](std::size_t run, const std::vector<Effect>& effects, double roughness_m_per_sqrt_m) {
            return replay.poses(run, effects, roughness_m_per_sqrt_m);
          },
          [&replay](std::size_t run, const std::vector<Effect>& effects) { return replay.counts(run, effects); },
          [&replay](const std::vector<Effect>& effects) { return replay.habits(effects); },
          [&replay](const std::vector<Effect>& effects) { return replay.scrubs(effects); }, replay.wheel_width_m()};
}

gap::Simulator cached_gap_simulator(const Replay& replay, bool no_cache) {
  gap::CacheChoice choice;
  std::string known;
  try {
    if (!no_cache) choice.folder = gap::user_cache_folder();
    if (choice.folder) known = identity(replay.scenario());
  } catch (const InputError&) {
    choice.folder.reset();  // what cannot be told apart is not kept
  }
  return gap::cached(gap_simulator(replay), replay.recording(), known, choice);
}

}  // namespace umbsim

#include "cli/gap/gap_simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/sha256.h"
#include "core/terminal.h"
#include "core/text/text_file.h"
#include "experiment/output/build_info.h"

namespace umbsim {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t(1) << 30;

// What tracks depend on beside the recording: the program's own bytes (a commit does not tell two builds of a changed
// tree apart), the scenario, the robot.
std::string identity(const Replay& replay) {
  const Scenario& scenario = replay.scenario();
  const BuildInfo build = build_info();
  std::string text = std::to_string(replay.first_run()) + "\n" + build.version + build.commit + build.compiler +
                     build.bullet + build.build_type;
  text += sha256(read_text_file("/proc/self/exe", kMaxFileBytes)) + resolved_yaml(scenario);
  return text + sha256(read_text_file(scenario_urdf(scenario), kMaxFileBytes));
}

// Coarser the longer it is, for nobody knows it to the second.
std::string time_text(double left_s) {
  if (left_s > 90) return fmt::format("{:.0f} min", std::ceil(left_s / 60));
  const double step_s = left_s > 30 ? 10 : left_s > 10 ? 5 : 1;
  return fmt::format("{:.0f} s", std::max(1.0, std::ceil(left_s / step_s)) * step_s);
}

void show_progress(const gap::ProgressShown& p) {
  const std::string left = p.left_s < 0 || p.fraction == 1 ? "" : fmt::format(", about {} left", time_text(p.left_s));
  fmt::print(stderr, "\r\033[K{:3.0f} %  {}{}", std::floor(100 * p.fraction), p.stage, left);
}

void show_nothing(const gap::ProgressShown&) {}

}  // namespace

GapStages::GapStages(std::size_t runs, std::vector<gap::UsualStage> usual)
    : terminal_(shows_progress()), progress_(runs, std::move(usual), terminal_ ? show_progress : show_nothing) {}

// Where the work failed the line must not stand before the error.
GapStages::~GapStages() {
  if (!done_) wipe();
}

void GapStages::done() {
  progress_.finish();
  wipe();
  done_ = true;
}

void GapStages::wipe() const {
  if (terminal_) fmt::print(stderr, "\r\033[K");
}

gap::Simulator gap_simulator(const Replay& replay) {
  return {[&replay](std::size_t run, const std::vector<Effect>& effects, double roughness_m_per_sqrt_m) {
            return replay.poses(run, effects, roughness_m_per_sqrt_m);
          },
          [&replay](std::size_t run, const std::vector<Effect>& effects) { return replay.counts(run, effects); },
          [&replay](const std::vector<Effect>& effects) { return replay.command_features(effects); },
          [&replay](const std::vector<Effect>& effects) { return replay.scrubs(effects); },
          replay.wheel_width_m(),
          replay.nominal().total_mass_kg()};
}

gap::Simulator cached_gap_simulator(const Replay& replay, bool no_cache) {
  gap::CacheChoice choice;
  std::string known;
  try {
    if (!no_cache) choice.folder = gap::user_cache_folder();
    if (choice.folder) known = identity(replay);
  } catch (const InputError&) {
    choice.folder.reset();  // what cannot be told apart is not kept
  }
  return gap::cached(gap_simulator(replay), replay.recording(), known, choice);
}

}  // namespace umbsim

// A simulator of a few lines for tests of the trial: a robot drives straight ahead, and every unit of strength of an
// effect turns its true heading by a milliradian per second.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/random.h"
#include "gap/trial/draw/severity.h"

namespace umbsim::trial_testing {

namespace fs = std::filesystem;

constexpr double kSpeed_mps = 0.2;

/// Sum of the strength parameters of the drive's effects, in thousandths.
inline double strength(const std::vector<Effect>& effects) {
  double sum = 0;
  for (const Effect& e : effects) {
    for (const std::string& wanted : strength_parameters(e.info->name)) {
      for (std::size_t i = 0; i < e.info->parameters.size(); ++i) {
        const EffectParameter& p = e.info->parameters[i];
        if (p.name == wanted) sum += 1000 * std::abs(e.values.numbers[i] - p.neutral);
      }
    }
  }
  return sum;
}

inline Recording fake_simulator(const TrialDrive& drive) {
  Recording recording = drive.planned;
  const double rate_radps = 1e-3 * strength(drive.effects);
  const double per_metre = recording.robot.ticks_per_revolution / (2 * M_PI * recording.robot.wheel_radius_m);
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    RecordedRun& run = recording.runs[r];
    RandomStream random(drive.seed, "fake " + run.id, r);
    double walk = 0;
    const int rows = int(50 * recording.path.side_m);
    for (int i = 0; i <= rows; ++i) {
      const double t = i / recording.encoder_rate_hz;
      const auto ticks = std::llround(kSpeed_mps * t * per_metre);
      run.encoders.push_back({t, ticks, ticks, 1, 1});
      walk += random.normal(0, drive.heading_walk_rad_per_sqrt_m * std::sqrt(kSpeed_mps / 50));
      const bool due = recording.truth_kind == "endpoints" ? i == 0 || i == rows : i % 5 == 0;
      if (!due) continue;
      const double x = random.normal(kSpeed_mps * t, recording.truth_position_sd_m);
      const double y = random.normal(0, recording.truth_position_sd_m);
      run.truth.push_back({t, {x, y, random.normal(rate_radps * t + walk, recording.truth_heading_sd_rad)}});
    }
    run.has_commands = true;
  }
  return recording;
}

/// A folder of this test's own, gone at its end.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::path(testing::TempDir()) / "umbsim_trial_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error(pattern);
    path = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
  fs::path path;
};

inline std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Every file below a folder with its content.
inline std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
  }
  return files;
}

/// Cases of every tier, on two small platforms.
inline TrialPlan small_plan() {
  TrialPlan plan;
  plan.name = "small";
  plan.seed = 11;
  plan.cases = {3, 6, 2, 2, 2, 2};
  for (const char* name : {"wheelbase", "wheel_radius_scale", "bump", "push"}) {
    plan.effects.push_back(&find_effect(name));
  }
  plan.platforms.count = 2;
  plan.platforms.side_m = {1.2, 1.6};
  return plan;
}

}  // namespace umbsim::trial_testing

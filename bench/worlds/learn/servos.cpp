#include "bench/worlds/learn/servos.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "cli/gap/gap_recordings.h"
#include "core/error.h"
#include "core/progress.h"
#include "gap/replay/command_response.h"
#include "gap/traits/traits.h"
#include "gap/trial/write/answers.h"
#include "recording/coarse_counts.h"

namespace umbsim::worlds {
namespace {

// A slope pulls on motors that give way. Of what the catalogue does not have nobody knows.
bool may_show_in_counts(const std::string& effect) {
  const std::vector<EffectInfo>& all = catalogue();
  const auto info = std::find_if(all.begin(), all.end(), [&](const EffectInfo& i) { return i.name == effect; });
  return info == all.end() || gap::shows_in_counts(*info) || effect == "floor_slope";
}

// Of one run; none without commands.
std::optional<ServoResponse> response_of(const GapRecordings& recordings, const gap::Simulator& simulator,
                                         std::size_t r) {
  const Recording& recording = recordings.campaign().all;
  const RecordedRun& run = recording.runs[r];
  if (!run.has_commands) return {};
  const double step_rad = count_step(recording) * 2 * M_PI / recording.robot.ticks_per_revolution;
  const auto response = [&](const std::vector<std::array<double, 2>>& counts_rad) {
    return gap::command_response(run, recording.robot, counts_rad, step_rad);
  };
  const gap::CommandResponse measured = response(gap::counted_rad(run, recording.robot));
  const gap::CommandResponse foretold = response(simulator.commands(r, {}));
  if (!measured.known || !foretold.known) return {};
  const double left = measured.left_gain - foretold.left_gain, right = measured.right_gain - foretold.right_gain;
  ServoResponse beyond;
  beyond << (left + right) / 2, left - right, measured.lag_s - foretold.lag_s,
      gap::course_axes(run).transpose() * (measured.by_heading_radps - foretold.by_heading_radps) /
          foretold.speed_radps,
      (measured.behind_radps - foretold.behind_radps) / gap::slowed_radps(1, recording.robot);
  return beyond;
}

// Mean of the runs of a case; none where it has no commands.
std::optional<ServoResponse> response_of(const std::string& folder) {
  const GapRecordings recordings({folder}, "");
  const gap::Simulator simulator = recordings.simulator(true);
  ServoResponse mean = ServoResponse::Zero();
  double runs = 0;
  for (std::size_t r = 0; r < recordings.campaign().all.runs.size(); ++r) {
    const auto response = response_of(recordings, simulator, r);
    if (!response) continue;
    runs += 1;
    mean += *response;
  }
  if (runs == 0) return {};
  return ServoResponse(mean / runs);
}

}  // namespace

ServoResponses servo_responses(const TrialFolder& folder) {
  struct Case {
    std::string name, engine;
  };
  std::vector<Case> cases;
  const Json answers = read_json(folder.answers());
  for (const auto& [name, answer] : read_answers(folder.answers())) {
    const bool counts = std::any_of(answer.effects.begin(), answer.effects.end(),
                                    [](const auto& effect) { return may_show_in_counts(effect.first); });
    if (counts) continue;
    const Json& said = answers.at("cases").at(name);
    if (!said.contains("world"))
      throw InputError(folder.answers().string() + ": case " + name + " does not say in which world it was drawn");
    cases.push_back({name, said.at("world").at("engine")});
  }
  std::vector<std::optional<ServoResponse>> found(cases.size());
  std::atomic<int> refused = 0;
  Progress progress("counts against commands", int(cases.size()));
  tbb::parallel_for(std::size_t(0), cases.size(), [&](std::size_t i) {
    try {
      found[i] = response_of((folder.recordings() / cases[i].name).string());
    } catch (const InputError&) {
      ++refused;
    }
    progress.step();
  });
  ServoResponses responses{{}, refused};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (found[i]) responses.by_engine[cases[i].engine].push_back(*found[i]);
  }
  return responses;
}

}  // namespace umbsim::worlds

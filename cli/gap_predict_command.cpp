#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include "calibration/calibrate.h"
#include "cli/commands.h"
#include "core/text_file.h"
#include "experiment/replay.h"
#include "experiment/result_json.h"
#include "experiment/run_folder.h"
#include "gap/check.h"
#include "gap/prediction.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct PredictArguments {
  std::string recording;
  std::string scenario;
  std::string squares;
  std::string out;
  bool force = false;
};

gap::Prediction replayed(const std::string& name, const Replay& replay, const std::vector<Effect>& effects) {
  gap::Prediction p{name, std::vector<std::vector<Pose2>>(replay.recording().runs.size())};
  const double roughness = replay.scrubs(effects) ? replay.scenario().noise.wheel_noise_m_per_sqrt_m : 0;
  tbb::parallel_for(std::size_t(0), p.tracks.size(),
                    [&](std::size_t r) { p.tracks[r] = replay.poses(r, effects, roughness); });
  return p;
}

// The simulator before and after; where squares are given, what odometry calibrated on them would have said.
std::vector<gap::Prediction> predictions(const Replay& replay, const std::vector<Effect>& effects,
                                         const std::string& squares) {
  const Recording& recording = replay.recording();
  const RecordedRobot& robot = recording.robot;
  const OdometryParameters nominal{robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m,
                                   robot.ticks_per_revolution};
  std::vector<gap::Prediction> all{replayed("before", replay, {}), replayed("after", replay, effects),
                                   gap::reckoned("odometry", recording, nominal)};
  if (squares.empty()) return all;
  const Umbmark u = umbmark(read_recording(squares), nominal);
  all.push_back(gap::reckoned("umbmark", recording, corrected(nominal, u.endpoint)));
  all.push_back(gap::reckoned("heading", recording, corrected(nominal, u.heading)));
  return all;
}

struct Scores {
  std::string name;
  std::vector<gap::RunError> runs;
  gap::RunError mean;
};

Scores scores(const Recording& recording, const gap::Prediction& p) {
  Scores s{p.name, {}, {}};
  const double n = double(p.tracks.size());
  for (std::size_t r = 0; r < p.tracks.size(); ++r) {
    s.runs.push_back(gap::prediction_error(recording.runs[r], p.tracks[r]));
    s.mean.final_mm += s.runs.back().final_mm / n;
    s.mean.along_mm += s.runs.back().along_mm / n;
    s.mean.raw_final_mm += s.runs.back().raw_final_mm / n;
    s.mean.frame_deg += s.runs.back().frame_deg / n;
  }
  return s;
}

Json error_json(const gap::RunError& e) {
  return {
      {"final_mm", e.final_mm}, {"along_mm", e.along_mm}, {"raw_final_mm", e.raw_final_mm}, {"frame_deg", e.frame_deg}};
}

Json prediction_json(const Recording& recording, const std::vector<Scores>& all) {
  Json json{{"format", "umbsim-prediction/1"}};
  for (const Scores& s : all) {
    Json runs = Json::object();
    for (std::size_t r = 0; r < s.runs.size(); ++r) runs[recording.runs[r].id] = error_json(s.runs[r]);
    json["predictions"][s.name] = {{"mean", error_json(s.mean)}, {"runs", runs}};
  }
  return json;
}

std::string table(const Recording& recording, const std::vector<Scores>& all) {
  std::string text = fmt::format("{:14}", "run");
  for (const Scores& s : all) text += fmt::format("{:>22}", s.name);
  text += "\n";
  const auto row = [&](const std::string& name, const auto& pick) {
    text += fmt::format("{:14}", name);
    for (const Scores& s : all) {
      const gap::RunError& e = pick(s);
      text += fmt::format("{:>11.1f} ({:>6.1f})", e.final_mm, e.raw_final_mm) + "  ";
    }
    text += "\n";
  };
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    row(recording.runs[r].id, [r](const Scores& s) -> const gap::RunError& { return s.runs[r]; });
  }
  row("mean", [](const Scores& s) -> const gap::RunError& { return s.mean; });
  return text;
}

void predict(const PredictArguments& a) {
  const Recording recording = read_recording(a.recording);
  gap::check_recording(recording, a.recording);
  const Scenario scenario = read_scenario(a.scenario);
  const std::string base =
      fs::absolute(a.recording / fs::path(".")).lexically_normal().parent_path().filename().string();
  const std::string out = a.out.empty() ? "results/" + base + "-prediction" : a.out;
  prepare_output_folder(out, a.force);
  Scenario without = scenario;
  without.effects.clear();
  const Replay replay(without, recording, false);
  std::vector<Scores> all;
  for (const gap::Prediction& p : predictions(replay, scenario.effects, a.squares)) all.push_back(scores(recording, p));
  write_folder(out, a.force, [&](const fs::path& into) {
    write_text_file(into / "prediction.json", prediction_json(recording, all).dump(2) + "\n");
    write_text_file(into / "provenance.json", provenance_json(a.recording, 0).dump(2) + "\n");
  });
  std::vector<std::string> effects;
  for (const Effect& e : scenario.effects) effects.push_back(e.info->name);
  fmt::print(
      "{}: {}\nEffects of {}: {}\nFinal position error in mm, start and frame fitted (recorded start taken as exact)\n"
      "{}Result in {}: prediction.json\n",
      base, recording.title, a.scenario, effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, ", ")),
      table(recording, all), out);
}

}  // namespace

void add_gap_predict_command(CLI::App& group) {
  const auto a = std::make_shared<PredictArguments>();
  CLI::App* command = group.add_subcommand(
      "predict",
      "Replay a recording from its ticks under a scenario's effects: how far the prediction ends from the truth");
  command->add_option("recording", a->recording, "Folder of the recording (real or simulated)")->required();
  command->add_option("--scenario", a->scenario, "Scenario with the effects, such as the twin.yaml of a diagnosis")
      ->required();
  command->add_option("--squares", a->squares,
                      "UMBmark squares of the same robot: compare with odometry calibrated on them");
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<recording>-prediction");
  command->add_flag("--force", a->force, "Replace a finished result");
  command->callback([a] { predict(*a); });
}

}  // namespace umbsim

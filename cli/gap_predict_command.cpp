#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <filesystem>
#include <memory>

#include "calibration/calibrate.h"
#include "calibration/intake/intake.h"
#include "calibration/prediction.h"
#include "cli/commands.h"
#include "cli/help.h"
#include "cli/jobs.h"
#include "cli/pages.h"
#include "cli/shipped.h"
#include "core/text_file.h"
#include "core/wrapped_text.h"
#include "experiment/replay.h"
#include "experiment/result_folder.h"
#include "experiment/result_json.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct PredictArguments {
  std::string recording;
  std::string scenario;
  std::string squares;
  std::string out;
  bool force = false;
  bool open = false;
  int jobs = 0;
};

calibration::Prediction replayed(const std::string& name, const Replay& replay, const std::vector<Effect>& effects) {
  calibration::Prediction p{name, std::vector<std::vector<Pose2>>(replay.recording().runs.size())};
  const double roughness = replay.scrubs(effects) ? replay.scenario().noise.wheel_noise_m_per_sqrt_m : 0;
  tbb::parallel_for(std::size_t(0), p.tracks.size(),
                    [&](std::size_t r) { p.tracks[r] = replay.poses(r, effects, roughness); });
  return p;
}

// The simulator before and after; where squares are given, what odometry calibrated on them would have said.
std::vector<calibration::Prediction> predictions(const Replay& replay, const std::vector<Effect>& effects,
                                         const std::string& squares) {
  const Recording& recording = replay.recording();
  const RecordedRobot& robot = recording.robot;
  const OdometryParameters nominal{robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m,
                                   robot.ticks_per_revolution};
  std::vector<calibration::Prediction> all{replayed("before", replay, {}), replayed("after", replay, effects),
                                   calibration::reckoned("odometry", recording, nominal)};
  if (squares.empty()) return all;
  const Umbmark u = umbmark(intake::take_in(squares).recording, nominal);
  all.push_back(calibration::reckoned("umbmark", recording, corrected(nominal, u.endpoint)));
  all.push_back(calibration::reckoned("heading", recording, corrected(nominal, u.heading)));
  return all;
}

struct Scores {
  std::string name;
  std::vector<calibration::RunError> runs;
  calibration::RunError mean;
};

Scores scores(const Recording& recording, const calibration::Prediction& p) {
  Scores s{p.name, {}, {}};
  const double n = double(p.tracks.size());
  for (std::size_t r = 0; r < p.tracks.size(); ++r) {
    s.runs.push_back(calibration::prediction_error(recording.runs[r], p.tracks[r]));
    s.mean.final_mm += s.runs.back().final_mm / n;
    s.mean.along_mm += s.runs.back().along_mm / n;
    s.mean.raw_final_mm += s.runs.back().raw_final_mm / n;
    s.mean.frame_deg += s.runs.back().frame_deg / n;
  }
  return s;
}

Json error_json(const calibration::RunError& e) {
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

std::string table(const Recording& recording, const std::vector<Scores>& all, const std::string& title,
                  double calibration::RunError::*error) {
  constexpr std::size_t kLabel = 24;
  std::string text = fitted(title, kLabel);
  for (const Scores& s : all) text += fmt::format("{:>11}", s.name);
  text += "\n";
  const auto row = [&](const std::string& name, const auto& pick) {
    text += fitted("  " + name, kLabel);
    for (const Scores& s : all) text += fmt::format("{:>11.1f}", pick(s).*error);
    text += "\n";
  };
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    row(recording.runs[r].id, [r](const Scores& s) -> const calibration::RunError& { return s.runs[r]; });
  }
  row("mean", [](const Scores& s) -> const calibration::RunError& { return s.mean; });
  return text;
}

void predict(const PredictArguments& a) {
  const ThreadLimit limit(a.jobs);
  const Recording recording = intake::take_in(a.recording).recording;
  const Scenario scenario = read_scenario(shipped_path(ShippedKind::scenario, a.scenario));
  const std::string base = folder_name(a.recording);
  ResultFolder out(a.out, base + "-prediction", a.force);
  Scenario without = scenario;
  without.effects.clear();
  const Replay replay(without, recording, false);
  std::vector<Scores> all;
  for (const calibration::Prediction& p : predictions(replay, scenario.effects, a.squares)) all.push_back(scores(recording, p));
  out.write([&](const fs::path& into) {
    const Json json = prediction_json(recording, all);
    write_text_file(into / "prediction.json", json.dump(2) + "\n");
    write_page(into, PageKind::prediction, prediction_page(json, base, page_provenance_json(a.recording, 0)));
    write_text_file(into / "provenance.json", provenance_json(a.recording, 0).dump(2) + "\n");
  });
  std::vector<std::string> effects;
  for (const Effect& e : scenario.effects) effects.push_back(e.info->name);
  fmt::print("{}{}Final position error, mm\n{}{}Result in {}: prediction.json; {}\n",
             wrapped(fmt::format("{}: {}", base, recording.title)),
             wrapped(fmt::format("Effects of {}: {}", a.scenario,
                                 effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, ", ")))),
             table(recording, all, "start and frame fitted", &calibration::RunError::final_mm),
             table(recording, all, "recorded start as exact", &calibration::RunError::raw_final_mm), out.said(),
             page_said(out.path()));
  finish_page(out.path(), a.open);
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
  add_open_option(command, a->open);
  add_threads_option(*command, a->jobs);
  add_example(command,
              "umbsim gap predict results/umbmark --scenario \\\n    results/umbmark-diagnosis/twin.yaml");
  command->callback([a] { predict(*a); });
}

}  // namespace umbsim

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <filesystem>
#include <memory>

#include "calibration/calibrate.h"
#include "calibration/intake/intake.h"
#include "calibration/prediction.h"
#include "cli/commands.h"
#include "cli/help/help.h"
#include "cli/jobs.h"
#include "cli/output/colour.h"
#include "cli/output/pages.h"
#include "cli/shipped.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"
#include "experiment/replay/replay.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct PredictArguments {
  std::vector<std::string> recordings;
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
  calibration::RunError mean() const {
    calibration::RunError mean;
    const double n = double(runs.size());
    for (const calibration::RunError& run : runs) {
      mean.final_mm += run.final_mm / n;
      mean.along_mm += run.along_mm / n;
      mean.raw_final_mm += run.raw_final_mm / n;
      mean.frame_deg += run.frame_deg / n;
    }
    return mean;
  }
};

/// A recording with what is predicted of its runs.
struct Predicted {
  std::string name;
  Recording recording;
  std::vector<Scores> scores;
};

void predict_runs(Predicted& p, const Scenario& scenario, const std::string& squares) {
  Scenario without = scenario;
  without.effects.clear();
  const Replay replay(without, p.recording, false);
  for (const calibration::Prediction& prediction : predictions(replay, scenario.effects, squares)) {
    p.scores.push_back({prediction.name, {}});
    for (std::size_t r = 0; r < prediction.tracks.size(); ++r)
      p.scores.back().runs.push_back(calibration::prediction_error(p.recording.runs[r], prediction.tracks[r]));
  }
}

Json error_json(const calibration::RunError& e) {
  return {
      {"final_mm", e.final_mm}, {"along_mm", e.along_mm}, {"raw_final_mm", e.raw_final_mm}, {"frame_deg", e.frame_deg}};
}

Json scores_json(const std::vector<std::string>& runs, const std::vector<Scores>& scores) {
  Json json = Json::object();
  for (const Scores& s : scores) {
    Json errors = Json::object();
    for (std::size_t r = 0; r < s.runs.size(); ++r) errors[runs[r]] = error_json(s.runs[r]);
    json[s.name] = {{"mean", error_json(s.mean())}, {"runs", errors}};
  }
  return json;
}

// Of all runs; of several recordings, where runs are named "recording/run", also of each.
Json prediction_json(const std::vector<Predicted>& all) {
  Json json{{"format", "umbsim-prediction/1"}};
  std::vector<std::string> runs;
  std::vector<Scores> scores;
  Json each = Json::object();
  for (const Predicted& p : all) {
    std::vector<std::string> own;
    for (const RecordedRun& run : p.recording.runs) {
      own.push_back(run.id);
      runs.push_back(all.size() > 1 ? p.name + "/" + run.id : run.id);
    }
    if (scores.empty()) {
      scores = p.scores;
    } else {
      for (std::size_t i = 0; i < scores.size(); ++i)
        scores[i].runs.insert(scores[i].runs.end(), p.scores[i].runs.begin(), p.scores[i].runs.end());
    }
    each[p.name]["predictions"] = scores_json(own, p.scores);
  }
  json["predictions"] = scores_json(runs, scores);
  if (all.size() > 1) json["recordings"] = std::move(each);
  return json;
}

std::string table(const Predicted& p, const std::string& title, double calibration::RunError::*error) {
  const std::vector<Scores>& all = p.scores;
  const Recording& recording = p.recording;
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
    row(recording.runs[r].id, [r](const Scores& s) { return s.runs[r]; });
  }
  row("mean", [](const Scores& s) { return s.mean(); });
  return text;
}

void predict(const PredictArguments& a) {
  const ThreadLimit limit(a.jobs);
  std::vector<Predicted> all;
  std::vector<std::string> names;
  for (const std::string& folder : a.recordings) {
    all.push_back({folder_name(folder), intake::take_in(folder).recording, {}});
    names.push_back(all.back().name);
  }
  const Scenario scenario = read_scenario(shipped_path(ShippedKind::scenario, a.scenario));
  ResultFolder out(a.out, fmt::format("{}-prediction", fmt::join(names, "+")), a.force);
  for (Predicted& p : all) predict_runs(p, scenario, a.squares);
  out.write([&](const fs::path& into) {
    const Json json = prediction_json(all);
    const std::string source = fmt::format("{}", fmt::join(a.recordings, " "));
    const std::string name = fmt::format("{}", fmt::join(names, "+"));
    write_text_file(into / "prediction.json", json.dump(2) + "\n");
    write_page(into, PageKind::prediction, prediction_page(json, name, page_provenance_json(source, 0)));
    write_text_file(into / "provenance.json", provenance_json(source, 0).dump(2) + "\n");
  });
  std::vector<std::string> effects;
  for (const Effect& e : scenario.effects) effects.push_back(e.info->name);
  fmt::print("{}", wrapped(fmt::format("Effects of {}: {}", a.scenario,
                                       effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, ", ")))));
  for (const Predicted& p : all) {
    fmt::print("{}Final position error, mm\n{}{}", wrapped(fmt::format("{}: {}", p.name, p.recording.title)),
               table(p, "start and frame fitted", &calibration::RunError::final_mm),
               table(p, "recorded start as exact", &calibration::RunError::raw_final_mm));
  }
  print_words(fmt::format("Result in {}: prediction.json; {}\n", out.said(), page_said(out.path())));
  finish_page(out.path(), a.open);
}

}  // namespace

void add_gap_predict_command(CLI::App& group) {
  const auto a = std::make_shared<PredictArguments>();
  CLI::App* command = group.add_subcommand(
      "predict",
      "Replay a recording from its ticks under a scenario's effects: how far the prediction ends from the truth");
  command->add_option("recording", a->recordings, "Folders of recordings (real or simulated) of one robot")->required();
  command->add_option("--scenario", a->scenario, "Scenario with the effects, such as the twin.yaml of a diagnosis")
      ->required();
  command->add_option("--squares", a->squares,
                      "UMBmark squares of the same robot: compare with odometry calibrated on them");
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<recording>-prediction");
  command->add_flag("--force", a->force, "Replace a finished result");
  add_open_option(command, a->open);
  add_threads_option(*command, a->jobs);
  add_example(command, "umbsim gap predict results/umbmark --scenario \\\n    results/umbmark-diagnosis/twin.yaml");
  command->callback([a] { predict(*a); });
}

}  // namespace umbsim

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "calibration/calibrate.h"
#include "calibration/compare/compare.h"
#include "calibration/intake/intake.h"
#include "calibration/methods/squares/squares.h"
#include "cli/commands.h"
#include "cli/help/help.h"
#include "cli/jobs.h"
#include "cli/output/answer.h"
#include "cli/output/calibration_json.h"
#include "cli/output/calibration_table.h"
#include "cli/output/pages.h"
#include "cli/output/tables.h"
#include "core/error.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"

namespace umbsim {
namespace {

using calibration::Comparison;
using calibration::Method;
using calibration::Task;

struct CalibrateArguments {
  std::vector<std::string> recordings;
  std::vector<std::string> tests;
  std::string out;
  std::string method = "all";
  bool force = false;
  bool open = false;
  Answer answer;
  int jobs = 0;
};

std::vector<std::string> method_names() {
  std::vector<std::string> names{"all"};
  for (const Method& m : calibration::methods()) names.emplace_back(m.name);
  return names;
}

// Folders of one name are told apart by their order.
void take_in(const std::vector<std::string>& folders, std::vector<Recording>& recordings,
             std::vector<std::string>& names, std::vector<std::string>& limits, bool several) {
  for (const std::string& folder : folders) {
    intake::Intake taken = intake::take_in(folder);
    std::string name = folder_name(folder);
    const std::string plain = name;
    for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n)
      name = fmt::format("{} ({})", plain, n);
    for (const std::string& limit : taken.limits) limits.push_back(several ? name + ": " + limit : limit);
    names.push_back(name);
    recordings.push_back(std::move(taken.recording));
  }
}

Task read_task(const CalibrateArguments& a, std::vector<std::string>& limits) {
  Task task;
  const bool several = a.recordings.size() + a.tests.size() > 1;
  take_in(a.recordings, task.train, task.train_names, limits, several);
  take_in(a.tests, task.test, task.test_names, limits, several);
  task.nominal = calibration::nominal_odometry(task.train.front().robot);
  return task;
}

std::vector<const Method*> chosen(const std::string& name) {
  std::vector<const Method*> all;
  for (const Method& m : calibration::methods()) {
    if (name == "all" || name == m.name) all.push_back(&m);
  }
  return all;
}

void check_answer(const Comparison& c, const std::string& recording) {
  std::string reasons;
  for (const calibration::MethodResult& r : c.results) {
    if (r.fit) return;
    if (!r.why_not.empty()) reasons += fmt::format("\n  {}: {}", r.name, r.why_not);
  }
  throw InputError(fmt::format("{}: no method has an answer:{}", recording, reasons));
}

// Of the first recording of squares that was driven both ways.
std::optional<std::pair<Umbmark, const Recording*>> first_squares(const Task& task) {
  const calibration::Runs runs = calibration::training_runs(task.train, task.train_names);
  for (std::size_t i = 0; i < task.train.size(); ++i) {
    if (auto u = calibration::squares_of(runs, i, task.nominal)) return std::pair{*u, &task.train[i]};
  }
  return std::nullopt;
}

std::optional<CalibrationMethod> as_form(const std::string& method) {
  if (method == "endpoint") return CalibrationMethod::endpoint;
  if (method == "heading") return CalibrationMethod::heading;
  return std::nullopt;
}

Json odometry_json(const OdometryParameters& o) {
  Json json{{"left_radius_m", o.left_radius_m}, {"right_radius_m", o.right_radius_m}, {"wheelbase_m", o.wheelbase_m}};
  if (o.scrub > 0) json["scrub"] = o.scrub;
  return json;
}

// For controllers that know radii and a wheelbase only: the method without scrub that predicts best.
const calibration::MethodResult& without_scrub(const Comparison& c) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < c.results.size(); ++i) {
    const calibration::MethodResult& r = c.results[i];
    if (r.fit && r.odometry.scrub == 0 && r.held_out_mm < c.results[best].held_out_mm) best = i;
  }
  return c.results[best];
}

/// What was found on which recordings.
struct Calibrated {
  Task task;
  std::vector<std::string> limits;
  Comparison comparison;
  std::optional<std::pair<Umbmark, const Recording*>> squares;

  const std::string& winner() const { return comparison.results[comparison.winner].name; }
  const OdometryParameters& odometry() const { return comparison.results[comparison.winner].odometry; }
};

Json json_of(const Calibrated& d) {
  Json json{{"format", "umbsim-calibration/1"}, {"method", d.winner()}};
  if (d.squares) {
    json["umbmark"] = umbmark_json(d.squares->first);
    json["calibration"] = calibration_json(d.squares->first, as_form(d.winner()));
    json["calibration"]["applied"] = d.winner();
  }
  json["odometry"] = odometry_json(d.odometry());
  json["nominal"] = odometry_json(d.comparison.nominal);
  if (d.odometry().scrub > 0) {
    const calibration::MethodResult& plain = without_scrub(d.comparison);
    json["without_scrub"] = {{"method", plain.name}, {"odometry", odometry_json(plain.odometry)}};
  }
  json["limits"] = d.limits;
  json["comparison"] = comparison_json(d.comparison, d.task);
  json["squares"] = squares_json(d.comparison, d.task);
  json["runs"] = residuals_json(d.comparison, d.task);
  return json;
}

std::string yaml_of(const Calibrated& d) {
  std::string comment =
      fmt::format("Odometry calibrated on '{}' ({})", fmt::join(d.task.train_names, "', '"), d.winner());
  if (d.odometry().scrub > 0) {
    const calibration::MethodResult& plain = without_scrub(d.comparison);
    comment += fmt::format(
        "\n# A controller that knows no scrub needs other numbers ({}):\n# left_radius_m {:.9f}, right_radius_m "
        "{:.9f}, "
        "wheelbase_m {:.9f}",
        plain.name, plain.odometry.left_radius_m, plain.odometry.right_radius_m, plain.odometry.wheelbase_m);
  }
  return calibration_yaml(d.odometry(), comment);
}

std::string words_of(const Calibrated& d) {
  std::string text;
  for (std::size_t i = 0; i < d.task.train.size(); ++i)
    text += wrapped(fmt::format("{}: {}", d.task.train_names[i], d.task.train[i].title));
  if (d.squares) {
    text += umbmark_table(d.squares->first, as_form(d.winner()));
    if (const auto extended = extended_umbmark(*d.squares->second, d.task.nominal, d.squares->first))
      text += extended_table(*extended);
  }
  text += comparison_table(d.comparison, d.task);
  for (const std::string& limit : d.limits) text += wrapped("Limit: " + limit);
  const OdometryParameters& o = d.odometry();
  const std::string scrub = o.scrub > 0 ? fmt::format(", scrub {:.5f}", o.scrub) : "";
  return text + wrapped(fmt::format("Calibrated odometry ({}): left radius {:.6f} m, right radius {:.6f} m, wheelbase "
                                    "{:.6f} m{}",
                                    d.winner(), o.left_radius_m, o.right_radius_m, o.wheelbase_m, scrub));
}

void calibrate(const CalibrateArguments& a) {
  const ThreadLimit limit(a.jobs);
  Calibrated done;
  done.task = read_task(a, done.limits);
  done.comparison = calibration::compare(done.task, chosen(a.method));
  check_answer(done.comparison, a.recordings.front());
  const std::string base = done.task.train_names.front();
  std::optional<ResultFolder> out;
  if (a.answer.wants_folder(a.out)) out.emplace(a.out, base + "-calibration", a.force);
  done.squares = first_squares(done.task);

  const Json json = json_of(done);
  std::string words = a.answer.json ? "" : words_of(done);
  if (out) {
    out->write([&](const std::filesystem::path& into) {
      write_text_file(into / "calibration.yaml", yaml_of(done));
      write_text_file(into / "calibration.json", json.dump(2) + "\n");
      const Json provenance = page_provenance_json(a.recordings.front(), 0);
      write_page(into, PageKind::calibration, calibration_page(json, base, provenance));
      write_text_file(into / "provenance.json", provenance_json(a.recordings.front(), 0).dump(2) + "\n");
    });
    words += fmt::format("Result in {}: calibration.yaml, calibration.json; {}\n", out->said(), page_said(out->path()));
  }
  print_answer(a.answer, words, json);
  if (out) finish_page(out->path(), a.open);
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand(
      "calibrate", "Calibrate the odometry on recordings, by all methods, and name the one to trust");
  command->add_option("recording", a->recordings, "Folders of recordings of one robot (real or simulated)")->required();
  command->add_option("--test", a->tests, "Recording to be predicted only (repeatable)")->allow_extra_args(false);
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<recording>-calibration");
  CLI::Validator known = CLI::IsMember(method_names());
  command
      ->add_option("--method", a->method,
                   fmt::format("Whose numbers calibration.yaml gets: {}", fmt::join(method_names(), ", ")))
      ->check(known.description(""))
      ->capture_default_str();
  command->add_flag("--force", a->force, "Replace a finished result");
  add_answer_options(command, a->answer, "calibration.json");
  add_open_option(command, a->open);
  add_threads_option(*command, a->jobs);
  add_example(command, "umbsim calibrate results/umbmark\n  umbsim calibrate squares circles --test free");
  command->callback([a] { calibrate(*a); });
}

}  // namespace umbsim

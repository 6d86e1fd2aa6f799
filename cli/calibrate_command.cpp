#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "calibration/calibrate.h"
#include "calibration/intake/intake.h"
#include "cli/commands.h"
#include "cli/help.h"
#include "cli/tables.h"
#include "core/text_file.h"
#include "core/wrapped_text.h"
#include "experiment/result_folder.h"
#include "experiment/result_json.h"

namespace umbsim {
namespace {

struct CalibrateArguments {
  std::string recording;
  std::string out;
  std::string method = "heading";
  bool force = false;
};

void calibrate(const CalibrateArguments& a) {
  namespace fs = std::filesystem;
  const auto [recording, limits] = intake::take_in(a.recording);
  const OdometryParameters nominal{recording.robot.wheel_radius_m, recording.robot.wheel_radius_m,
                                   recording.robot.wheelbase_m, recording.robot.ticks_per_revolution};
  const Umbmark u = umbmark(recording, nominal);
  const auto method = a.method == "endpoint" ? CalibrationMethod::endpoint : CalibrationMethod::heading;
  const OdometryParameters calibrated = corrected(nominal, estimate(u, method));
  const std::string base = folder_name(a.recording);
  ResultFolder out(a.out, base + "-calibration", a.force);

  Json json{{"format", "umbsim-calibration/1"},
            {"method", a.method},
            {"umbmark", umbmark_json(u)},
            {"calibration", calibration_json(u, method)},
            {"odometry",
             {{"left_radius_m", calibrated.left_radius_m},
              {"right_radius_m", calibrated.right_radius_m},
              {"wheelbase_m", calibrated.wheelbase_m}}},
            {"limits", limits}};
  out.write([&](const fs::path& into) {
    const std::string comment = fmt::format("Odometry calibrated on '{}' ({} form)", base, a.method);
    write_text_file(into / "calibration.yaml", calibration_yaml(calibrated, comment));
    write_text_file(into / "calibration.json", json.dump(2) + "\n");
    write_text_file(into / "provenance.json", provenance_json(a.recording, 0).dump(2) + "\n");
  });
  fmt::print("{}{}", wrapped(fmt::format("{}: {}", base, recording.title)), umbmark_table(u, method));
  if (const auto extended = extended_umbmark(recording, nominal, u)) fmt::print("{}", extended_table(*extended));
  for (const std::string& limit : limits) fmt::print("{}", wrapped("Limit: " + limit));
  fmt::print("{}Result in {}: calibration.yaml, calibration.json\n",
             wrapped(fmt::format(
                 "Calibrated odometry ({} form): left radius {:.6f} m, right radius {:.6f} m, wheelbase {:.6f} m",
                 a.method, calibrated.left_radius_m, calibrated.right_radius_m, calibrated.wheelbase_m)),
             out.said());
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand("calibrate", "Calibrate the odometry on a recording of UMBmark squares");
  command->add_option("recording", a->recording, "Folder of the recording (real or simulated)")->required();
  command->add_option("-o,--out", a->out, "Folder for the result; default results/<recording>-calibration");
  command->add_option("--method", a->method, "Which form's corrections calibration.yaml gets")
      ->check(CLI::IsMember({"heading", "endpoint"}))
      ->capture_default_str();
  command->add_flag("--force", a->force, "Replace a finished result");
  add_example(command, "umbsim calibrate results/umbmark");
  command->callback([a] { calibrate(*a); });
}

}  // namespace umbsim

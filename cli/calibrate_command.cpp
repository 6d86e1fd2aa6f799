#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "calibration/calibrate.h"
#include "cli/commands.h"
#include "cli/tables.h"
#include "core/text_file.h"
#include "experiment/result_json.h"
#include "experiment/run_folder.h"

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
  const Recording recording = read_recording(a.recording);
  const OdometryParameters nominal{recording.robot.wheel_radius_m, recording.robot.wheel_radius_m,
                                   recording.robot.wheelbase_m, recording.robot.ticks_per_revolution};
  const Umbmark u = umbmark(recording, nominal);
  const auto method = a.method == "endpoint" ? CalibrationMethod::endpoint : CalibrationMethod::heading;
  const OdometryParameters calibrated = corrected(nominal, estimate(u, method));
  std::string base = fs::absolute(a.recording).lexically_normal().filename().string();
  if (base.empty()) base = fs::absolute(a.recording).lexically_normal().parent_path().filename().string();
  const std::string out = a.out.empty() ? "results/" + base + "-calibration" : a.out;

  Json json{{"format", "umbsim-calibration/1"},
            {"method", a.method},
            {"umbmark", umbmark_json(u)},
            {"calibration", {{"endpoint", estimate_json(u.endpoint)}, {"heading", estimate_json(u.heading)}}},
            {"odometry",
             {{"left_radius_m", calibrated.left_radius_m},
              {"right_radius_m", calibrated.right_radius_m},
              {"wheelbase_m", calibrated.wheelbase_m}}}};
  write_folder(out, a.force, [&](const fs::path& into) {
    const std::string comment = fmt::format("Odometry calibrated on '{}' ({} form)", base, a.method);
    write_text_file(into / "calibration.yaml", calibration_yaml(calibrated, comment));
    write_text_file(into / "calibration.json", json.dump(2) + "\n");
    write_text_file(into / "provenance.json", provenance_json(a.recording, 0).dump(2) + "\n");
  });
  fmt::print("{}: {}\n{}", base, recording.title, umbmark_table(u));
  if (const auto extended = extended_umbmark(recording, nominal, u)) fmt::print("{}", extended_table(*extended));
  fmt::print("Calibrated odometry ({} form): left radius {:.6f} m, right radius {:.6f} m, wheelbase {:.6f} m\n"
             "Result in {}: calibration.yaml, calibration.json\n",
             a.method, calibrated.left_radius_m, calibrated.right_radius_m, calibrated.wheelbase_m, out);
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
  command->callback([a] { calibrate(*a); });
}

}  // namespace umbsim

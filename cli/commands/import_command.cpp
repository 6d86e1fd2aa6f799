#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "calibration/intake/intake.h"
#include "cli/commands.h"
#include "cli/commands/import_options.h"
#include "cli/help/help.h"
#include "cli/output/import_text.h"
#include "core/text/text_file.h"
#include "exchange/import/imported.h"
#include "exchange/import/paths_svg.h"
#include "experiment/output/result_folder.h"
#include "experiment/output/result_json.h"

namespace umbsim {
namespace {

struct ImportArguments {
  exchange::ImportOptions options;
  std::string out;
  bool force = false;
  bool dry_run = false;
};

void import(const ImportArguments& a) {
  namespace fs = std::filesystem;
  const exchange::Imported imported = exchange::import_recording(a.options);
  if (a.dry_run) {
    fmt::print("{}Nothing was written (--dry-run).\n", import_text(imported));
    return;
  }
  ResultFolder out(a.out, fs::path(folder_name(a.options.source)).stem().string() + "-recording", a.force);
  out.write([&](const fs::path& into) {
    write_recording(imported.recording, into);
    intake::take_in(into.string());  // what was written is what every other command will read
    write_text_file(into / "import.json", import_json(imported).dump(2) + "\n");
    write_text_file(into / "paths.svg", exchange::paths_svg(imported.recording));
    write_text_file(into / "provenance.json", provenance_json(a.options.source, 0).dump(2) + "\n");
  });
  fmt::print("{}Recording in {}; look at {}/paths.svg\n", import_text(imported), out.said(), out.path());
}

}  // namespace

void add_import_command(CLI::App& app) {
  const auto a = std::make_shared<ImportArguments>();
  CLI::App* command =
      app.add_subcommand("import", "Make a recording of a robot's log: CSV, ROS bag, TUM or KITTI poses");
  command
      ->add_option("source", a->options.source, "Log with the wheels, and maybe the truth: a file, or a bag's folder")
      ->required();
  command->add_option("-o,--out", a->out, "Folder for the recording; default results/<source>-recording");
  add_import_options(*command, a->options);
  command->add_flag("--dry-run", a->dry_run, "Show what was found and the runs, write nothing");
  command->add_flag("--force", a->force, "Replace a finished result");
  add_example(command, "umbsim import drive.mcap --robot robot.urdf --dry-run");
  command->callback([a] { import(*a); });
}

}  // namespace umbsim

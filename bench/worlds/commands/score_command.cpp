#include <fmt/format.h>

#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/score/score.h"
#include "experiment/output/build_info.h"
#include "experiment/output/result_json.h"
#include "report/report.h"
#include "report/score_page.h"

namespace umbsim::worlds {

void add_score_command(CLI::App& app) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("score", "Open the answers and compare, by engine, effect, tracker, driver and set of runs");
  command->add_option("folder", *folder, "Folder of the worlds, diagnosed by `umbsim gap trial diagnose`")->required();
  command->callback([folder] {
    const TrialFolder worlds(*folder);
    const WorldScore score = score_worlds(worlds);
    const std::string text = score_markdown(score);
    const Json json = score_json(score);
    write_file_whole(worlds.score() / "worlds.json", json.dump(1) + "\n");
    write_file_whole(worlds.score() / "worlds.md", text);
    if (has_pages()) {
      const Json page =
          score_page(json, worlds.score(), build_info().version, page_provenance_json(worlds.answers().string(), 0));
      write_file_whole(worlds.score() / "report.html", render_report(PageKind::score, page));
    }
    fmt::print("{}\nResult in {}: worlds.json, worlds.md{}\n", text, worlds.score().string(),
               has_pages() ? ", report.html" : "");
  });
}

}  // namespace umbsim::worlds

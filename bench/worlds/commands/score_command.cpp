#include <fmt/format.h>

#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/score/score.h"

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
    write_file_whole(worlds.score() / "worlds.json", score_json(score).dump(1) + "\n");
    write_file_whole(worlds.score() / "worlds.md", text);
    fmt::print("{}\nResult in {}: worlds.json, worlds.md\n", text, worlds.score().string());
  });
}

}  // namespace umbsim::worlds

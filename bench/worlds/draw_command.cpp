#include <fmt/format.h>

#include <memory>

#include "bench/worlds/commands.h"
#include "bench/worlds/draw.h"

namespace umbsim::worlds {
namespace {

struct Arguments {
  std::string file;
  std::string folder;
  std::string shard = "1/1";
  int jobs = 0;
};

void draw(const Arguments& a) {
  const WorldsPlan plan = read_worlds(a.file);
  const TrialFolder folder(a.folder.empty() ? "results/worlds-" + plan.name : a.folder);
  const DrawResult r = draw_worlds(plan, folder, parse_shard(a.shard), a.jobs);
  fmt::print("{}: {} of {} cases stand\n", folder.root.string(), r.finished, r.cases);
  if (r.drawn_now > 0) {
    const double tried = double(r.drawn_now) + r.worlds_redrawn;
    fmt::print(
        "drawn now: {} in {:.0f} s, {:.0f} an hour; {:.0f} % of the worlds could not be driven and were drawn "
        "again, and {} times the faults\n",
        r.drawn_now, r.wall_s, 3600 * double(r.drawn_now) / r.wall_s, 100 * r.worlds_redrawn / tried, r.faults_redrawn);
  }
  if (r.seal) fmt::print("SHA-256 of the answers: {}\n", *r.seal);
}

}  // namespace

void add_draw_command(CLI::App& app) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("draw", "Draw worlds, drive them, seal the answers; does what is not done yet");
  command->add_option("worlds", a->file, "Worlds file (YAML, docs/worlds.md)")->required();
  command->add_option("-o,--out", a->folder, "Folder of the worlds; default results/worlds-<name>");
  command->add_option("--shard", a->shard, "Do only part i of n of the cases: i/n")->capture_default_str();
  command->add_option("-j,--jobs", a->jobs, "Cases at the same time; 0: one per core")->check(CLI::Range(0, 1024));
  command->callback([a] { draw(*a); });
}

}  // namespace umbsim::worlds

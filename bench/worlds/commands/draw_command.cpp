#include <fmt/format.h>

#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/draw/draw.h"
#include "bench/worlds/draw/worlds_list.h"
#include "core/text/yaml_reader.h"

namespace umbsim::worlds {
namespace {

struct DrawArguments {
  std::string file;
  std::string folder;
  std::string shard = "1/1";
  int jobs = 0;
};

bool is_list(const std::string& file) {
  YamlMap map(YamlValue::load(file));
  return map.at("format").choice({"umbsim-worlds/1", "umbsim-worlds-list/1"}) == "umbsim-worlds-list/1";
}

TrialFolder folder_of(const DrawArguments& a, const std::string& name) {
  return TrialFolder(a.folder.empty() ? "results/worlds-" + name : a.folder);
}

DrawResult draw_plan(const DrawArguments& a) {
  const WorldsPlan plan = read_worlds(a.file);
  return draw_worlds(plan, folder_of(a, plan.name), parse_shard(a.shard), a.jobs);
}

DrawResult draw_list(const DrawArguments& a) {
  const WorldsList list = read_worlds_list(a.file);
  return draw_all(source_of(list), folder_of(a, list.name), parse_shard(a.shard), a.jobs);
}

void draw(const DrawArguments& a) {
  const DrawResult r = is_list(a.file) ? draw_list(a) : draw_plan(a);
  fmt::print("{}: {} of {} cases stand\n", r.root.string(), r.finished, r.cases);
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
  const auto a = std::make_shared<DrawArguments>();
  CLI::App* command = app.add_subcommand(
      "draw", "Draw worlds or the cases of a list, drive them, seal the answers; does what is not done yet");
  command->add_option("worlds", a->file, "Plan of worlds or list of cases (YAML, docs/worlds.md)")->required();
  command->add_option("-o,--out", a->folder, "Folder of the worlds; default results/worlds-<name>");
  command->add_option("--shard", a->shard, "Do only part i of n of the cases: i/n")->capture_default_str();
  command->add_option("-j,--jobs", a->jobs, "Cases at the same time; 0: one per core")->check(CLI::Range(0, 1024));
  command->callback([a] { draw(*a); });
}

}  // namespace umbsim::worlds

#include <fmt/format.h>

#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/inject/inject.h"

namespace umbsim::worlds {
namespace {

struct InjectArguments {
  std::vector<std::string> recordings;
  std::string folder = "results/worlds-injected";
  int each = 9;
  std::uint64_t seed = 1;
};

}  // namespace

void add_inject_command(CLI::App& app) {
  const auto a = std::make_shared<InjectArguments>();
  CLI::App* command =
      app.add_subcommand("inject", "Spoil real recordings as a fault of the robot would; seal the answers");
  command->add_option("recordings", a->recordings, "Folders of real recordings")->required();
  command->add_option("-o,--out", a->folder, "Folder of the spoiled recordings")->capture_default_str();
  command->add_option("--each", a->each, "Spoiled copies of each recording")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  command->add_option("--seed", a->seed, "Of sizes, signs and names")->capture_default_str();
  command->callback([a] {
    const InjectResult r = inject(a->recordings, TrialFolder(a->folder), a->each, a->seed);
    fmt::print("{}: {} spoiled recordings; {} as they are in unspoiled/, whose answers nobody knows\n", a->folder,
               r.recordings, r.unspoiled);
    if (r.refused > 0) fmt::print("{} could not carry the fault that was drawn\n", r.refused);
    fmt::print("SHA-256 of the answers: {}\n", r.seal);
  });
}

}  // namespace umbsim::worlds

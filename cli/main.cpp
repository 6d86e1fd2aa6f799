#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/exit.h"
#include "core/error.h"
#include "core/yaml_reader.h"
#include "experiment/build_info.h"

namespace {

using umbsim::kBadInput;
using umbsim::kRunFailed;

// Every subcommand, in the order of --help.
constexpr void (*kCommands[])(CLI::App&) = {
    umbsim::add_run_command,
    umbsim::add_calibrate_command,
    umbsim::add_effects_command,
    umbsim::add_explain_command,
    umbsim::add_sweep_command,
    umbsim::add_gap_command,
};

std::vector<std::string> subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "umbsim: a physics testbed for honest odometry. Drives UMBmark squares in a Bullet world with wheel errors, "
      "cables and noise, reports what UMBmark makes of them, calibrates, and proves it by driving again.\n\n"
      "Exit codes: 0 done, 1 an expectation was not met, 2 bad input or usage, 3 the run failed."};
  app.name("umbsim");
  const umbsim::BuildInfo info = umbsim::build_info();
  app.set_version_flag("--version", fmt::format("umbsim {} ({}, Bullet {})", info.version, info.commit, info.bullet));
  app.require_subcommand(1);
  for (const auto add : kCommands) add(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& e) {
    const std::vector<std::string> extra = app.remaining();
    if (app.get_subcommands().empty() && !extra.empty() && extra.front().rfind('-', 0) != 0) {
      fmt::print(stderr, "umbsim: unknown subcommand '{}'; {}\n", extra.front(),
                 umbsim::list_choices(extra.front(), subcommands(app)));
      return kBadInput;
    }
    return app.exit(e) == 0 ? 0 : kBadInput;
  } catch (const umbsim::Exit& e) {
    if (*e.what()) fmt::print(stderr, "umbsim: {}\n", e.what());
    return e.code;
  } catch (const umbsim::InputError& e) {
    fmt::print(stderr, "umbsim: {}\n", e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    fmt::print(stderr, "umbsim: the run failed: {}\n", e.what());
    return kRunFailed;
  }
}

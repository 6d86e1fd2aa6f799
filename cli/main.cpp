#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/help/help.h"
#include "cli/output/colour.h"
#include "core/error.h"
#include "experiment/output/build_info.h"

namespace {

using umbsim::kBadInput;
using umbsim::kRunFailed;

// Every subcommand, in the order of --help.
constexpr void (*kCommands[])(CLI::App&) = {
    umbsim::add_run_command,
    umbsim::add_import_command,
    umbsim::add_calibrate_command,
    umbsim::add_export_command,
    umbsim::add_report_command,
    umbsim::add_list_command,
    umbsim::add_robot_command,
    umbsim::add_effects_command,
    umbsim::add_explain_command,
    umbsim::add_sweep_command,
    umbsim::add_gap_command,
    umbsim::add_completion_command,
};

// Words are buffered: a full disk shows when the last of them are written.
int checked(int code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout.good()) return code;
  if (code != 0 && code != umbsim::kUnmet) return code;  // what went wrong before has been said
  const char* why = errno == 0 ? "write error" : std::strerror(errno);
  fmt::print(stderr, "umbsim: standard output cannot be written completely: {}\n", why);
  return kRunFailed;
}

int run(int argc, char** argv) {
  CLI::App app{
      "umbsim: a physics testbed for honest odometry. Drives UMBmark squares in a Bullet world with wheel errors, "
      "cables and noise, reports what UMBmark makes of them, calibrates, and proves it by driving again.\n\n"
      "Exit codes: 0 done, 1 an expectation was not met, 2 bad input or usage, 3 the run failed."};
  app.name("umbsim");
  app.formatter(std::make_shared<umbsim::HelpFormatter>());
  umbsim::add_example(&app, "umbsim run umbmark");
  const umbsim::BuildInfo info = umbsim::build_info();
  app.set_version_flag("--version", fmt::format("umbsim {} ({}, Bullet {})", info.version, info.commit, info.bullet));
  app.require_subcommand(1);
  for (const auto add : kCommands) add(app);
  umbsim::group_options(app);
  const std::vector<std::string> words = umbsim::with_help_option(app, {argv + 1, argv + argc});
  if (words.empty()) {
    std::cout << umbsim::help_for_terminal(umbsim::start_text());
    return 0;
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {  // --help, --version
      std::ostringstream text;
      app.exit(e, text, text);
      std::cout << umbsim::help_for_terminal(text.str());
      return 0;
    }
    umbsim::print_error(umbsim::usage_error(app, words, e));
    return kBadInput;
  } catch (const umbsim::Exit& e) {
    if (*e.what()) umbsim::print_error(e.what());
    return e.code;
  } catch (const umbsim::InputError& e) {
    umbsim::print_error(e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    umbsim::print_error(std::string("the run failed: ") + e.what());
    return kRunFailed;
  }
}

}  // namespace

int main(int argc, char** argv) { return checked(run(argc, argv)); }

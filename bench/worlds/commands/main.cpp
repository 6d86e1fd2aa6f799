// The proving ground of the gap diagnosis: worlds that nobody tuned anything on. docs/worlds.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "bench/worlds/commands/commands.h"
#include "core/error.h"

int main(int argc, char** argv) {
  CLI::App app("Worlds for the gap diagnosis: draws recordings with sealed answers, spoils real ones, scores");
  app.require_subcommand(1);
  umbsim::worlds::add_draw_command(app);
  umbsim::worlds::add_check_command(app);
  umbsim::worlds::add_contacts_command(app);
  umbsim::worlds::add_differences_command(app);
  umbsim::worlds::add_inject_command(app);
  umbsim::worlds::add_learn_command(app);
  umbsim::worlds::add_numbers_command(app);
  umbsim::worlds::add_score_command(app);
  umbsim::worlds::add_servos_command(app);
  umbsim::worlds::add_table_command(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const umbsim::InputError& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 3;
  }
}

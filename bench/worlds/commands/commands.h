#pragma once

#include <CLI/CLI.hpp>

namespace umbsim::worlds {

void add_check_command(CLI::App& app);
void add_contacts_command(CLI::App& app);
void add_differences_command(CLI::App& app);
void add_draw_command(CLI::App& app);
void add_inject_command(CLI::App& app);
void add_learn_command(CLI::App& app);
void add_numbers_command(CLI::App& app);
void add_score_command(CLI::App& app);
void add_servos_command(CLI::App& app);
void add_table_command(CLI::App& app);

}  // namespace umbsim::worlds

#pragma once

#include <CLI/CLI.hpp>

namespace umbsim {

/// Each adds one subcommand to the program and its work as the subcommand's callback.
void add_run_command(CLI::App& app);
void add_sweep_command(CLI::App& app);
void add_calibrate_command(CLI::App& app);
void add_import_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_list_command(CLI::App& app);
void add_robot_command(CLI::App& app);
void add_effects_command(CLI::App& app);
void add_explain_command(CLI::App& app);
void add_gap_command(CLI::App& app);
void add_completion_command(CLI::App& app);
void add_gap_trial_command(CLI::App& gap);  ///< below `gap`
void add_gap_predict_command(CLI::App& group);  ///< below `gap`
void add_gap_plan_command(CLI::App& group);     ///< below `gap`

}  // namespace umbsim

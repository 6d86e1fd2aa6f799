#pragma once

#include <optional>
#include <string>

#include "experiment/explain/explain.h"
#include "experiment/run.h"

namespace umbsim {

/// What the terminal shows, in the lecture's order: one-way and two-way return errors, E_max, errors of type A and B,
/// E_d and E_b, extended UMBmark, calibration. Lengths in mm, angles in degrees.
/// `applied`: whose corrections go into the odometry; that form stands first. `injected`: of a simulated robot.
std::string umbmark_table(const Umbmark& umbmark, std::optional<CalibrationMethod> applied,
                          std::optional<InjectedErrors> injected = {});
std::string extended_table(const ExtendedUmbmark& extended);
std::string experiment_table(const ExperimentResult& result);
std::string explanation_table(const Scenario& scenario, const Explanation& explanation);

/// On standard error, a line each.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace umbsim

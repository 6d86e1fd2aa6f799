#pragma once

#include <vector>

#include "experiment/scenario/scenario.h"
#include "gap/plan/menu.h"

namespace umbsim {

/// The scenario's robot and course without effects, noise, cables or calibration.
Scenario nominal_scenario(Scenario scenario);

/// Runs of the menu for a scenario's course, with a payload that the robot can be expected to carry.
std::vector<gap::MenuRun> menu_for(const Scenario& scenario, const RecordedPath& path);

/// `recording` with the runs of the menu driven by the nominal robot and added behind its own.
Recording with_menu(Recording recording, const Scenario& scenario, const std::vector<gap::MenuRun>& menu);

}  // namespace umbsim

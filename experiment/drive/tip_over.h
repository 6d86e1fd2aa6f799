#pragma once

#include <string>

#include "effects/rig.h"
#include "experiment/drive/drive_run.h"
#include "umbmark/course.h"

namespace umbsim {

/// What an experimenter wants to know of a robot that tipped over: when, where on the course, at what acceleration, what
/// it stands, and what helps.
std::string tip_over_message(const Fall& fall, const Scenario& scenario, const Rig& rig, const Plan& plan,
                             const RunSpec& spec);

}  // namespace umbsim

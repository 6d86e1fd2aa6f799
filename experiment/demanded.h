#pragma once

#include "effects/rig.h"
#include "recording/recording.h"
#include "umbmark/course.h"

namespace umbsim {

/// A course with its accelerations and turns as `demand` asks for them.
Course demanded(Course course, const Demand& demand);

/// The course of one recorded run as `demand` asks for it. `path` must declare a square and all its speeds.
Course demanded_course(const RecordedPath& path, const RecordedRun& run, const Demand& demand);

/// A recorded robot's square course as `demand` asks for it, on motors and wheels that follow exactly: commands and
/// counts of one run for every condition, without truth. What ramps of a few samples really show of an acceleration,
/// and how fast a turn can become before it is over. Empty where the recording declares no square, or no speeds.
Recording demanded(const Recording& recording, const Demand& demand);

}  // namespace umbsim

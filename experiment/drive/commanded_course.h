#pragma once

#include "effects/rig.h"
#include "recording/recording.h"
#include "umbmark/course.h"

namespace umbsim {

/// A course with its accelerations and turns as `motion` asks for them.
Course commanded(Course course, const CommandedMotion& motion);

/// The course of one recorded run as `motion` asks for it. `path` must declare a square and all its speeds.
Course commanded_course(const RecordedPath& path, const RecordedRun& run, const CommandedMotion& motion);

/// A recorded robot's square course as `motion` asks for it, on motors and wheels that follow exactly: commands and
/// counts of one run for every condition, without truth. What ramps of a few samples really show of an acceleration,
/// and how fast a turn can become before it is over. Empty where the recording declares no square, or no speeds.
Recording commanded(const Recording& recording, const CommandedMotion& motion);

}  // namespace umbsim

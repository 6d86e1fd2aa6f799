#pragma once

#include "recording/recording.h"
#include "umbmark/course.h"

namespace umbsim {

/// Takes over what a recording says of its course. Where the shape is free, or its length is not known, the course keeps
/// its shape.
void set_course(Course& course, const RecordedPath& path);

/// The course as a recording says it.
RecordedPath recorded_path(const Course& course);

}  // namespace umbsim

#pragma once

#include "core/text/yaml_reader.h"
#include "umbmark/course.h"

namespace umbsim {

/// Reads `course:` of a scenario. Throws InputError for what cannot be driven, and for lengths of another shape.
Course read_course(const YamlValue& value);

/// `course:` with every value written out; of the lengths those of its shape, and the square's side.
std::string course_block(const Course& course);

/// "a 4 m square", as in the sentence "drives ...".
std::string course_in_words(const Course& course);

}  // namespace umbsim

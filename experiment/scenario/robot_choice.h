#pragma once

#include "core/text/yaml_reader.h"
#include "experiment/scenario/scenario.h"

namespace umbsim {

/// `robot:` of a scenario. Throws InputError with file, line, key, value and bound.
RobotChoice read_robot(const YamlValue& value);

}  // namespace umbsim

#pragma once

#include <string>

#include "core/yaml_reader.h"

namespace umbsim {

/// Puts the value of a setting `a.b.c=value` into the document. Throws InputError that names `--set`.
void apply_setting(const YamlValue& document, const std::string& setting);

}  // namespace umbsim

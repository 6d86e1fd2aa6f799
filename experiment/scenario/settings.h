#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/text/yaml_reader.h"

namespace umbsim {

/// Puts the value of a setting `a.b.c=value` into the document. Throws InputError that names `--set`.
void apply_setting(const YamlValue& document, const std::string& setting);

/// Throws `error` again, which a document with `settings` of the command line brought about. It names the setting
/// without which there would be none, and no place of the file then. `document(n)`: anew, with the first n settings.
[[noreturn]] void blame_setting(const InputError& error, const std::vector<std::string>& settings,
                                const std::function<YamlValue(std::size_t)>& document);

}  // namespace umbsim

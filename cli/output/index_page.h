#pragma once

#include <string>

namespace umbsim {

/// Below results/ a new result renews the list of all of them, results/index.html. Elsewhere nothing is written. What
/// cannot be read is left out; a list that cannot be written is no failure of the command.
void write_index_beside(const std::string& folder);

}  // namespace umbsim

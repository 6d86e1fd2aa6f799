#pragma once

#include <string>

#include "exchange/bag/messages/definition.h"

namespace umbsim::exchange {

/// Structs of OMG IDL 4.2 as ROS 2 writes it: modules, structs, typedefs of arrays, sequences; annotations and
/// constants are left out. Throws InputError.
Definitions parse_idl(const std::string& text);

}  // namespace umbsim::exchange

#pragma once

#include <vector>

#include "sim/urdf_drive.h"

namespace umbsim {

/// Remarks on what a reader of names would have taken otherwise, and on what stands in the place of wheel shapes.
void remark_drive(const UrdfSource& source, const std::vector<Body>& bodies, const Drive& drive);

}  // namespace umbsim

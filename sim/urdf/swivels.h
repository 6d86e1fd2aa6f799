#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/urdf/supports.h"

namespace umbsim {

/// Whether a name says caster, in whatever case, or castor.
bool is_called_caster(const std::string& name);

/// The caster that swivels about `bodies[top]` on these shapes (with the bodies that hold them), which stand on the
/// floor. Wheels beside each other on one axle are one wheel in their middle, which is said. Throws InputError for
/// anything else.
FoundSupport swivelling_support(const UrdfSource& source, const std::vector<Body>& bodies, int top,
                                const std::vector<std::pair<int, Shape>>& touching);

/// A caster behind a swivel whose wheel has no shape that is known: its axle's height above the floor is its radius.
/// Nothing where no wheel's joint is there, or where it is too high to be one.
std::optional<FoundSupport> swivel_by_axle(const UrdfSource& source, const std::vector<Body>& bodies, int top,
                                           double wheel_radius_m);

}  // namespace umbsim

#pragma once

#include <vector>

#include "sim/urdf/drive.h"

namespace umbsim {

/// Remarks on what a reader of names would have taken otherwise, and on what stands in the place of wheel shapes.
/// Whether a wheel rolls on a joint of its own, but is a caster by its name or by a friction of at most 0.1 in Gazebo.
bool rolls_as_caster(const UrdfSource& source, const Body& body);

/// Whether a joint is called wheel, but its limits keep it from turning: its author's simulator may not mind.
bool is_limited_wheel(const Body& body);

/// The body that steers `bodies[index]`: a revolute upright joint with limits above it. 0: none.
int steered_by(const std::vector<Body>& bodies, int index);

/// Which of the pair is the left one by the names of joints and links, which is said: 1, 2, or 0 if they do not tell.
int left_by_name(const UrdfSource& source, const std::vector<Body>& bodies,
                 const std::pair<RollingWheel, RollingWheel>& pair);

void remark_drive(const UrdfSource& source, const std::vector<Body>& bodies, const Drive& drive);

}  // namespace umbsim

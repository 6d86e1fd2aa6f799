#pragma once

#include "experiment/output/result_json.h"

namespace umbsim {

/// What the replay on a page needs of the robot: its URDF, those of its meshes that are found and not too large (base64, by
/// the name in the URDF), names of the drive joints, left and right, and the wheels' radius.
Json robot_scene_json(const std::string& urdf_text, const std::string& urdf_file, const RobotModel& robot);

/// Cables, patches, slope, and how uneven the floor is.
Json floor_scene_json(const Floor& floor);

/// The poses of a run that go into a page, with the moments, what the wheels did, and ellipses.
void add_digest(Json& run, const RunDigest& digest, const PoseTrack* track);

}  // namespace umbsim

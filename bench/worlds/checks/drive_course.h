#pragma once

#include <string>
#include <vector>

#include "bench/worlds/engines/engine.h"

namespace umbsim::worlds {

/// What a check asks of a robot: a course, driven on the odometry of its own shafts, or a stretch at constant
/// curvature.
struct CheckDrive {
  enum class Kind { square, circle };
  Kind kind = Kind::square;
  Course course;
  Direction direction = Direction::ccw;
  double circle_radius_m = 0.5;  ///< circle only: once round
  DriveGeometry believed;
  std::vector<LegPush> pushes;
};

struct TrackSample {
  double time_s = 0;
  double command_radps[2] = {0, 0};
  double shaft_rad[2] = {0, 0};
  Pose2 X_WB;
  int part = 0;
};

/// A piece of a drive: of a leg or turn where it speeds up, goes along, slows down.
struct Part {
  std::string name;  ///< start | cruise | stop | turn | arc | circle
  double length_m = 0;
  double angle_rad = 0;
};

struct DrivenTrack {
  std::vector<Part> parts;
  std::vector<TrackSample> samples;
};

DriveGeometry believed_of(const Rig& rig);

/// Drives with commands at 50 Hz.
DrivenTrack drive(Engine& engine, const CheckDrive& drive);

/// By part: true relative pose, less that of the odometry from the same shafts, in the frame of the part's start.
std::vector<Pose2> residuals(const DrivenTrack& track, const DriveGeometry& believed);

}  // namespace umbsim::worlds

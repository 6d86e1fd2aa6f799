#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace umbsim {

/// A round cable (or a half-round strip of the same top) lying on the floor, straight and cut off square at its ends.
struct Cable {
  double x_m = 0;  ///< middle of the cable, floor frame
  double y_m = 0;
  double direction_rad = M_PI / 2;  ///< along the cable; M_PI / 2 lies across a robot that drives along x
  double height_m = 0.010;          ///< diameter
  double length_m = 0.08;
};

/// One ripple of an uneven floor: amplitude * cos(kx x + ky y + phase).
struct Ripple {
  double amplitude_m = 0;
  double kx_radpm = 0;
  double ky_radpm = 0;
  double phase_rad = 0;
};

/// A disc on the floor with a friction of its own.
struct FrictionPatch {
  double x_m = 0;
  double y_m = 0;
  double radius_m = 0;
  double friction = 0;
};

/// The floor as data: a smooth height field, friction, and what lies on it.
struct Floor {
  double friction = 0.9;        ///< Coulomb coefficient between floor and wheels
  std::vector<Ripple> ripples;  ///< empty: flat
  std::vector<Cable> cables;
  std::vector<FrictionPatch> patches;  ///< the last one that covers a place counts
  double slope_rad = 0;                ///< tilt against gravity
  double downhill_rad = 0;             ///< floor-frame direction in which it falls
  double drift_x = 0;                  ///< carpet: metres sideways per metre that a wheel rolls, floor frame
  double drift_y = 0;
};

double friction_at(const Floor& floor, double x_m, double y_m);

/// Height and slope of the floor at one place.
struct FloorPoint {
  double height_m = 0;
  double slope_x = 0;
  double slope_y = 0;
};

FloorPoint floor_at(const Floor& floor, double x_m, double y_m);

/// An isotropic random height field: `waves` ripples of random direction and phase whose wavelengths scatter by a
/// third around `wavelength_m`, with root mean square height `rms_m` in the mean over places.
std::vector<Ripple> random_ripples(double rms_m, double wavelength_m, std::uint64_t seed, std::uint64_t index,
                                   int waves = 12);

/// Where a wheel or ball is nearest to something on the floor.
struct NearestPoint {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< on the floor or cable, world frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< from the floor towards the wheel
  double distance_m = 0;                              ///< negative when they overlap
};

/// A thin disc (circle of radius `radius_m` in the plane across `axis`) or, with a zero axis, a ball.
struct RollingShape {
  Eigen::Vector3d centre_m;
  Eigen::Vector3d axis;
  double radius_m = 0;
};

NearestPoint nearest_on_floor(const Floor& floor, const RollingShape& shape);

/// False if the nearest point lies beyond the cable's ends.
bool nearest_on_cable(const Floor& floor, const Cable& cable, const RollingShape& shape, NearestPoint& nearest);

}  // namespace umbsim

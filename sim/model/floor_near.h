#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "sim/model/floor.h"

namespace umbsim {

/// Height and slope of the floor at one place, and how the slope changes from there.
struct FloorBend {
  FloorPoint at;
  double xx_per_m = 0, xy_per_m = 0, yy_per_m = 0;
};

FloorBend floor_bend(const Floor& floor, double x_m, double y_m);

/// The floor near one place: its ripples' sines and cosines once, and from there by the theorem of addition, with
/// series in the change of phase. Two ripples at a time, which is what every processor can do.
class FloorNear {
 public:
  FloorNear(const Floor& floor, double x_m, double y_m) : floor_(floor) { move(x_m, y_m); }

  FloorBend at(double x_m, double y_m);

 private:
  using Two = Eigen::Array2d;
  static constexpr std::size_t kMost = 32;  // ripples; more are evaluated one by one

  void move(double x_m, double y_m);

  const Floor& floor_;
  double x_m_ = 0, y_m_ = 0;
  std::size_t pairs_ = 0;
  Two kx_[kMost / 2], ky_[kMost / 2];
  Two sine_[kMost / 2], cosine_[kMost / 2];  // times the amplitude
};

/// Sines and cosines of two angles, to 1e-16 for |angle| < 1e5.
void sines_of_two(const Eigen::Array2d& angle_rad, Eigen::Array2d& sine, Eigen::Array2d& cosine);

}  // namespace umbsim

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "sim/dynamics/contact_solver.h"

namespace umbsim {

/// Which of its laws' branches each contact and each bounded row of a step is on, in their order.
struct Grip {
  int contacts = 0;
  bool open[8]{};
  int patch[8]{};   // -1, 1: at its limit
  int swivel[4]{};  // the same of each leg
  int motor[2]{};   // the same, at its torque limit; 2: in the play of its gear
  bool slipped = false;
  bool all_stick = false;  // every support, and no row is at a bound
  std::array<Eigen::Vector3d, 8> slip = all_zero();

  static std::array<Eigen::Vector3d, 8> all_zero() {
    std::array<Eigen::Vector3d, 8> zero;
    zero.fill(Eigen::Vector3d::Zero());
    return zero;
  }

  bool all_hold() const {
    const auto holds = [](int side) { return side == 0; };
    return std::none_of(open, open + 8, [](bool o) { return o; }) && std::all_of(patch, patch + 8, holds) &&
           std::all_of(swivel, swivel + 4, holds) && std::all_of(motor, motor + 2, holds);
  }
};

/// What the contacts did in a step: where the next one begins to look for what they do.
struct ContactsBefore {
  Grip grip;
  RowVector impulses;
  std::array<ContactRows, 8> rows{};
  int contacts = 0;
};

}  // namespace umbsim

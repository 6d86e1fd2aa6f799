#pragma once

#include <array>
#include <functional>
#include <string>

#include "exchange/import/log.h"

namespace umbsim::exchange {

/// Makes a track in the plane from poses in space.
class PlanarTrack {
 public:
  /// `where` says which sample the next error is about, as in "mocap.tum:12". `up`: the tracker's axis that points up.
  PlanarTrack(std::string name, const std::string& up);

  /// `q`: x, y, z, w. Throws InputError naming `where`: not finite, a quaternion that is none, a time that does not
  /// increase, a body that lies on its side. The same pose at the same time once more is left out.
  void add(Nanoseconds at, const std::array<double, 3>& position_m, const std::array<double, 4>& q,
           const std::function<std::string()>& where);
  /// The same of a pose in the plane; its heading may turn by more than half a turn between samples.
  void add(Nanoseconds at, const Pose2& pose, const std::function<std::string()>& where);

  Track take();
  std::size_t repeated() const { return repeated_; }

 private:
  void append(Nanoseconds at, const Pose2& pose, const std::function<std::string()>& where);

  Track track_;
  std::array<double, 9> R_;  ///< world axes with z up, seen from the tracker's; by rows
  std::string up_;
  std::size_t repeated_ = 0;
};

/// The choices of --up.
const std::array<const char*, 6>& up_axes();

}  // namespace umbsim::exchange

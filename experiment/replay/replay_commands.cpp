// What a robot's commands show of how it is driven and read.
#include <algorithm>
#include <cmath>

#include "experiment/drive/commanded_course.h"
#include "experiment/replay/replay.h"

namespace umbsim {

CommandFeatures Replay::asked(const CommandedMotion& motion) const {
  const Recording course = commanded(recording_, motion);
  std::vector<std::vector<Stretch>> all;
  for (const RecordedRun& run : course.runs) all.push_back(umbsim::stretches(run, course.robot));
  return measured_command_features(course, all, 1);
}

CommandFeatures Replay::command_features(const std::vector<Effect>& effects) const {
  const Rig r = rig(0, effects);
  const double period_s = 1 / recording_.encoder_rate_hz;
  CommandFeatures h{};
  const double accelerations = std::log(r.commanded_motion.acceleration_factor);
  const double turns = std::log(r.commanded_motion.turn_speed_factor);
  if (accelerations != 0 || turns != 0) {
    h = asked(r.commanded_motion);
    for (std::size_t i = 0; i < 3; ++i) h[i] -= as_declared_[i];
  }
  h[3] = std::log(std::max(1.0, r.encoders.sampling_interval_s / period_s));
  h[4] = std::log(r.encoders.ticks_per_revolution / recording_.robot.ticks_per_revolution);
  return h;
}

}  // namespace umbsim

#include "exchange/export/one_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::exchange {

std::vector<Placed> one_log(const Recording& recording) {
  constexpr double kApart_s = 5;
  std::vector<Placed> log;
  double next = 0;
  for (const RecordedRun& run : recording.runs) {
    const double first = std::min(run.encoders.front().time_s, run.truth.front().time_s);
    const double last = std::max(run.encoders.back().time_s, run.truth.back().time_s);
    const double begin = std::ceil(next - first);
    log.push_back({&run, begin, begin + first, begin + last});
    next = begin + last + kApart_s;
  }
  return log;
}

std::string runs_csv(const std::vector<Placed>& log) {
  std::string text = "id,from_s,to_s,direction\n";
  const double zero = log.front().begin_s + log.front().run->encoders.front().time_s;
  for (const Placed& p : log) {
    text += fmt::format("{},{:.9f},{:.9f},{}\n", p.run->id, p.begin_s - zero, p.to_s - zero, p.run->direction);
  }
  return text;
}

std::vector<Pose2> reckoned(const RecordedRun& run, const OdometryParameters& odometry) {
  DeadReckoning reckoning(odometry, run.truth.front().X_WB, run.encoders.front().left_ticks,
                          run.encoders.front().right_ticks);
  std::vector<Pose2> poses;
  for (const EncoderSample& s : run.encoders) {
    reckoning.update(s.left_ticks, s.right_ticks);
    poses.push_back(reckoning.pose());
  }
  return poses;
}

OdometryParameters believed(const RecordedRobot& robot) {
  return {robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, robot.ticks_per_revolution};
}

}  // namespace umbsim::exchange

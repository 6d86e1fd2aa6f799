#include "exchange/export/text_logs.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "exchange/export/one_log.h"

namespace umbsim::exchange {
namespace {

// Of one time: the counts, the pose or both.
struct Row {
  const EncoderSample* counts = nullptr;
  const Pose2* odometry = nullptr;
  const Pose2* truth = nullptr;
};

std::string tum_line(double time_s, const Pose2& p) {
  return fmt::format("{:.9f} {:.9f} {:.9f} 0 0 0 {:.12f} {:.12f}\n", time_s, p.x_m, p.y_m, std::sin(p.theta_rad / 2),
                     std::cos(p.theta_rad / 2));
}

std::string pose_cells(const Pose2* p) {
  return p ? fmt::format(",{:.9f},{:.9f},{:.9f}", p->x_m, p->y_m, p->theta_rad) : ",,,";
}

}  // namespace

std::string samples_csv(const Recording& recording) {
  std::string text =
      "time_s,run,run_time_s,left_ticks,right_ticks,left_command_radps,right_command_radps,truth_x_m,truth_y_m,"
      "truth_theta_rad,odometry_x_m,odometry_y_m,odometry_theta_rad\n";
  for (const Placed& p : one_log(recording)) {
    const std::vector<Pose2> odometry = reckoned(*p.run, believed(recording.robot));
    std::map<double, Row> rows;
    for (std::size_t i = 0; i < odometry.size(); ++i) {
      rows[p.run->encoders[i].time_s].counts = &p.run->encoders[i];
      rows[p.run->encoders[i].time_s].odometry = &odometry[i];
    }
    for (const TruthSample& t : p.run->truth) rows[t.time_s].truth = &t.X_WB;
    for (const auto& [time_s, row] : rows) {
      text += fmt::format("{:.9f},{},{:.9f}", p.begin_s + time_s, p.run->id, time_s);
      text += row.counts ? fmt::format(",{},{}", row.counts->left_ticks, row.counts->right_ticks) : ",,";
      text += row.counts && p.run->has_commands
                  ? fmt::format(",{:.9g},{:.9g}", row.counts->left_command_radps, row.counts->right_command_radps)
                  : ",,";
      text += pose_cells(row.truth) + pose_cells(row.odometry) + "\n";
    }
  }
  return text;
}

std::string truth_tum(const RecordedRun& run) {
  std::string text;
  for (const TruthSample& t : run.truth) text += tum_line(t.time_s, t.X_WB);
  return text;
}

std::string odometry_tum(const RecordedRun& run, const RecordedRobot& robot) {
  std::string text;
  const std::vector<Pose2> poses = reckoned(run, believed(robot));
  for (std::size_t i = 0; i < poses.size(); ++i) text += tum_line(run.encoders[i].time_s, poses[i]);
  return text;
}

}  // namespace umbsim::exchange

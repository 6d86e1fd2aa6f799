#include "exchange/import/imported.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "calibration/intake/intake.h"
#include "calibration/intake/samples.h"
#include "core/error.h"
#include "exchange/import/source.h"
#include "exchange/import/truth/mount.h"
#include "exchange/import/wheels/robot_numbers.h"
#include "exchange/import/whole_run.h"

namespace umbsim::exchange {
namespace {

double rate_of(const std::vector<EncoderSample>& samples) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(samples[i].time_s - samples[i - 1].time_s);
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  const double rate = 1 / steps[steps.size() / 2];
  return std::abs(rate - std::round(rate)) < 0.02 * rate && rate >= 1 ? std::round(rate) : rate;
}

// The pose before the wheels turn, from all that the tracker saw of it.
Pose2 start_of(const RecordedRun& run) {
  constexpr double kClocks_s = 0.1;  // by which they may differ
  constexpr std::int64_t kStill = 2;
  const EncoderSample& first = run.encoders.front();
  const auto moves = std::find_if(run.encoders.begin(), run.encoders.end(), [&](const EncoderSample& s) {
    return std::abs(s.left_ticks - first.left_ticks) > kStill || std::abs(s.right_ticks - first.right_ticks) > kStill;
  });
  const double until_s = moves == run.encoders.end() ? first.time_s : moves->time_s - kClocks_s;
  Pose2 sum;
  double poses = 0;
  for (const TruthSample& t : run.truth) {
    if (poses > 0 && t.time_s > until_s) break;
    sum = {sum.x_m + t.X_WB.x_m, sum.y_m + t.X_WB.y_m, sum.theta_rad + t.X_WB.theta_rad};
    poses += 1;
  }
  return {sum.x_m / poses, sum.y_m / poses, sum.theta_rad / poses};
}

// One floor frame for all runs, for what happens at a place: the first run starts at its origin along +x, unless the
// tracker's own is kept. Later runs may have drifted from there; a quarter turn is on purpose.
void set_floor_frame(Recording& recording, bool keep) {
  const Pose2 X_FW = keep ? Pose2{} : inverse(start_of(recording.runs.front()));
  for (RecordedRun& run : recording.runs) {
    for (TruthSample& t : run.truth) t.X_WB = X_FW * t.X_WB;
    // Whole turns that the robot made before say nothing.
    const double start = start_of(run).theta_rad, turns = start - wrap_angle(start);
    for (TruthSample& t : run.truth) t.X_WB.theta_rad -= turns;
    const double quarters = std::round((start - turns) / (M_PI / 2));
    if (quarters != 0) run.start_heading_rad = quarters * M_PI / 2;
  }
}

// The words of the intake are those of recordings; a user of import has options.
std::string with_options(const std::string& what) {
  const auto says = [&](const char* word) { return what.find(word) != std::string::npos; };
  double ratio = 0;
  const std::size_t at = what.find("the truth's way is ");
  if (at != std::string::npos && std::sscanf(what.c_str() + at, "the truth's way is %lf", &ratio) == 1 &&
      std::abs(ratio * 180 / M_PI - 1) < 0.1) {
    return what + " (For import: the wheels' numbers are degrees, not radians.)";
  }
  if (says("commands") || says("_command_radps")) {
    return what + " (For import: --commands for another topic, or --commands none to leave them out.)";
  }
  if (says("swapped")) {
    return what + " (For import: exchange --left-joint and --right-joint, or --left-column and --right-column.)";
  }
  if (says("must be in seconds of one clock")) return what + " (For import: --time-unit.)";
  if (says("wheel_radius_m") || says("wheelbase_m") || says("ticks_per_revolution")) {
    return what + " (For import: --wheel-radius, --wheelbase, --ticks-per-revolution, --unit, --truth-unit.)";
  }
  return what;
}

}  // namespace

Imported import_recording(ImportOptions options) {
  Imported result;
  RecordedRobot robot = robot_numbers(options, result.found);
  Log log = read_log(options);
  result.found.insert(result.found.end(), log.found.begin(), log.found.end());
  require_numbers(robot, log);
  const RecordedRun whole = whole_run(log, options, robot, result.found);
  // Squares and standstills are found by the counts; a counter that jumps hides them.
  if (options.runs_file.empty()) intake::check_counts(options.source, whole, robot);
  result.cut = cut_of(whole, robot, options);
  Recording& r = result.recording;
  r.title = options.title.empty() ? std::filesystem::path(options.source).filename().string() : options.title;
  r.source = "imported from " + std::filesystem::path(options.source).filename().string();
  r.robot = robot;
  for (const Piece& piece : result.cut.pieces) r.runs.push_back(run_of(whole, piece));
  const bool squares = result.cut.side_m && std::all_of(r.runs.begin(), r.runs.end(),
                                                        [](const RecordedRun& run) { return run.direction != "free"; });
  r.path.shape = squares ? "square" : "free";
  if (squares) {
    r.path.side_m = *result.cut.side_m;
    r.path.linear_speed_mps = result.cut.linear_speed_mps;
    r.path.angular_speed_radps = result.cut.angular_speed_radps;
  }
  r.encoder_rate_hz = rate_of(r.runs.front().encoders);
  r.truth_position_sd_m = options.position_sd_m.value_or(0);
  r.truth_heading_sd_rad = options.heading_sd_rad.value_or(0);
  set_floor_frame(r, options.keep_frame);
  check_mount(r, options, result.remarks);
  try {
    result.limits = intake::check_recording(r, options.source);
  } catch (const InputError& e) {
    throw InputError(with_options(e.what()));
  }
  return result;
}

}  // namespace umbsim::exchange

#include "cli/commands/import_options.h"

#include <fmt/format.h>

#include <sstream>

#include "exchange/import/log.h"
#include "exchange/import/truth/planar_track.h"

namespace umbsim {
namespace {

const CLI::Range kPositive(1e-9, 1e9);

// FORWARD,LEFT,DEGREES
std::string read_mount(const std::string& text, std::optional<Pose2>& X_BT) {
  std::istringstream in(text);
  Pose2 pose;
  char a = 0, b = 0;
  double turn = 0;
  if (!(in >> pose.x_m >> a >> pose.y_m >> b >> turn) || a != ',' || b != ',' || in.peek() != EOF) {
    return fmt::format("'{}' must be FORWARD,LEFT,DEGREES, as in 0.05,0,90", text);
  }
  pose.theta_rad = radians(turn);
  X_BT = pose;
  return "";
}

void add_columns(CLI::App& c, exchange::ImportOptions& o) {
  const char* kGroup = "Columns of a CSV file (a name, its end, or a number from 1 on)";
  c.add_option("--time-column", o.time_column, "Time")->group(kGroup);
  c.add_option("--left-column", o.left_column, "Left wheel")->group(kGroup);
  c.add_option("--right-column", o.right_column, "Right wheel")->group(kGroup);
  c.add_option("--left-command", o.left_command_column, "Commanded speed of the left wheel")->group(kGroup);
  c.add_option("--right-command", o.right_command_column, "The same of the right wheel")->group(kGroup);
  c.add_option("--x-column", o.x_column, "Truth: x")->group(kGroup);
  c.add_option("--y-column", o.y_column, "Truth: y")->group(kGroup);
  c.add_option("--heading-column", o.heading_column, "Truth: heading")->group(kGroup);
  c.add_option("--unit", o.unit, "Unit of the wheels' columns")
      ->check(CLI::IsMember(exchange::wheel_unit_names()))
      ->group(kGroup);
  c.add_option("--counts", o.counts, "Whether they hold the sum or what each sample added")
      ->check(CLI::IsMember({"cumulative", "per-sample"}))
      ->group(kGroup);
  c.add_option("--time-unit", o.time_unit, "Unit of the time")
      ->check(CLI::IsMember({"s", "ms", "us", "ns"}))
      ->group(kGroup);
  c.add_option("--truth-unit", o.truth_unit, "Unit of x and y")->check(CLI::IsMember({"m", "cm", "mm"}))->group(kGroup);
  c.add_option("--heading-unit", o.heading_unit, "Unit of the heading")
      ->check(CLI::IsMember({"rad", "deg"}))
      ->group(kGroup);
}

void add_tracker(CLI::App& c, exchange::ImportOptions& o) {
  const char* kGroup = "The truth";
  c.add_option("--truth-file", o.truth_file, "File of the truth: CSV, TUM, KITTI or a bag; default: in the source")
      ->group(kGroup);
  c.add_option("--truth", o.truth, "Topic of the truth, `tf:parent/child`, or how its columns' names begin")
      ->group(kGroup);
  c.add_option("--times", o.times_file, "Times of KITTI poses, one a line, in seconds")->group(kGroup);
  c.add_option("--truth-rate", o.truth_rate_hz, "Rate of KITTI poses, Hz")->check(kPositive)->group(kGroup);
  std::vector<std::string> axes(exchange::up_axes().begin(), exchange::up_axes().end());
  c.add_option("--up", o.up, "The tracker's axis that points up")
      ->check(CLI::IsMember(axes))
      ->capture_default_str()
      ->group(kGroup);
  c.add_option_function<std::string>(
       "--mount",
       [&o](const std::string& text) {
         const std::string problem = read_mount(text, o.X_BT);
         if (!problem.empty()) throw CLI::ValidationError("--mount", problem);
       },
       "Where the tracked frame sits on the robot: FORWARD,LEFT,DEGREES from the axle's middle, metres")
      ->group(kGroup);
  c.add_option("--truth-offset", o.truth_offset_s, "Seconds to add to the truth's times")->group(kGroup);
  c.add_flag("--keep-frame", o.keep_frame,
             "Leave the poses in the tracker's frame; default: the first run starts at the origin")
      ->group(kGroup);
  c.add_option("--position-sd", o.position_sd_m, "Noise of its positions, metres")
      ->check(CLI::Range(0.0, 1e3))
      ->group(kGroup);
  c.add_option("--heading-sd", o.heading_sd_rad, "Noise of its headings, radians")
      ->check(CLI::Range(0.0, 1e3))
      ->group(kGroup);
}

void add_robot(CLI::App& c, exchange::ImportOptions& o) {
  const char* kGroup = "The robot";
  c.add_option("--robot", o.robot_file, "Its URDF: wheel radius, wheelbase and drive joints")->group(kGroup);
  c.add_option("--wheel-radius", o.wheel_radius_m, "As believed, metres")->check(kPositive)->group(kGroup);
  c.add_option("--wheelbase", o.wheelbase_m, "As believed, metres")->check(kPositive)->group(kGroup);
  c.add_option("--ticks-per-revolution", o.ticks_per_revolution, "Counts of a wheel's encoder in a turn of the wheel")
      ->check(kPositive)
      ->group(kGroup);
  c.add_option("--encoders", o.encoders, "Topic of the wheels, or how their columns' names begin")->group(kGroup);
  c.add_option("--commands", o.commands,
               "Topic of a bag with commanded speeds (Twist, TwistStamped); none: leave them out; default: cmd_vel")
      ->group(kGroup);
  c.add_option("--left-joint", o.left_joint, "Joint of the left wheel")->group(kGroup);
  c.add_option("--right-joint", o.right_joint, "Joint of the right wheel")->group(kGroup);
}

}  // namespace

void add_import_options(CLI::App& c, exchange::ImportOptions& o) {
  c.add_option("--title", o.title, "Title of the recording; default: the source's name");
  add_robot(c, o);
  add_columns(c, o);
  add_tracker(c, o);
  const char* kGroup = "The runs";
  c.add_option("--cut", o.cut, "Where one log holds several runs; auto: at squares, else it is one run")
      ->check(CLI::IsMember({"auto", "squares", "standstills", "none"}))
      ->capture_default_str()
      ->group(kGroup);
  c.add_option("--runs", o.runs_file, "CSV file with id, from_s, to_s and maybe direction of every run")->group(kGroup);
  c.add_option("--still", o.still_s, "Standstills that part runs take this many seconds")
      ->check(CLI::Range(0.2, 1e4))
      ->capture_default_str()
      ->group(kGroup);
  c.add_option("--side", o.side_m, "Side of the squares, metres; default: as the wheels counted it")
      ->check(kPositive)
      ->group(kGroup);
}

}  // namespace umbsim

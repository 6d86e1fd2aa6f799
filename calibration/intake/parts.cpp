#include "calibration/intake/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::intake {
namespace {

constexpr double kNear = 0.25;  // log of how far a scale may be from one that is suspected

}  // namespace

double metres_per_tick(const RecordedRobot& robot) {
  return 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
}

std::string likeliest(double ratio, const std::vector<Suspect>& suspects, const std::string& otherwise) {
  const auto off = [&](const Suspect& s) { return std::abs(std::log(ratio / s.factor)); };
  const auto best = std::min_element(suspects.begin(), suspects.end(),
                                     [&](const Suspect& a, const Suspect& b) { return off(a) < off(b); });
  return off(*best) < kNear ? best->meaning : otherwise;
}

std::string why_lengths_differ(double ratio, const RecordedRobot& robot, const std::string& whose) {
  const double ticks = robot.ticks_per_revolution;
  const double tick_m = metres_per_tick(robot);
  return likeliest(
      ratio,
      {{1000, fmt::format("{} in millimetres (divide by 1000), or wheel_radius_m is 1000 times too small, or "
                          "ticks_per_revolution 1000 times too large",
                          whose)},
       {100, fmt::format("{} in centimetres (divide by 100), or wheel_radius_m is 100 times too small", whose)},
       {10, "a scale is wrong by 10: check wheel_radius_m (10 times too small?) and ticks_per_revolution"},
       {0.001, "wheel_radius_m is in millimetres (divide by 1000)"},
       {0.01, "wheel_radius_m is in centimetres (divide by 100)"},
       {0.1, "a scale is wrong by 10: check wheel_radius_m (10 times too large?) and ticks_per_revolution"},
       {ticks / (2 * M_PI), "the encoders' columns hold radians, not counts: multiply by ticks_per_revolution / 2 pi"},
       {ticks / 360, "the encoders' columns hold degrees, not counts: multiply by ticks_per_revolution / 360"},
       {ticks, "the encoders' columns hold revolutions, not counts: multiply by ticks_per_revolution"},
       {0.001 / tick_m,
        "the encoders' columns hold millimetres, not counts: divide by 2 pi 1000 wheel_radius_m / "
        "ticks_per_revolution"},
       {0.5, "wheel_radius_m may be the diameter, or ticks_per_revolution half of what it is (quadrature)"},
       {0.25, "ticks_per_revolution is a quarter of what it is (quadrature: 4 counts a line)"},
       {4, "ticks_per_revolution is four times what it is (quadrature)"},
       {2, "wheel_radius_m may be half of what it is, or ticks_per_revolution twice"}},
      "check wheel_radius_m, ticks_per_revolution and the units of the truth");
}

std::string why_turns_differ(double ratio) {
  return likeliest(ratio,
                   {{180 / M_PI, "theta_rad is in degrees: multiply by pi / 180"},
                    {M_PI / 180, "theta_rad is too small by 180 / pi"},
                    {1000, "wheelbase_m is in millimetres (divide by 1000)"},
                    {100, "wheelbase_m is in centimetres (divide by 100)"},
                    {10, "wheelbase_m is 10 times too large"},
                    {2, "wheelbase_m is twice what it is, or theta_rad"},
                    {0.5, "wheelbase_m is half of what it is (from the middle to a wheel?), or theta_rad"},
                    {0.1, "wheelbase_m is 10 times too small"},
                    {0.01, "wheelbase_m is 100 times too small"},
                    {0.001, "wheelbase_m is 1000 times too small (given in kilometres?)"}},
                   "check wheelbase_m and theta_rad");
}

const std::array<Wiring, 6>& wirings() {
  static const std::array<Wiring, 6> all{
      {{1, 0, 0, 1, ""},
       {0, 1, 1, 0,
        "left_ticks and right_ticks are swapped: turns have the wrong sign; exchange the columns (or theta_rad and y_m "
        "grow clockwise)"},
       {-1, 0, 0, -1, "both wheels count backwards: negate both ticks columns"},
       {0, -1, -1, 0, "left and right are swapped and both count backwards: exchange the columns and negate them"},
       {-1, 0, 0, 1, "the left wheel counts backwards: negate left_ticks"},
       {1, 0, 0, -1, "the right wheel counts backwards: negate right_ticks"}}};
  return all;
}

Counted counted(const RecordedRun& run, const RecordedRobot& robot, const Wiring& w) {
  Counted c;
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const double l = double(run.encoders[i].left_ticks - run.encoders[i - 1].left_ticks);
    const double r = double(run.encoders[i].right_ticks - run.encoders[i - 1].right_ticks);
    const double left = metres_per_tick(robot) * (w.left_from_left * l + w.left_from_right * r);
    const double right = metres_per_tick(robot) * (w.right_from_left * l + w.right_from_right * r);
    c.way_m += std::abs(left + right) / 2;
    c.turn_rad += (right - left) / robot.wheelbase_m;
    c.left_m += std::abs(left);
    c.right_m += std::abs(right);
  }
  return c;
}

double Agreement::score() const {
  if (counted2 == 0 || tracked2 == 0) return 0;
  const double scale = 0.5 * std::abs(std::log(tracked2 / counted2));
  return product / std::sqrt(counted2 * tracked2) - 0.1 * std::min(scale, 3.0);
}

}  // namespace umbsim::intake

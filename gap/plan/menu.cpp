#include "gap/plan/menu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

constexpr double kFast = 2;  // times the plain square's speeds
constexpr double kSlow = 0.5;
constexpr double kLongDwell_s = 3;
constexpr double kTurnRadius_m = 0.4;  // as in a trial's recommended set
constexpr double kTurnShare = 0.2;     // of the side, at most: rolling turns must fit into the square

}  // namespace

std::vector<MenuRun> plan_menu(const RecordedPath& path, double dwell_s, double payload_kg) {
  const double speed = path.linear_speed_mps.value_or(0.2);
  const double turning = path.angular_speed_radps.value_or(0.7);
  const double radius = std::min(kTurnRadius_m, kTurnShare * path.side_m);
  std::vector<MenuRun> menu;
  const auto offer = [&](const std::string& id, const std::string& label, const auto& change) {
    for (const char* direction : {"cw", "ccw"}) {
      MenuRun m{fmt::format("{}, {}", label, direction), {}, dwell_s, turning};
      m.run.id = fmt::format("menu-{}-{}", direction, id);
      m.run.direction = direction;
      change(m);
      menu.push_back(std::move(m));
    }
  };
  offer("plain", "plain square", [](MenuRun&) {});
  offer("rotated", "start turned by 90 deg", [](MenuRun& m) { m.run.start_heading_rad = M_PI / 2; });
  offer("fast", fmt::format("fast ({:.2g} m/s)", kFast * speed),
        [&](MenuRun& m) { m.run.linear_speed_mps = kFast * speed; });
  offer("slow", fmt::format("slow ({:.2g} m/s)", kSlow * speed),
        [&](MenuRun& m) { m.run.linear_speed_mps = kSlow * speed; });
  offer("loaded", fmt::format("payload {:.3g} kg", payload_kg), [&](MenuRun& m) { m.run.payload_kg = payload_kg; });
  offer("rolling", fmt::format("rolling turns of {:.2g} m radius", radius), [&](MenuRun& m) {
    m.run.turn = "arc";
    m.run.turn_radius_m = radius;
  });
  offer("fast-turns", fmt::format("fast turns ({:.2g} rad/s)", kFast * turning),
        [&](MenuRun& m) { m.angular_speed_radps = kFast * turning; });
  offer("dwell", fmt::format("dwell of {:.2g} s at the corners", kLongDwell_s),
        [](MenuRun& m) { m.dwell_s = kLongDwell_s; });
  return menu;
}

}  // namespace umbsim::gap

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/fidelity/contact/cone.h"
#include "bench/fidelity/table.h"
#include "core/pose2.h"

namespace umbsim::fidelity {
namespace {

constexpr const char* kDownhill = R"(## 1. Sliding on the friction cone

A slope of 20° with friction 0.25 is steeper than the friction angle (14°): a braked robot slides.

**Straight downhill.** Let all supports have the same friction and slide along the unit vector e. Then the floor pulls
with -μ N e, N the sum of the loads, at the loads' centre of pressure. The robot does not tip, so the moments about the
centre of mass (height h) put the centre of pressure at μ h e from the point below it: on a line along e through the
centre of mass. The pull has no lever arm, whatever the heading. So the robot slides straight downhill, does not turn,
and accelerates with

```
a = g (sin α - μ cos α)
```

A friction pyramid, aligned with the wheels, would slide askew at every heading that is not a multiple of 45°. (The ball
casters have the wheels' friction here.)

)";

constexpr const char* kBallShare =
    R"(**The frictionless ball's share.** Heading straight down (σ = 1) or up (σ = -1), with the ball at x_b, the centre of mass
at x_c and height h: the loads N_w + N_b = m g cos α and the moments N_w (x_c + σ μ h) = N_b (x_b - x_c) give

```
N_w = m g cos α (x_b - x_c) / (x_b + σ μ h),     a = g sin α - μ N_w / m
```

)";

constexpr const char* kTurning =
    R"(**Turning.** With a frictionless ball the brakes pull on the axle and the weight on the centre of mass: the robot swings
like a weathervane. With one free wheel it also turns about the braked one. No closed form is known to us; the figures
are compared with an integrator of their own (`bench/fidelity/plane_dynamics.cpp`): one rigid body in the plane,
Coulomb's law at each contact, loads from the moment equations, L-stable and of second order. It shares nothing with the
simulator but the masses. After 0.7 s from rest, rigid contacts. "Limit": extrapolated to step zero from 1 and 2 ms.

The step is of first order: under a constant acceleration a, the end of a slide of duration t is a t h / 2 too far with a
step h. What is left in the limit comes from wheels that change between rolling and sliding on the way.

)";

std::string downhill_table(Grid grid) {
  Table table({"robot", "contacts", "headings", "direction, worst", "turned, worst", "a / closed form - 1, worst"});
  for (const auto& [name, robot] : {std::pair{"LabMate", labmate()}, std::pair{"OptiOdom", optiodom()}}) {
    for (const auto& [contacts, options] : {std::pair{"rigid", rigid()}, std::pair{"default", PhysicsOptions{}}}) {
      double direction = 0, turned = 0, acceleration = 0;
      for (const double heading_rad : slide_headings(grid)) {
        const DownhillSlide s = slide_downhill(robot, heading_rad, options);
        direction = std::max(direction, std::abs(s.direction_error_rad));
        turned = std::max(turned, std::abs(s.turned_rad));
        acceleration = std::max(acceleration, std::abs(s.acceleration_ratio - 1));
      }
      table.row({name, contacts, std::to_string(slide_headings(grid).size()),
                 fmt::format("{:.1e}°", degrees(direction)), fmt::format("{:.1e}°", degrees(turned)),
                 fmt::format("{:.1e}", acceleration)});
    }
  }
  return table.text();
}

std::string ball_table() {
  Table table({"robot", "heading", "a / closed form - 1, rigid", "default contacts"});
  for (const auto& [name, robot] : {std::pair{"LabMate", labmate()}, std::pair{"OptiOdom", optiodom()}}) {
    for (const int sense : {1, -1}) {
      table.row({name, sense > 0 ? "down" : "up", fmt::format("{:.1e}", ball_share_ratio(robot, sense, rigid()) - 1),
                 fmt::format("{:.1e}", ball_share_ratio(robot, sense, {}) - 1)});
    }
  }
  return table.text();
}

std::string turning_table(Grid grid, bool left_free) {
  Table table({"robot", "heading", "path", "turns by", "off, 20 ms", "off, 1 ms", "off, limit"});
  for (const auto& [name, robot] : {std::pair{"LabMate", labmate()}, std::pair{"OptiOdom", optiodom()}}) {
    const std::vector<double> headings = slide_headings(grid);
    for (std::size_t i = 0; i < headings.size(); i += 2) {
      const double heading_rad = headings[i];
      const TurningSlide s = slide_and_turn(robot, left_free, heading_rad);
      const auto off = [](const EndError& e) {
        return fmt::format("{:.3f} mm, {:+.4f}°", 1000 * e.off_m, degrees(e.off_rad));
      };
      table.row({name, fmt::format("{:.0f}°", degrees(heading_rad)), fmt::format("{:.0f} mm", 1000 * s.path_m),
                 fmt::format("{:.2f}°", degrees(s.turned_rad)), off(s.default_step), off(s.fine_step),
                 off(s.extrapolated)});
    }
  }
  return table.text();
}

}  // namespace

std::string cone_chapter(Grid grid) {
  return kDownhill + downhill_table(grid) + kBallShare + ball_table() + kTurning + "Both wheels braked:\n\n" +
         turning_table(grid, false) + "Left wheel free, right wheel braked:\n\n" + turning_table(grid, true);
}

}  // namespace umbsim::fidelity

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/fidelity/contact/cable.h"
#include "bench/fidelity/table.h"

namespace umbsim::fidelity {
namespace {

const char* const kCablesText = R"(## 5. Cables

A rigid wheel of radius R that rolls over a round cable of diameter h = 2r without slip: its centre follows an arc of
radius R + r, from the angle ψ before the cable's top to ψ behind it, with cos ψ = (R - r) / (R + r). Its path is longer than
the floor below by Δ, and with equal wheel rotation the robot turns by Δθ towards the bumped wheel:

```
Δ = 2 (R + r) ψ - 4 √(R r),     Δθ = Δ / b
```

At the first touch the cable pushes along its normal, ψ from the vertical. The wheel climbs on its own traction only if
the friction reaches tan ψ = 2 √(R r) / (R - r). Below that it spins against the cable and the robot turns round it.

The closed form is a limit, and two things lead away from it:

- **Softness.** Supports that sink by s under their load take s off the cable's height. As Δ grows with h^(3/2), the
  heading loses 1.5 s / h: at the default 0.12 mm, 1.8 % at 10 mm, 3 % at 6 mm and 4.5 % at 4 mm. This is the tread's, and
  is meant.
- **Speed.** A wheel that meets the cable at speed v takes a blow. Near tan ψ it slips on the climb and the heading error
  grows; momentum and the other wheel can even push it over a cable that it could not climb slowly, slipping. Within some
  5 % below tan ψ even 0.02 m/s is momentum enough.

In the *rigid limit* supports sink by h / 100, the robot crosses at 0.02 m/s and the steps are 0.1 ms. What is left
there is the sink's 1.5 %. "Cannot climb": the wheel has not passed the cable. "Slips over": it has, with friction below
tan ψ. `umbsim run` warns of both, and counts cables that a wheel did not pass as `cables_not_crossed`, and those with
friction below tan ψ as `cables_without_grip`.

Heading error as a ratio to Δθ, left wheel:

)";

std::string cell(const CableCase& c) {
  const CableOutcome out = cross(c);
  if (!out.crossed) return "cannot climb";
  const bool slips = c.friction < closed_form(c.robot.wheels[0].radius_m, c.height_m).least_friction;
  return slips ? fmt::format("slips over: {:.2f}", out.ratio) : fmt::format("{:.4f}", out.ratio);
}

std::string grid_table(Grid grid) {
  Table table({"robot", "R, b", "h", "Δθ", "tan ψ", "friction", "0.05 m/s", "0.1 m/s", "0.2 m/s", "rigid limit"});
  for (CableCase c : cable_grid(grid)) {
    const double radius_m = c.robot.wheels[0].radius_m, wheelbase_m = c.robot.wheelbase_m();
    const Climb climb = closed_form(radius_m, c.height_m);
    std::vector<std::string> row{c.name,
                                 fmt::format("{:.0f}, {:.0f} mm", 1000 * radius_m, 1000 * wheelbase_m),
                                 fmt::format("{:.0f} mm", 1000 * c.height_m),
                                 fmt::format("{:.3f}°", degrees(climb.extra_path_m / wheelbase_m)),
                                 fmt::format("{:.2f}", climb.least_friction),
                                 fmt::format("{}", c.friction)};
    for (const double speed_mps : {0.05, 0.1, 0.2}) {
      c.speed_mps = speed_mps;
      row.push_back(cell(c));
    }
    row.push_back(cell(in_rigid_limit(c)));
    table.row(row);
  }
  return table.text();
}

// The rigid limit's supports, with the steps that are shipped.
std::string shipped_steps_line(Grid grid) {
  double least = 1, most = 1;
  for (const CableCase& c : cable_grid(grid)) {
    if (c.friction < closed_form(c.robot.wheels[0].radius_m, c.height_m).least_friction) continue;
    for (const double speed_mps : {0.02, 0.05}) {
      CableCase limit = in_rigid_limit(c);
      limit.options.fine_step_s = c.options.fine_step_s;
      limit.speed_mps = speed_mps;
      const CableOutcome out = cross(limit);
      least = std::min(least, out.crossed ? out.ratio : 0);
      most = std::max(most, out.ratio);
    }
  }
  return fmt::format(
      "The same supports with the shipped step of 1 ms, at 0.02 and at 0.05 m/s, wherever the wheel can climb: {:.4f} "
      "to {:.4f}. What that costs: [bench.md](bench.md).\n\n",
      least, most);
}

// Left against right in the grid's rigid limit.
std::string mirror_line(Grid grid) {
  double worst = 0;
  for (const CableCase& c : cable_grid(grid)) {
    const CableOutcome left = cross(c);
    CableCase other = c;
    other.wheel = 1;
    if (left.crossed) worst = std::max(worst, std::abs(left.ratio - cross(other).ratio));
  }
  return fmt::format("Right wheel instead of left, whole grid at 0.2 m/s: the ratio changes by at most {:.1e}.\n\n",
                     worst);
}

std::string limits_table() {
  Table table({"robot", "friction", "sink", "0.02 m/s", "0.1 m/s", "0.2 m/s", "0.4 m/s"});
  for (const auto& [name, robot] : {std::pair{"LabMate", labmate()}, std::pair{"OptiOdom", optiodom()}}) {
    for (const double friction : {0.9, 2.0}) {
      for (const double share : {0.03, 0.012, 0.003}) {
        CableCase c = in_rigid_limit({robot, name, 0.010, friction, 0.02, 0, {}}, share);
        std::vector<std::string> row{name, fmt::format("{}", friction), fmt::format("{} mm", 10 * share)};
        for (const double speed_mps : {0.02, 0.1, 0.2, 0.4}) {
          c.speed_mps = speed_mps;
          row.push_back(cell(c));
        }
        table.row(row);
      }
    }
  }
  return table.text();
}

}  // namespace

std::string cable_chapter(Grid grid) {
  return kCablesText + grid_table(grid) + shipped_steps_line(grid) + mirror_line(grid) +
         "Both limits side by side, cable 10 mm, steps of 0.1 ms. With friction 2 a wheel does not slip:\n\n" +
         limits_table();
}

}  // namespace umbsim::fidelity

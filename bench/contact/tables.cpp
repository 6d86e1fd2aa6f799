// Prints the tables of docs/contact.md.
#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "bench/contact/trials.h"

namespace {

using namespace umbsim::contact;

constexpr double kSteps_s[] = {0.001, 0.002, 0.005, 0.01, 0.02};

std::string off(double measured, double intended) { return fmt::format("{:+.3f} %", 100 * (measured / intended - 1)); }

void slip_curve() {
  constexpr double kCreep = 0.02;
  fmt::print("### The slip curve, creep {} along and across, step 20 ms\n\n", kCreep);
  fmt::print("| F/N along | slip intended | measured | off | F/N across | slip intended | measured | off |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const double force_n : {10, 50, 100, 150, 200, 224}) {
    const Slip a = slip_along(kCreep, force_n), c = slip_across(kCreep, 1.25 * force_n);
    const double ia = kCreep * a.traction, ic = kCreep * c.traction;
    fmt::print("| {:.4f} | {:.6f} | {:.6f} | {} | {:.4f} | {:.6f} | {:.6f} | {} |\n", a.traction, ia, a.slip,
               off(a.slip, ia), c.traction, ic, c.slip, off(c.slip, ic));
  }
  fmt::print("\nBeyond F/N = {} along it slides, m a = F - μ N:\n\n", kMu);
  fmt::print("| F/N | acceleration intended, m/s² | measured | off |\n|---|---|---|---|\n");
  for (const double force_n : {280, 350, 450, 600}) {
    const Slip s = slip_along(kCreep, force_n);
    fmt::print("| {:.3f} | {:.4f} | {:.4f} | {} |\n", s.traction, s.intended_mps2, s.acceleration_mps2,
               off(s.acceleration_mps2, s.intended_mps2));
  }
}

void patch() {
  fmt::print("\n### Contact patch, creep 0.02, step 20 ms\n\n");
  fmt::print("| width, mm | share of a turn on the spot, about w² / 2b² | measured ");
  fmt::print("| share of a gentle curve: w² / 3b² | measured |\n|---|---|---|---|---|\n");
  for (const double width_m : {0.01, 0.02, 0.04}) {
    const Figure turn = turn_lost(0.02, width_m), curve = curve_lost(0.02, width_m);
    fmt::print("| {:.0f} | {:.6f} | {:.6f} | {:.6f} | {:.6f} |\n", width_m * 1000, turn.intended, turn.measured,
               curve.intended, curve.measured);
  }
}

struct Law {
  const char* name;
  std::function<double(const umbsim::PhysicsOptions&)> figure;
  double intended;  ///< 0: not in closed form
};

// The order p from three steps, each half the one before: figures approach their limit as h^p. Figures that do not
// change have none.
std::string order(double at_5ms, double at_10ms, double at_20ms) {
  constexpr double kUnchanged = 1e-6;
  if (std::abs(at_20ms / at_5ms - 1) < kUnchanged) return "-";
  return fmt::format("{:.1f}", std::log2(std::abs((at_20ms - at_10ms) / (at_10ms - at_5ms))));
}

void steps() {
  const Law laws[] = {
      {"creep: slip along at 100 N", [](const auto& o) { return slip_along(0.02, 100, o).slip; },
       0.02 * slip_along(0.02, 100).traction},
      {"creep: slip across at 100 N", [](const auto& o) { return slip_across(0.02, 100, o).slip; },
       0.02 * slip_across(0.02, 100).traction},
      {"creep on a slope: rad/m", [](const auto& o) { return slope_heading(0.02, 0.02, o).measured; },
       slope_heading(0.02, 0.02).intended},
      {"caster drag: rad/m", [](const auto& o) { return drag_yaw(0.02, o).measured; }, drag_yaw(0.02).intended},
      {"spin friction: share of a turn", [](const auto& o) { return turn_lost(0.02, 0.02, o).measured; },
       turn_lost(0.02, 0.02).intended},
      {"compliance 5 µm/N: distance", [](const auto& o) { return compliance(5e-6, o).measured; },
       compliance(5e-6).intended},
      {"carpet, with turns: m/m", [](const auto& o) { return carpet(o).measured; }, carpet().intended},
      {"swivelling caster's kick: rad", [](const auto& o) { return swivel_kick(o); }, 0},
  };
  fmt::print("\n### Steps from 1 to 20 ms: change against 1 ms\n\n");
  fmt::print("| figure | closed form | 1 ms | 2 ms | 5 ms | 10 ms | 20 ms | order |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const Law& law : laws) {
    fmt::print("| {} | {} |", law.name, law.intended ? fmt::format("{:.7f}", law.intended) : "");
    double at[5];
    for (int i = 0; i < 5; ++i) {
      at[i] = law.figure(with_step(kSteps_s[i]));
      if (i == 0) fmt::print(" {:.7f} |", at[0]);
      else fmt::print(" {:+.4f} % |", 100 * (at[i] / at[0] - 1));
    }
    fmt::print(" {} |\n", order(at[2], at[3], at[4]));
  }
}

void stability() {
  fmt::print("\n### At the bounds of the parameters, step 20 ms and 1 ms\n\n");
  fmt::print("| | closed form | 20 ms | 1 ms |\n|---|---|---|---|\n");
  const auto row = [](const char* what, const Figure& slow, const Figure& fine) {
    fmt::print("| {} | {:.6f} | {:.6f} | {:.6f} |\n", what, slow.intended, slow.measured, fine.measured);
  };
  const umbsim::PhysicsOptions fine = with_step(0.001);
  for (const double creep : {0.05, 1.0}) {
    const Slip a = slip_along(creep, 100), b = slip_along(creep, 100, fine);
    row(creep < 1 ? "creep 0.05, 100 N along" : "creep 1 (bound), 100 N along", {a.slip, creep * a.traction},
        {b.slip, creep * b.traction});
  }
  row("compliance 5 µm/N", compliance(5e-6), compliance(5e-6, fine));
  row("compliance 20 µm/N", compliance(2e-5), compliance(2e-5, fine));
  row("patch 40 mm", turn_lost(0.02, 0.04), turn_lost(0.02, 0.04, fine));
  row("patch 500 mm (bound)", turn_lost(0.02, 0.5), turn_lost(0.02, 0.5, fine));
}

}  // namespace

int main() {
  slip_curve();
  patch();
  steps();
  stability();
}

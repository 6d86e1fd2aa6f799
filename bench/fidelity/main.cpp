// Measures the simulator's fidelity and prints docs/fidelity.md: bench/fidelity/run.
#include <cstdio>
#include <cstring>
#include <string>

#include "bench/fidelity/contact/cable.h"
#include "bench/fidelity/contact/cone.h"
#include "bench/fidelity/contact/loads.h"
#include "bench/fidelity/energy.h"
#include "bench/fidelity/rolling.h"
#include "bench/fidelity/steps.h"
#ifdef UMBSIM_FIDELITY_PEERS
#include "bench/fidelity/peers.h"
#endif

namespace {

using namespace umbsim::fidelity;

const char* const kHead = R"(# Fidelity

How exactly the simulator does what the equations say: measured against closed forms, against integrators of their own,
against itself with smaller steps, and against another engine. Every table is a measurement; `bench/fidelity/run` made
this file. The laws are in [physics.md](physics.md). Robots: [LabMate](../robots/labmate.urdf) and
[OptiOdom](../robots/optiodom.urdf). "Default": the settings of a scenario that says nothing else (soft supports, steps of
at most 20 ms, 1 ms near cables). "Rigid": supports that do not give.

A coarser grid of chapters 1 to 6 is a test (`tests/fidelity`), with these figures as limits.

)";

std::string peers() {
#ifdef UMBSIM_FIDELITY_PEERS
  return peers_chapter();
#else
  return "## 7. MuJoCo, run by run\n\nNot built: bench/fidelity/run builds it.\n";
#endif
}

}  // namespace

int main(int argc, char** argv) {
  const bool coarse = argc > 1 && std::strcmp(argv[1], "--coarse") == 0;
  if (argc > 2 || (argc == 2 && !coarse)) {
    std::fprintf(stderr, "usage: umbsim_fidelity [--coarse]\n");
    return 2;
  }
  const Grid grid = coarse ? Grid::coarse : Grid::full;
  std::string text = kHead;
  for (const auto chapter :
       {cone_chapter, steps_chapter, energy_chapter, loads_chapter, cable_chapter, rolling_chapter}) {
    text += chapter(grid);
  }
  text += peers();
  while (text.ends_with("\n\n")) text.pop_back();
  std::fputs(text.c_str(), stdout);
  return 0;
}

#pragma once

#include <set>
#include <string>
#include <utility>

#include "gap/diagnose.h"
#include "tests/gap/recordings.h"

namespace umbsim::testing {

/// A recording with what is needed to diagnose it, kept together: they refer to each other.
struct Patient {
  explicit Patient(Recording r)
      : recording(std::move(r)),
        replay(scenario_of(recording, "."), recording),
        model(recording, simulator(replay), gap::Scatter{}) {}
  gap::Diagnosis diagnosed(const std::set<std::string>& excluded = {}) const {
    return gap::diagnose(model, excluded, gap::Thresholds{}, [](const std::string&) {});
  }

  Recording recording;
  Replay replay;
  gap::Model model;
};

}  // namespace umbsim::testing

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "exchange/import/log.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// A signal's values: of angles that stay within one turn, as they go on without the jumps at its end.
struct Unwrapped {
  std::vector<double> value;
  std::size_t jumps = 0;
};
Unwrapped unwrapped(const WheelSignal& signal);

/// What a wheel turned, in revolutions since its first sample (ticks: in counts).
std::vector<double> turned(const WheelSignal& signal, double wheel_radius_m, std::vector<std::string>& found);

/// Counts per revolution that the angles were read with, from their steps; 0 where they are too fine to tell.
double resolution(const std::vector<double>& revolutions);

/// Counts per revolution where neither the options nor the angles say them: finer than any encoder.
constexpr double kFineCounts = 1e6;

}  // namespace umbsim::exchange

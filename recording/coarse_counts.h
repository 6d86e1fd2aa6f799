#pragma once

#include <vector>

#include "recording/recording.h"

namespace umbsim {

/// Width of the encoder's steps, in counts of the recording: all counts are multiples of it, rounded. 1 if they are as
/// fine as they seem, or so fine that steps of a few counts move no rim by 10 um: those are not looked for.
double count_step(const Recording& recording);

/// Numbers of such steps that one wheel's counts stand for. `width` > 1.
std::vector<double> steps_counted(const std::vector<EncoderSample>& samples, std::int64_t EncoderSample::*ticks,
                                  double width);

}  // namespace umbsim

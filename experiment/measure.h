#pragma once

#include "experiment/run.h"

namespace umbsim {

/// UMBmark's figures of plain runs in both directions.
Umbmark umbmark_of(const DrivenRuns& driven, const OdometryParameters& odometry);

/// Clusters of return errors, and UMBmark's figures where squares were driven in both directions.
void measure(ExperimentResult& result);

/// Whether calibrating once more can pay: E_max is beyond what scatter and the solver make.
bool another_pass(const Umbmark& u);

}  // namespace umbsim

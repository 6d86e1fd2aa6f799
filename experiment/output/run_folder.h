#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "experiment/run.h"

namespace umbsim {

/// Throws InputError if `folder` already holds a result and `force` is false, or cannot be a result folder.
void check_output_folder(const std::filesystem::path& folder, bool force);

/// The same, and throws RunError if nothing can be written there: before the work rather than after it.
void prepare_output_folder(const std::filesystem::path& folder, bool force);

/// Writes a folder whole or not at all: `fill` writes into a folder beside it, which is renamed when complete.
/// Throws RunError if that fails; nothing is left behind then, and an older result stays as it was.
void write_folder(const std::filesystem::path& folder, bool force,
                  const std::function<void(const std::filesystem::path&)>& fill);

/// The run folder of an experiment whose rows stand there already: a recording, scenario.resolved.yaml, provenance.json,
/// summary.json, calibration.yaml where it calibrated (with the runs that prove it in `calibrated/`, a recording too), and
/// `page`, unless it is empty, as report.html.
void complete_run_folder(const ExperimentResult& result, const std::string& page, const std::filesystem::path& folder);

}  // namespace umbsim

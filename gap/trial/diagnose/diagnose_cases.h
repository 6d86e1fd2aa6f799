#pragma once

#include <filesystem>

#include "gap/trial/write/trial_folder.h"

namespace umbsim {

/// How the cases of a trial are diagnosed.
struct DiagnoseOptions {
  std::filesystem::path program;  ///< called as `PROGRAM gap diagnose RECORDING --out FOLDER [--exclude EFFECT]...`
  std::filesystem::path cache;    ///< of signatures, shared by all cases; empty: in the trial's folder
  Shard shard;
  int jobs = 0;                   ///< processes at the same time; 0: one per core
  bool retry = false;             ///< diagnose again where it failed before
};

/// What a call has done.
struct DiagnoseResult {
  std::size_t cases = 0;
  std::size_t finished = 0;  ///< of all cases, those that have been diagnosed
  std::size_t failed = 0;    ///< of these, those whose process failed
};

/// Diagnoses every case in a process of its own. The process is given a copy of the one recording in a temporary
/// folder, its work folder and home, and an environment of nothing else but PATH and the cache. What it leaves is kept
/// under diagnoses/<case>/: diagnosis.json, twin.yaml, and process.json (exit code, wall time, the answers' seal as it
/// was then, the end of its messages if it failed). Goes on where an earlier call stopped. Throws RunError, InputError.
DiagnoseResult diagnose_cases(const TrialFolder& folder, const DiagnoseOptions& options);

}  // namespace umbsim

#pragma once

#include <string>
#include <vector>

#include "exchange/import/options.h"
#include "exchange/import/runs/cut.h"
#include "exchange/import/truth/clock_offset.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// What became of a source: a recording that passed the intake, and what to tell of it.
struct Imported {
  Recording recording;
  Cut cut;
  std::vector<std::string> found;    ///< what was understood, a line each
  std::vector<std::string> limits;   ///< of the intake
  std::vector<std::string> remarks;  ///< what a reader should look at
};

/// Reads, cuts and checks; writes nothing. Throws InputError: what is wrong with the source, or which option says what
/// it does not tell.
Imported import_recording(ImportOptions options);

}  // namespace umbsim::exchange
